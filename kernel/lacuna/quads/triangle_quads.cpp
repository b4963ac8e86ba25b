// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/triangle_quads.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/triangulate.h>
#include <lacuna/quads/detail/split_cells.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace lacuna::quads {

namespace {

/// Triangles over loops, as a mixed mesh: the loops' nodes first, loop after loop.
MixedMesh triangles_over(const PlanarRegion& region, const Loops& loops, double by_size)
{
    MixedMesh mesh;
    Loops local;
    for (const std::vector<Index>& loop : loops) {
        local.emplace_back();
        for (const Index p : loop) {
            local.back().push_back(static_cast<Index>(mesh.points.size()));
            mesh.points.push_back(region.points[static_cast<std::size_t>(p)]);
        }
    }
    mesh.fixed = mesh.points.size();
    geometry::TriangulateOptions options;
    if (region.size) options.size = [&](const Vec2& p) { return by_size * region.size(p); };
    geometry::Triangulation triangles = geometry::triangulate(mesh.points, local, options);
    mesh.points = std::move(triangles.points);
    for (const Triangle& t : triangles.triangles) mesh.cells.push_back({t[0], t[1], t[2], -1});
    return mesh;
}

bool all_quads(const MixedMesh& mesh)
{
    return std::none_of(mesh.cells.begin(), mesh.cells.end(), MixedMesh::is_triangle);
}

} // namespace

PlanarQuads quads_of_triangles(const PlanarRegion& region, TriangleWay way)
{
    // Pairs of equilateral triangles have less area than the square of their side.
    const double kPairSize = std::sqrt(2 / std::sqrt(3.0));
    MixedMesh mesh;
    try {
        if (way == TriangleWay::halved) {
            const Loops half = halve(region.points, region.loops);
            if (!can_halve(region.points, region.loops, half)) return {};
            // A triangle becomes three quads of half its side.
            mesh = triangles_over(region, half, 2 * kPairSize);
            match_triangles(mesh);
            mesh = refine(mesh, region.points, region.loops, half);
        } else if (way == TriangleWay::split) {
            mesh = triangles_over(region, region.loops, 2 * kPairSize);
            match_triangles(mesh);
            mesh = split_cells(mesh);
            return deliver(mesh, region, region.loops, Vec2::Zero(), 1);
        } else {
            mesh = triangles_over(region, region.loops, kPairSize);
            match_triangles(mesh);
            pair_triangles(mesh);
        }
    } catch (const InvalidInput&) {
        return {}; // loops that touch: no way of triangles goes
    }
    if (!all_quads(mesh)) return {};
    improve(mesh);
    return deliver(mesh, region, region.loops, Vec2::Zero(), 1);
}

Loops halve(const std::vector<Vec2>& points, const Loops& loops)
{
    Loops half;
    for (const std::vector<Index>& loop : loops) {
        const std::size_t n = loop.size();
        std::array<double, 2> turning{0, 0};
        for (std::size_t i = 0; i < n; ++i) {
            const Vec2 in = points[static_cast<std::size_t>(loop[i])] -
                            points[static_cast<std::size_t>(loop[(i + n - 1) % n])];
            const Vec2 out = points[static_cast<std::size_t>(loop[(i + 1) % n])] -
                             points[static_cast<std::size_t>(loop[i])];
            const double turn = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
            turning[i % 2] += turn * turn;
        }
        std::vector<Index> kept;
        for (std::size_t i = turning[1] <= turning[0] ? 0 : 1; i < n; i += 2) kept.push_back(loop[i]);
        half.push_back(std::move(kept));
    }
    return half;
}

bool can_halve(const std::vector<Vec2>& points, const Loops& loops, const Loops& half)
{
    constexpr double kSharpest = 30 * std::numbers::pi / 180;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        const std::vector<Index>& loop = loops[l];
        if (loop.size() % 2 != 0 || half[l].size() < 4) return false;
        const std::size_t first = loop[0] == half[l][0] ? 1 : 0;
        for (std::size_t i = first; i < loop.size(); i += 2) {
            const Vec2& here = points[static_cast<std::size_t>(loop[i])];
            const Vec2 in = here -
                            points[static_cast<std::size_t>(loop[(i + loop.size() - 1) % loop.size()])];
            const Vec2 out = points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])] - here;
            if (std::abs(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out))) > kSharpest)
                return false;
        }
    }
    return !geometry::find_crossing(points, half);
}

std::vector<Index> in_order(const Loops& loops)
{
    std::vector<Index> order;
    for (const std::vector<Index>& loop : loops) order.insert(order.end(), loop.begin(), loop.end());
    return order;
}

MixedMesh refine(const MixedMesh& mesh, const std::vector<Vec2>& points, const Loops& loops,
                 const Loops& half)
{
    std::vector<Vec2> fixed;
    std::vector<Index> points_of;
    std::vector<Triangle> middles;
    Index start = 0;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        const std::size_t n = loops[l].size();
        const std::size_t first = loops[l][0] == half[l][0] ? 0 : 1;
        const auto coarse = static_cast<Index>(points_of.size());
        const auto count = static_cast<Index>(half[l].size());
        for (Index i = 0; i < count; ++i) {
            const std::size_t at = first + 2 * static_cast<std::size_t>(i);
            points_of.push_back(start + static_cast<Index>(at));
            middles.push_back(
                {coarse + i, coarse + (i + 1) % count, start + static_cast<Index>((at + 1) % n)});
        }
        for (const Index p : loops[l]) fixed.push_back(points[static_cast<std::size_t>(p)]);
        start += static_cast<Index>(n);
    }
    return subdivide(mesh, middles, fixed, points_of);
}

PlanarQuads deliver(const MixedMesh& mesh, const PlanarRegion& region, const Loops& loops, const Vec2& origin,
                    double scale)
{
    PlanarQuads result;
    result.points = region.points;
    std::vector<Index> place = in_order(loops);
    for (std::size_t p = mesh.fixed; p < mesh.points.size(); ++p) {
        place.push_back(static_cast<Index>(result.points.size()));
        result.points.push_back(origin + scale * mesh.points[p]);
    }
    for (Quad q : mesh.cells) {
        for (Index& p : q) p = place[static_cast<std::size_t>(p)];
        result.quads.push_back(q);
    }
    return result;
}

} // namespace lacuna::quads
