// SPDX-License-Identifier: MIT
#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/healing/split_facets.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/auto_walls.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <string>
#include <vector>

using namespace lacuna;
using namespace lacuna::topology;
using test::Part;
using test::refusal;

namespace {

/// Faces of quads, each by a name; corners at the same place are one.
class Quilt {
public:
    void add(const std::string& name, const std::array<Vec3, 4>& corners)
    {
        const auto [label, fresh] = label_.try_emplace(name, static_cast<int>(label_.size()));
        if (fresh) soup_.label_name.push_back(name);
        std::array<Index, 4> c{};
        for (std::size_t k = 0; k < 4; ++k) {
            c[k] = static_cast<Index>(soup_.points.size());
            soup_.points.push_back(corners[k]);
        }
        soup_.triangles.push_back({c[0], c[1], c[2]});
        soup_.triangles.push_back({c[0], c[2], c[3]});
        soup_.triangle_label.insert(soup_.triangle_label.end(), 2, label->second);
    }

    /// The four sides of a square block, or of part of one, each a face.
    void sides(const std::string& name, double half, double low, double high)
    {
        const std::array<Vec3, 4> ring{Vec3(-half, -half, 0), Vec3(half, -half, 0), Vec3(half, half, 0),
                                       Vec3(-half, half, 0)};
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3 &a = ring[k], &b = ring[(k + 1) % 4];
            add(name + std::to_string(k), {a + low * Vec3::UnitZ(), b + low * Vec3::UnitZ(),
                                           b + high * Vec3::UnitZ(), a + high * Vec3::UnitZ()});
        }
    }

    /// A square plate at a height; with a hole where `hole` is above zero.
    void plate(const std::string& name, double half, double z, double hole = 0)
    {
        const auto at = [z](double x, double y) { return Vec3(x, y, z); };
        if (hole == 0) {
            add(name, {at(-half, -half), at(half, -half), at(half, half), at(-half, half)});
            return;
        }
        const std::array<Vec3, 4> in{at(-hole, -hole), at(hole, -hole), at(hole, hole), at(-hole, hole)};
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t n = (k + 1) % 4;
            const double scale = half / hole;
            const auto out = [&](const Vec3& p) { return Vec3(scale * p.x(), scale * p.y(), z); };
            add(name, {out(in[k]), out(in[n]), in[n], in[k]});
        }
    }

    [[nodiscard]] Model model() const
    {
        healing::SplitOptions split;
        split.whole_labels = true;
        return healing::split_facets(soup_, split);
    }

private:
    healing::FacetSoup soup_;
    std::map<std::string, int> label_;
};

std::vector<FaceId> named(const Model& model, const std::vector<std::string>& prefixes)
{
    std::vector<FaceId> found;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        for (const std::string& prefix : prefixes) {
            if (model.faces[f].name.find(prefix) == 0) found.emplace_back(f);
        }
    }
    return found;
}

/// The walls found are those named, all others reached are left out with an edge, and the volume is of a
/// class.
void check_walls(const Quilt& quilt, const std::vector<std::string>& source,
                 const std::vector<std::string>& target, const std::vector<std::string>& walls,
                 VolumeClass value)
{
    const Model model = quilt.model();
    const WallChoice found = find_walls(model, named(model, source), named(model, target));
    CHECK(found.walls == named(model, walls));
    CHECK(found.taken.size() == found.left_out.size());
    for (const EdgeId edge : found.taken) CHECK(edge.valid());
    const OpenVolume volume = open_volume(model, {named(model, source), named(model, target), found.walls});
    CHECK(classify(volume).value == value);
}

} // namespace

TEST_CASE("walls are found from the source's rim over shared edges, the target left out")
{
    for (const int holes : {0, 3}) {
        const auto prism = test::prism({.sides = 5, .holes = holes, .rows = 3, .pieces = 2});
        const auto found = find_walls(prism.model, prism.roles.source, prism.roles.target);
        auto walls = prism.roles.walls;
        std::sort(walls.begin(), walls.end());
        CHECK(found.walls == walls);
        CHECK(found.left_out.empty());
    }
    // Without the middle row the upper one cannot be reached but over the target.
    const auto cut = test::prism(
        {.sides = 5, .rows = 3, .drop = [](const Part& p) { return p.role == Role::wall && p.row == 1; }});
    CHECK(find_walls(cut.model, cut.roles.source, cut.roles.target).walls.size() == 5);
}

TEST_CASE("faces of the next body are no walls, whichever end it shares and whatever is missing")
{
    for (const bool below : {false, true}) {
        for (const bool top : {true, false}) {
            CAPTURE(below);
            CAPTURE(top);
            Quilt quilt;
            quilt.sides("own", 1, 0, 2);
            quilt.plate("low", 1, 0);
            quilt.plate("high", 1, 2);
            if (below) {
                quilt.sides("other", 1, -1.5, 0);
                if (top) quilt.plate("other lid", 1, -1.5);
            } else {
                quilt.sides("other", 1, 2, 3.5);
                if (top) quilt.plate("other lid", 1, 3.5);
            }
            check_walls(quilt, {"low"}, {"high"}, {"own"}, VolumeClass::closed);
        }
    }
}

TEST_CASE("a plate across the void and a flange round its rim are no walls")
{
    for (const bool across : {true, false}) {
        CAPTURE(across);
        Quilt quilt;
        quilt.sides("a", 1, 0, 1);
        quilt.sides("b", 1, 1, 2);
        quilt.plate("low", 1, 0);
        quilt.plate("high", 1, 2);
        if (across)
            quilt.plate("plate", 1, 1);
        else
            quilt.plate("flange", 1.5, 0, 1);
        check_walls(quilt, {"low"}, {"high"}, {"a", "b"}, VolumeClass::closed);
    }
}

TEST_CASE("a channel through a block is bounded by its bore, not by the block")
{
    for (const bool both : {true, false}) {
        CAPTURE(both);
        Quilt quilt;
        quilt.sides("bore", 0.5, 0, 2);
        quilt.sides("block", 1, 0, both ? 2 : 1.5);
        quilt.plate("ring low", 1, 0, 0.5);
        if (both) quilt.plate("ring high", 1, 2, 0.5);
        quilt.plate("in", 0.5, 0);
        if (both) quilt.plate("out", 0.5, 2);
        check_walls(quilt, {"in"}, both ? std::vector<std::string>{"out"} : std::vector<std::string>{},
                    {"bore"}, both ? VolumeClass::closed : VolumeClass::IV);
    }
}

TEST_CASE("two ways between the same ends that are each other's mirror image are refused, and both named")
{
    Quilt quilt;
    // Square hoops from one plate to the next, to the left and to the right.
    for (const int way : {-1, 1}) {
        const auto at = [&](int step, double width, double height) {
            const double turn = std::numbers::pi * step / 4;
            return Vec3(std::cos(turn) * (3 + width), way * std::sin(turn) * (3 + width), height);
        };
        for (int step = 0; step < 4; ++step) {
            const std::string name = (way < 0 ? "left" : "right") + std::to_string(step);
            const std::array<std::array<double, 2>, 4> ring{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
            for (std::size_t k = 0; k < 4; ++k) {
                const auto &a = ring[k], &b = ring[(k + 1) % 4];
                quilt.add(name + std::to_string(k), {at(step, a[0], a[1]), at(step, b[0], b[1]),
                                                     at(step + 1, b[0], b[1]), at(step + 1, a[0], a[1])});
            }
        }
    }
    quilt.add("one", {Vec3(2, 0, -1), Vec3(4, 0, -1), Vec3(4, 0, 1), Vec3(2, 0, 1)});
    quilt.add("two", {Vec3(-2, 0, -1), Vec3(-4, 0, -1), Vec3(-4, 0, 1), Vec3(-2, 0, 1)});
    const Model model = quilt.model();
    const auto first = std::to_string(model[named(model, {"left"}).front()].tag);
    const auto second = std::to_string(model[named(model, {"right"}).front()].tag);
    CHECK(refusal([&] { find_walls(model, named(model, {"one"}), named(model, {"two"})); },
                  {first, second}) == "topology.walls_ambiguous");
}
