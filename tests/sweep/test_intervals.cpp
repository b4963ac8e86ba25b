// SPDX-License-Identifier: MIT
#include "layers_of.h"
#include "support/check_valid.h"
#include "support/refusal.h"
#include "surface/sealed.h"

#include <lacuna/core/error.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

using namespace lacuna;
using namespace lacuna::topology;
using surface::Interval;
using sweep::SweepOptions;
using sweep::Swept;
using test::PrismOptions;

namespace {

Interval on_edge(int tag, int count, double bias = 1)
{
    Interval interval;
    interval.of = Interval::Of::edge;
    interval.edge = tag;
    interval.count = count;
    interval.bias = bias;
    return interval;
}

Interval between(const OpenVolume& volume, VertexId from, VertexId to, int count, double bias = 1)
{
    Interval interval = on_edge(0, count, bias);
    interval.of = Interval::Of::vertices;
    interval.vertices = {volume.model[from].tag, volume.model[to].tag};
    return interval;
}

Interval along_sweep(int count, double bias = 1)
{
    Interval interval = on_edge(0, count, bias);
    interval.of = Interval::Of::sweep;
    return interval;
}

SweepOptions with_intervals(std::vector<Interval> intervals, double size = 0.4)
{
    SweepOptions options = test::layers_of(0, size);
    options.intervals = std::move(intervals);
    return options;
}

/// Lengths between the nodes of the mesh on a straight edge, from one of its vertices on.
std::vector<double> lengths_on(const mesh::HexMesh& mesh, const OpenVolume& volume, VertexId from,
                               VertexId to)
{
    const Vec3 a = volume.model.at(volume.model[from].point), b = volume.model.at(volume.model[to].point);
    std::vector<double> at;
    for (const Vec3& p : mesh.nodes) {
        const double t = (p - a).dot(b - a) / (b - a).squaredNorm();
        if (t > -1e-9 && t < 1 + 1e-9 && (p - a - t * (b - a)).norm() < 1e-9)
            at.push_back(t * (b - a).norm());
    }
    std::sort(at.begin(), at.end());
    std::vector<double> lengths;
    for (std::size_t i = 1; i < at.size(); ++i) lengths.push_back(at[i] - at[i - 1]);
    return lengths;
}

void check_lengths(const std::vector<double>& lengths, int count, double bias)
{
    REQUIRE(lengths.size() == static_cast<std::size_t>(count));
    CHECK(lengths.back() / lengths.front() == doctest::Approx(bias));
    for (std::size_t i = 2; i < lengths.size(); ++i)
        CHECK(lengths[i] / lengths[i - 1] == doctest::Approx(lengths[1] / lengths[0]));
}

std::vector<EdgeId> edges_of(const OpenVolume& volume, Role end)
{
    std::vector<EdgeId> edges;
    for (const FaceId face : volume.faces(end)) {
        for (const Loop& loop : volume.model[face].loops) {
            for (const EdgeUse& use : loop.uses) edges.push_back(use.edge);
        }
    }
    return edges;
}

} // namespace

TEST_CASE("edges of either end have as many sides as are asked for, spread by the bias, at both ends")
{
    for (const int sides : {4, 5}) {
        for (const int count : {2, 5, 9}) {
            for (const double bias : {1.0, 3.0, 0.25}) {
                for (const Role end : {Role::source, Role::target}) {
                    CAPTURE(sides);
                    CAPTURE(count);
                    CAPTURE(bias);
                    PrismOptions how;
                    how.sides = sides;
                    how.taper = 0.8;
                    const OpenVolume volume = test::sealed(how);
                    const EdgeId edge = edges_of(volume, end).front();
                    const Edge& asked = volume.model[edge];
                    const Swept swept = sweep::sweep(volume,
                                                     with_intervals({on_edge(asked.tag, count, bias)}));
                    test::check_valid(swept.mesh);
                    check_lengths(lengths_on(swept.mesh, volume, asked.from, asked.to), count, bias);
                    // The edge it is swept to has the same.
                    const auto links = surface::linking_surfaces(volume);
                    const auto partner = [&](VertexId v) {
                        for (const auto& line : links.front().lines) {
                            if (line.line.source == v) return line.line.target;
                            if (line.line.target == v) return line.line.source;
                        }
                        return VertexId();
                    };
                    check_lengths(lengths_on(swept.mesh, volume, partner(asked.from), partner(asked.to)),
                                  count, bias);
                    // And so it has by its vertices, from the first to the second.
                    const Swept other = sweep::sweep(
                        volume, with_intervals({between(volume, asked.to, asked.from, count, bias)}));
                    test::check_valid(other.mesh);
                    check_lengths(lengths_on(other.mesh, volume, asked.to, asked.from), count, bias);
                }
            }
        }
    }
}

TEST_CASE("layers are as many as the sweep, or an edge up the walls, is asked to have")
{
    PrismOptions how;
    how.sides = 4;
    const OpenVolume volume = test::sealed(how);
    const auto links = surface::linking_surfaces(volume);
    const auto& line = links.front().lines.front().line;
    for (const int count : {1, 4, 7}) {
        for (const double bias : {1.0, 2.5}) {
            if (count == 1 && bias != 1) continue;
            CAPTURE(count);
            CAPTURE(bias);
            const Edge& edge = volume.model[line.uses.front().edge];
            for (const Interval& asked :
                 {along_sweep(count, bias), between(volume, line.source, line.target, count, bias),
                  on_edge(edge.tag, count, line.uses.front().reversed ? 1 / bias : bias)}) {
                const Swept swept = sweep::sweep(volume, with_intervals({asked}));
                test::check_valid(swept.mesh);
                CHECK(swept.mesh.layers == count);
                check_lengths(lengths_on(swept.mesh, volume, line.source, line.target), count, bias);
            }
        }
    }
}

TEST_CASE("a wall has as many columns as it is asked for, over all of its edges")
{
    for (const int sides : {0, 4, 5}) {
        for (const int count : {6, 9, 14}) {
            CAPTURE(sides);
            CAPTURE(count);
            PrismOptions how;
            how.sides = sides;
            how.holes = 1;
            how.hole_sides = 0;
            const test::Prism prism = test::prism(how);
            const OpenVolume volume = test::sealed(how);
            Interval asked = on_edge(0, count);
            asked.of = Interval::Of::wall;
            const FaceId wall = prism.face({Role::wall, 1, 0, 0, 0});
            asked.walls.tags = {prism.model[wall].tag};
            const Swept swept = sweep::sweep(volume, with_intervals({asked}));
            test::check_valid(swept.mesh);
            int columns = 0;
            for (std::size_t w = 0; w < swept.mesh.rim.size(); ++w) {
                const FaceId face = swept.faces[index(swept.mesh.wall_patch[w])];
                if (volume.model[face].tag == asked.walls.tags.front()) ++columns;
            }
            CHECK(columns == count);
        }
    }
}

TEST_CASE("intervals that contradict each other are refused, both named with their counts")
{
    PrismOptions how;
    how.sides = 4;
    const OpenVolume volume = test::sealed(how);
    const auto links = surface::linking_surfaces(volume);
    const auto& low = links.front().source.uses();
    const auto& high = links.front().target.uses();
    const int a = volume.model[low[0].edge].tag, b = volume.model[high[0].edge].tag;
    const auto refused = [&](const SweepOptions& options, const std::vector<std::string>& words) {
        return test::refusal([&] { sweep::sweep(volume, options); }, words);
    };
    CHECK(refused(with_intervals({on_edge(a, 4), on_edge(b, 6)}), {"4 sides", "6"}) == "surface.sides_asked");
    CHECK(refused(with_intervals({along_sweep(4), along_sweep(5)}), {"4 layers", "5"}) ==
          "surface.sides_asked");
    SweepOptions layers = with_intervals({along_sweep(4)});
    layers.layers.count = 6;
    CHECK(refused(layers, {"4 layers", "6"}) == "surface.sides_asked");

    std::vector<Interval> odd;
    for (std::size_t i = 0; i < 4; ++i) odd.push_back(on_edge(volume.model[low[i].edge].tag, i == 0 ? 5 : 4));
    CHECK(refused(with_intervals(odd), {"odd", "17 sides"}) == "surface.sides_asked");
    SweepOptions mapped = with_intervals({on_edge(a, 4), on_edge(volume.model[low[2].edge].tag, 6)});
    mapped.quads = sweep::Quads::mapped;
    CHECK(refused(mapped, {"4 (", "6 ("}) == "surface.kept_side");

    CHECK(refused(with_intervals({on_edge(9999, 4)}), {"9999"}) == "surface.no_such_edge");
    Interval nothing = on_edge(a, 0);
    CHECK(refused(with_intervals({nothing}), {"count"}) == "sweep.intervals");
}

TEST_CASE("sides asked for and rows that end on an edge add up, or are refused")
{
    PrismOptions how;
    how.sides = 4;
    const test::Prism prism = test::prism(how);
    const OpenVolume volume = test::sealed(how);
    surface::BoundaryLayer layer;
    layer.walls.tags = {prism.model[prism.face({Role::wall, 0, 0, 0, 0})].tag};
    layer.first = 0.05;
    layer.count = 3;
    // The edges beside that wall are those of the walls next to it.
    const auto links = surface::linking_surfaces(volume);
    const auto& uses = links.front().source.uses();
    const auto wall_of = [&](EdgeId edge) {
        for (const FaceUse& use : volume.model.uses_of_edge(edge)) {
            if (volume.role[use.face.index()] == Role::wall) return volume.model[use.face].tag;
        }
        return 0;
    };
    std::size_t own = 0;
    while (wall_of(uses[own].edge) != layer.walls.tags.front()) ++own;
    const EdgeId beside = uses[(own + 1) % 4].edge;
    for (const int count : {4, 8}) {
        SweepOptions options = with_intervals({on_edge(volume.model[beside].tag, count)});
        options.boundary_layers = {layer};
        const Swept swept = sweep::sweep(volume, options);
        test::check_valid(swept.mesh);
        const Edge& edge = volume.model[beside];
        const auto lengths = lengths_on(swept.mesh, volume, edge.from, edge.to);
        REQUIRE(lengths.size() == static_cast<std::size_t>(count));
        CHECK(std::min(lengths.front(), lengths.back()) == doctest::Approx(0.05));
    }
    SweepOptions few = with_intervals({on_edge(volume.model[beside].tag, 3)});
    few.boundary_layers = {layer};
    CHECK(test::refusal([&] { sweep::sweep(volume, few); }, {"3 rows of boundary layers end there"}) ==
          "surface.sides_asked");
}

TEST_CASE("layers follow a size that changes along the sweep, and are even where it does not")
{
    PrismOptions how;
    how.sides = 4;
    how.height = 4;
    const OpenVolume volume = test::sealed(how);
    SweepOptions options;
    options.size = [](const Vec3& p) { return 0.1 + 0.1 * p.z(); };
    const Swept swept = sweep::sweep(volume, options);
    test::check_valid(swept.mesh);
    const std::size_t n = index(swept.mesh.nodes_per_layer);
    for (int k = 0; k < swept.mesh.layers; ++k) {
        const double low = swept.mesh.nodes[static_cast<std::size_t>(k) * n].z(),
                     high = swept.mesh.nodes[(static_cast<std::size_t>(k) + 1) * n].z();
        CHECK(std::abs(high - low) / options.size(Vec3(0, 0, (low + high) / 2)) ==
              doctest::Approx(1).epsilon(0.1));
    }
    options.size = [](const Vec3& p) { return 0.3 + 0.05 * p.x(); };
    const Swept even = sweep::sweep(volume, options);
    test::check_valid(even.mesh);
    const std::size_t m = index(even.mesh.nodes_per_layer);
    for (int k = 0; k < even.mesh.layers; ++k) {
        CHECK(std::abs(even.mesh.nodes[(static_cast<std::size_t>(k) + 1) * m].z() -
                       even.mesh.nodes[static_cast<std::size_t>(k) * m].z()) ==
              doctest::Approx(4.0 / even.mesh.layers));
    }
}
