// SPDX-License-Identifier: MIT
#include "support/stress.h"

#include <lacuna/closure/close.h>
#include <lacuna/matching/match.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

namespace lacuna::test {

using namespace topology;

namespace {

constexpr double kPi = std::numbers::pi;
/// Size of the quads; the section's radius is 1. Teeth want smaller ones.
double size_of(Section section) { return section == Section::gear || section == Section::comb ? 0.15 : 0.25; }

struct Shape {
    std::vector<Vec2> outline; ///< empty: a circle
    std::vector<Vec2> hole_places;
    double hole_radius = 0.1;
};

std::vector<Vec2> ring(int count, double radius, double turned)
{
    std::vector<Vec2> points;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * kPi * i / count + turned;
        points.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

/// The corners of a section and where its holes go.
Shape shape_of(const StressMember& member)
{
    Shape shape;
    const std::vector<Vec2> around = member.holes == 1 ? std::vector<Vec2>{Vec2(0.05, 0.02)}
                                                       : ring(std::max(member.holes, 1), 0.42, 0.1);
    shape.hole_places = around;
    switch (member.section) {
    case Section::square:
        shape.outline = ring(4, 1, kPi / 4);
        break;
    case Section::hexagon:
        shape.outline = ring(6, 1, 0);
        break;
    case Section::circle:
        break; // round: one wall
    case Section::ell:
        shape.outline = {{-0.8, -0.8}, {0.8, -0.8}, {0.8, -0.1}, {-0.1, -0.1}, {-0.1, 0.8}, {-0.8, 0.8}};
        shape.hole_places = {{-0.45, -0.45}, {0.1, -0.45}, {0.5, -0.45}, {-0.45, 0.1}, {-0.45, 0.5}};
        break;
    case Section::comb:
        shape.outline = {{-1, -0.7}, {1, -0.7},   {1, 0.6},     {0.6, 0.6},   {0.6, -0.1}, {0.2, -0.1},
                         {0.2, 0.6}, {-0.2, 0.6}, {-0.2, -0.1}, {-0.6, -0.1}, {-0.6, 0.6}, {-1, 0.6}};
        shape.hole_places = {{0, -0.4}, {-0.4, -0.4}, {0.4, -0.4}, {-0.75, -0.4}, {0.75, -0.4}};
        shape.hole_radius = 0.09;
        break;
    case Section::gear:
        for (int tooth = 0; tooth < 8; ++tooth) {
            const double middle = kPi / 4 * tooth;
            for (const auto& [radius, off] :
                 {std::pair{0.75, -0.24}, {1.0, -0.15}, {1.0, 0.15}, {0.75, 0.24}})
                shape.outline.emplace_back(radius * std::cos(middle + off), radius * std::sin(middle + off));
        }
        break;
    }
    shape.hole_places.resize(static_cast<std::size_t>(member.holes));
    return shape;
}

const char* name_of(Section section)
{
    switch (section) {
    case Section::square:
        return "square";
    case Section::hexagon:
        return "hexagon";
    case Section::circle:
        return "circle";
    case Section::ell:
        return "L";
    case Section::comb:
        return "comb";
    case Section::gear:
        return "gear";
    }
    return "";
}

/// Numbers of one seed, the same with every standard library.
class Dice {
public:
    explicit Dice(unsigned seed) : engine_(seed) {}

    double between(double low, double high) { return low + (high - low) * engine_() / 4294967296.0; }
    /// Evenly in the logarithm, up or down.
    double factor(double most) { return std::exp(between(-std::log(most), std::log(most))); }
    int below(int count) { return static_cast<int>(between(0, count)); }
    bool chance(double share) { return between(0, 1) < share; }

private:
    std::mt19937 engine_;
};

StressMember draw(int number, bool mild, Dice& dice)
{
    StressMember m;
    m.number = number;
    m.mild = mild;
    m.section = static_cast<Section>(dice.below(6));
    m.holes = dice.chance(0.5) ? 0 : 1 + dice.below(5);
    m.layers = 6 + dice.below(9);
    m.aspect = dice.chance(0.5) ? 1 : dice.factor(mild ? 10 : 100);
    m.bias = dice.chance(0.5) ? 1 : dice.factor(mild ? 10 : 50);
    if (dice.chance(0.5)) m.twist = dice.between(0, mild ? 60 : 180);
    if (dice.chance(0.4)) m.taper = dice.factor(mild ? 2 : 4);
    if (dice.chance(0.4)) m.bend = dice.between(0, mild ? 90 : 180);
    if (dice.chance(0.3)) m.belly = dice.factor(mild ? 1.3 : 1.8);
    const double widest = std::max({1.0, m.taper, m.belly * (1 + m.taper) / 2});
    // A cube's cells are stacked until they reach round the bend, and no corner's line leans too far; flat
    // and tall cells stay as few as they are, and their volume is bent less.
    const double most = std::tan((mild ? 35 : 50) * kPi / 180);
    const double turned = m.twist * kPi / 180 * widest + std::abs(m.taper - 1) +
                          4 * std::abs(m.belly - 1) * widest;
    const double needed = std::max(turned / most, m.bend * kPi / 180 * 1.5 * widest);
    const double size = size_of(m.section);
    if (m.aspect == 1) m.layers = std::max(m.layers, static_cast<int>(std::ceil(needed / size)));
    m.height = size * m.aspect * m.layers;
    m.bend = std::min(m.bend, 180 / kPi * m.height / (1.5 * widest));
    const double lean = (m.twist * kPi / 180 * widest + std::abs(m.taper - 1) +
                         4 * std::abs(m.belly - 1) * widest) /
                        m.height;
    if (lean > most) {
        m.twist *= most / lean;
        m.taper = 1 + (m.taper - 1) * most / lean;
        m.belly = 1 + (m.belly - 1) * most / lean;
    }
    if (dice.chance(0.5)) {
        m.lift = dice.between(0, mild ? 0.25 : 0.5) * std::min(1.0, m.height / 2);
        m.target = dice.chance(0.5) ? End::bowed : End::saddle;
        if (dice.chance(0.3)) m.source = End::bowed;
    }
    const double pick = dice.between(0, 1);
    m.value = pick < 0.45   ? VolumeClass::closed
              : pick < 0.65 ? VolumeClass::IV
              : pick < 0.8  ? VolumeClass::V
              : pick < 0.88 ? VolumeClass::II
              : pick < 0.95 ? VolumeClass::III
                            : VolumeClass::I;
    // Missing walls are made straight: they say what is meant only where the volume is straight, and is not
    // round.
    const bool straight = m.twist < 20 && m.bend < 20 && m.belly == 1;
    const bool walls_missing = m.value == VolumeClass::I || m.value == VolumeClass::II ||
                               m.value == VolumeClass::III;
    if (walls_missing && !(straight && m.section != Section::circle)) m.value = VolumeClass::closed;
    return m;
}

} // namespace

std::string StressMember::name() const
{
    const char* ends[] = {"planar", "tilted", "bowed", "saddle"};
    char text[320];
    std::snprintf(
        text, sizeof text,
        "#%d %s %s holes %d class %s twist %.0f taper %.2f bend %.0f belly %.2f lift %.2f (%s, %s) bias %.2f "
        "aspect %.3g layers %d height %.3g",
        number, mild ? "mild" : "hard", name_of(section), holes, std::string(to_string(value)).c_str(), twist,
        taper, bend, belly, lift, ends[static_cast<int>(source)], ends[static_cast<int>(target)], bias,
        aspect, layers, height);
    return text;
}

std::vector<StressMember> stress_family(int count, unsigned seed)
{
    Dice dice(seed);
    std::vector<StressMember> family;
    for (int i = 0; i < count; ++i) family.push_back(draw(i, 2 * i < count, dice));
    return family;
}

OpenVolume stress_volume(const StressMember& member)
{
    const Shape shape = shape_of(member);
    PrismOptions o;
    o.outline = shape.outline;
    o.sides = 0;
    for (const Vec2& place : shape.hole_places) o.hole_list.push_back({place, shape.hole_radius});
    o.cuts = 3;
    o.height = member.height;
    o.twist = member.twist;
    o.taper = member.taper;
    o.bend = member.bend;
    o.belly = member.belly;
    o.lift = member.lift;
    o.source = member.source;
    o.target = member.target;
    o.levels = std::max({1, static_cast<int>(std::ceil(std::max(member.twist, member.bend) / 5)),
                         member.belly == 1 ? 1 : 16});
    o.feature_angle = 25;
    o.drop = [&member](const Part& part) {
        switch (member.value) {
        case VolumeClass::I:
            return part.role == Role::wall;
        case VolumeClass::II:
            return part.role == Role::wall && (part.loop > 0 || part.side == 1);
        case VolumeClass::III:
            return part.role == Role::wall && part.loop == 0 && part.side % 2 == 1;
        case VolumeClass::IV:
            return part.role == Role::target;
        case VolumeClass::V:
            return part.role != Role::wall;
        default:
            return false;
        }
    };
    return prism(o).open();
}

OpenVolume sealed_stress_volume(const StressMember& member)
{
    OpenVolume volume = stress_volume(member);
    const bool ends = !volume.faces(Role::source).empty() && !volume.faces(Role::target).empty();
    volume = closure::close(volume, ends ? matching::match(volume) : matching::Match{},
                            {.roles_by = closure::RolesBy::finding})
                 .volume;
    return volume;
}

sweep::SweepOptions stress_options(const StressMember& member)
{
    sweep::SweepOptions options;
    options.layers.count = member.layers;
    options.layers.bias = member.bias;
    options.size = [size = size_of(member.section)](const Vec3&) { return size; };
    return options;
}

double edge_bound(const mesh::HexMesh& mesh)
{
    // Nodes on edges of the volume: those between patches.
    std::vector<Index> patch(mesh.nodes.size(), -1);
    std::vector<char> on_edge(mesh.nodes.size(), 0);
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::SkinQuad quad = mesh::skin_quad(mesh, i);
        for (const Index n : quad.nodes) {
            Index& known = patch[static_cast<std::size_t>(n)];
            if (known >= 0 && known != quad.patch) on_edge[static_cast<std::size_t>(n)] = 1;
            known = quad.patch;
        }
    }
    double bound = 1;
    for (std::size_t c = 0; c < mesh.hex_count(); ++c) {
        const Hex hex = mesh.hex(c);
        for (std::size_t corner = 0; corner < 8; ++corner) {
            if (on_edge[static_cast<std::size_t>(hex[corner])] == 0) continue;
            std::array<Vec3, 3> edge;
            std::array<bool, 3> stays{};
            for (std::size_t e = 0; e < 3; ++e) {
                const auto to = static_cast<std::size_t>(hex[mesh::kHexNeighbours[corner][e]]);
                edge[e] = (mesh.nodes[to] - mesh.nodes[static_cast<std::size_t>(hex[corner])]).normalized();
                stays[e] = on_edge[to] != 0;
            }
            for (std::size_t e = 0; e < 3; ++e) {
                if (stays[e] && stays[(e + 1) % 3])
                    bound = std::min(bound, edge[e].cross(edge[(e + 1) % 3]).norm());
            }
            if (stays[0] && stays[1] && stays[2])
                bound = std::min(bound, std::abs(edge[0].dot(edge[1].cross(edge[2]))));
        }
    }
    return bound;
}

} // namespace lacuna::test
