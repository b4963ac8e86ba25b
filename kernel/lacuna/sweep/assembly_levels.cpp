// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/assembly_levels.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/surface/shared/wall_breaks.h>
#include <lacuna/sweep/detail/assembly_order.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Whether the layers of a member are free: neither the user nor a given mesh prescribes them.
bool has_free_layers(const AssemblyMember& member)
{
    const SweepOptions& options = member.options;
    return member.fixed == nullptr && !came_with_mesh(member) && options.layers.count == 0 &&
           options.layers.heights.empty() && options.layers.bias == 1 && options.boundary_layers.empty() &&
           options.intervals.empty();
}

/// The lowest and the highest edges of a wall.
struct Span {
    double low = 0, high = 1;
    Vec3 at_low = Vec3::Zero(), at_high = Vec3::Zero(); ///< mean points of these edges
};

std::optional<Span> span_of(const Model& model, FaceId wall, const std::map<EdgeId, double>& heights)
{
    std::vector<std::pair<double, EdgeId>> edges;
    for (const Loop& loop : border_loops(model, wall))
        for (const EdgeUse& use : loop.uses)
            if (const auto found = heights.find(use.edge); found != heights.end())
                edges.emplace_back(found->second, use.edge);
    if (edges.empty()) return std::nullopt;
    const auto [low, high] = std::ranges::minmax_element(edges);
    Span span{low->first, high->first};
    if (span.high - span.low < kAlikeSizes) return std::nullopt;
    const auto mean = [&](double height) {
        Vec3 sum = Vec3::Zero();
        double whole = 0;
        for (const auto& [at, edge] : edges) {
            if (std::abs(at - height) >= kAlikeSizes) continue;
            const std::vector<Vec3> line = surface::edge_line(model, edge);
            for (std::size_t i = 0; i + 1 < line.size(); ++i) {
                const double length = (line[i + 1] - line[i]).norm();
                sum += length * (line[i] + line[i + 1]) / 2;
                whole += length;
            }
        }
        return Vec3(sum / whole);
    };
    span.at_low = mean(span.low);
    span.at_high = mean(span.high);
    return span;
}

} // namespace

AssemblyLevels::AssemblyLevels(std::span<const AssemblyMember> members, std::span<const SharedFace> shared)
    : members_(members),
      shared_(shared),
      height_(members.size()),
      length_(members.size(), 0),
      same_(members.size(), kAlikeSizes),
      levels_(members.size(), {0, 1})
{
}

void AssemblyLevels::read(std::size_t member, std::span<const surface::LinkingSurface> links,
                          const RunContext& context)
{
    const OpenVolume& volume = *members_[member].volume;
    for (const surface::LinkingSurface& link : links) {
        double area = 0;
        for (const FaceId wall : link.walls) area += face_area(volume.model, wall);
        const double rims = link.source.length() + link.target.length();
        length_[member] = std::max(length_[member], 2 * area / rims);
        for (const EdgeUse& use : link.source.uses()) height_[member].emplace(use.edge, 0.0);
        for (const EdgeUse& use : link.target.uses()) height_[member].emplace(use.edge, 1.0);
        height_[member].merge(surface::heights_around(volume, link, context));
    }
}

bool AssemblyLevels::add_level(std::size_t member, double height)
{
    std::vector<double>& levels = levels_[member];
    if (std::ranges::any_of(levels, [&](double at) { return std::abs(at - height) < same_[member]; }))
        return false;
    levels.insert(std::ranges::upper_bound(levels, height), height);
    return true;
}

std::vector<AssemblyLevels::Contact> AssemblyLevels::contacts() const
{
    std::vector<Contact> found;
    for (const SharedFace& face : shared_) {
        const auto span = [&](std::size_t m, FaceId wall) {
            const OpenVolume& volume = *members_[m].volume;
            return volume.role[wall.index()] == Role::wall ? span_of(volume.model, wall, height_[m])
                                                           : std::nullopt;
        };
        const std::optional<Span> a = span(face.a, face.face_a), b = span(face.b, face.face_b);
        if (!a || !b) continue;
        Contact contact{face.a, face.b, a->low, a->high, b->low, b->high};
        const double to_low = (a->at_low - b->at_low).norm(), to_high = (a->at_low - b->at_high).norm();
        // If the members are swept across each other, the lowest edges of one are no level of the other.
        const Vec3 middle = (b->at_low + b->at_high) / 2;
        if (!(std::min(to_low, to_high) < (a->at_low - middle).norm())) continue;
        if (to_high < to_low) std::swap(contact.from_b, contact.to_b);
        found.push_back(contact);
    }
    return found;
}

/// Copy the levels within shared walls from each member to the other, until no member gets a new level.
void AssemblyLevels::exchange(std::span<const Contact> contacts)
{
    const auto pass_on = [&](std::size_t from, double low, double high, std::size_t to, double there,
                             double end) {
        bool any = false;
        const std::vector<double> levels = levels_[from];
        for (const double level : levels) {
            const double share = (level - low) / (high - low);
            if (share > 0 && share < 1) any = add_level(to, there + share * (end - there)) || any;
        }
        return any;
    };
    // A level reaches every member after at most as many rounds as there are members.
    for (std::size_t round = 0; round < members_.size(); ++round) {
        bool any = false;
        for (const Contact& c : contacts) {
            any = pass_on(c.a, c.from_a, c.to_a, c.b, c.from_b, c.to_b) || any;
            any = pass_on(c.b, c.from_b, c.to_b, c.a, c.from_a, c.to_a) || any;
        }
        if (!any) return;
    }
}

std::vector<std::vector<double>> AssemblyLevels::heights(
    const std::function<double(std::size_t member, double height)>& layers)
{
    std::vector<std::vector<double>> result(members_.size());
    const std::vector<Contact> all = contacts();
    geometry::UnionFind groups(members_.size());
    for (const Contact& c : all) groups.unite(c.a, c.b);
    std::map<std::size_t, double> tallest; // for each group joined by walls: height of its tallest member
    for (std::size_t m = 0; m < members_.size(); ++m)
        tallest[groups.find(m)] = std::max(tallest[groups.find(m)], length_[m]);
    for (std::size_t m = 0; m < members_.size(); ++m) {
        // Levels count as one if they are alike on the scale of the tallest member of the group. A layer
        // boundary can bend to reach both, whereas a layer between them would be very thin.
        if (length_[m] > 0) same_[m] = kAlikeSizes * tallest.at(groups.find(m)) / length_[m];
        for (const auto& [edge, height] : height_[m]) add_level(m, height);
    }
    exchange(all);
    // Only groups in which some member has levels, and in which no member's number of layers is prescribed,
    // are constrained.
    std::vector<bool> concerned(members_.size(), false), set(members_.size(), false);
    for (std::size_t m = 0; m < members_.size(); ++m) {
        if (levels_[m].size() > 2) concerned[groups.find(m)] = true;
        if (!has_free_layers(members_[m])) set[groups.find(m)] = true;
    }
    std::vector<std::size_t> first{0}; // for each member, the index of its first interval between levels
    for (const std::vector<double>& levels : levels_) first.push_back(first.back() + levels.size() - 1);
    geometry::UnionFind parts(first.back());
    const auto at = [&](std::size_t m, double height) {
        const auto nearest = std::ranges::min_element(levels_[m], {},
                                                      [&](double level) { return std::abs(level - height); });
        return static_cast<std::size_t>(nearest - levels_[m].begin());
    };
    for (const Contact& c : all) {
        const std::size_t from_a = at(c.a, c.from_a), to_a = at(c.a, c.to_a), from_b = at(c.b, c.from_b),
                          to_b = at(c.b, c.to_b), count = to_a - from_a;
        const bool reversed = from_b > to_b;
        if ((reversed ? from_b - to_b : to_b - from_b) != count) continue;
        for (std::size_t k = 0; k < count; ++k)
            parts.unite(first[c.a] + from_a + k, first[c.b] + (reversed ? from_b - 1 - k : from_b + k));
    }
    std::vector<double> wanted(first.back(), 1);
    for (std::size_t m = 0; m < members_.size(); ++m) {
        if (!concerned[groups.find(m)] || set[groups.find(m)]) continue;
        const double whole = layers(m, length_[m]);
        for (std::size_t i = 0; i + 1 < levels_[m].size(); ++i) {
            double& most = wanted[parts.find(first[m] + i)];
            most = std::max(most, whole * (levels_[m][i + 1] - levels_[m][i]));
        }
    }
    for (std::size_t m = 0; m < members_.size(); ++m) {
        if (!concerned[groups.find(m)] || set[groups.find(m)]) continue;
        for (std::size_t i = 0; i + 1 < levels_[m].size(); ++i) {
            const auto count = static_cast<int>(std::lround(wanted[parts.find(first[m] + i)]));
            const double low = levels_[m][i], high = levels_[m][i + 1];
            for (int k = 1; k <= count; ++k) result[m].push_back(low + (high - low) * k / count);
        }
    }
    return result;
}

} // namespace lacuna::sweep
