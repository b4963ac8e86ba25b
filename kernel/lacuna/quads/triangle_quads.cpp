// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/triangle_quads.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/detail/region_loops.h>
#include <lacuna/quads/detail/split_cells.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace lacuna::quads {

namespace {

/// Triangles over a region, as a mixed mesh. The nodes of the loops come first, one loop after the other.
MixedMesh triangles_over(const PlanarRegion& region, double by_size)
{
    const PlanarRegion own = region_within(region.points, region.loops).region;
    MixedMesh mesh;
    mesh.fixed = own.points.size();
    geometry::TriangulateOptions options;
    if (region.size) options.size = [&](const Vec2& p) { return by_size * region.size(p); };
    geometry::Triangulation triangles = geometry::triangulate(own.points, own.loops, options);
    mesh.points = std::move(triangles.points);
    for (const Triangle& t : triangles.triangles) mesh.cells.push_back({t[0], t[1], t[2], t[2]});
    return mesh;
}

/// The cells after the best pairs of adjacent triangles are merged into quads.
std::vector<Quad> merged_pairs(const MixedMesh& mesh)
{
    struct Pair {
        double loss;
        Index one, other;
        Quad quad;
    };
    const std::vector<Index> opposite = mesh::opposite_sides(mesh.cells,
                                                             static_cast<Index>(mesh.points.size()));
    std::vector<Pair> pairs;
    for (Index c = 0; c < static_cast<Index>(mesh.cells.size()); ++c) {
        const Quad& one = mesh.cells[index(c)];
        for (std::size_t i = 0; i < 3; ++i) {
            // A triangle stores its last corner twice, so its third side has the number 3.
            const Index side = opposite[4 * index(c) + (i == 2 ? 3 : i)], from = one[i],
                        to = one[(i + 1) % 3];
            if (side < 4 * (c + 1)) continue; // the boundary, or a pair already seen
            const Index other = side / 4;
            const auto far = std::ranges::find_if(mesh.cells[index(other)],
                                                  [&](Index p) { return p != from && p != to; });
            const Quad quad{from, *far, to, one[(i + 2) % 3]};
            const double quality = scaled_jacobian(mesh.points, quad);
            if (quality > kFlatQuad) pairs.push_back({-quality, c, other, quad});
        }
    }
    std::ranges::sort(pairs, {}, [](const Pair& p) { return std::tuple(p.loss, p.one, p.other); });
    std::vector<char> taken(mesh.cells.size(), 0);
    std::vector<Quad> cells;
    for (const Pair& pair : pairs) {
        if (taken[index(pair.one)] != 0 || taken[index(pair.other)] != 0) continue;
        taken[index(pair.one)] = taken[index(pair.other)] = 1;
        cells.push_back(pair.quad);
    }
    for (std::size_t c = 0; c < taken.size(); ++c)
        if (taken[c] == 0) cells.push_back(mesh.cells[c]);
    return cells;
}

} // namespace

PlanarQuads quads_of_triangles(const PlanarRegion& region)
{
    // Two equilateral triangles have less area than a square on their side. Splitting then halves most edges.
    const double kBySize = 2 * std::sqrt(2 / std::sqrt(3.0));
    auto triangles = attempt<InvalidInput>([&] { return triangles_over(region, kBySize); });
    if (!triangles) return {}; // loops that touch cannot be triangulated
    triangles->cells = merged_pairs(*triangles);
    MixedMesh mesh = split_cells(*triangles);

    PlanarQuads result{region.points, {}};
    add_filling(result, region_within(region.points, region.loops).own,
                {std::move(mesh.points), std::move(mesh.cells)});
    return result;
}

} // namespace lacuna::quads
