// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/transfinite_fill.h>

#include <lacuna/closure/detail/outline.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/swept_patch.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lacuna::closure {

using namespace topology;

namespace {

/// A side of a patch: its points, and their shares of the side's length.
struct PatchSide {
    std::vector<Index> chain;
    std::vector<Vec3> points;
    std::vector<double> share;

    [[nodiscard]] Vec3 at(double f) const { return geometry::point_at(points, share, f); }
};

PatchSide patch_side(const Model& model, const std::vector<EdgeUse>& uses)
{
    PatchSide side;
    side.chain = use_points(model, uses);
    side.points = places_at(model, side.chain);
    side.share = geometry::arc_lengths(side.points);
    const double total = side.share.back();
    for (double& s : side.share) s /= total;
    return side;
}

/// For a side between source and target: set the shares of its points to their heights on the walls
/// (`Follower::height()`). Other points are spaced evenly, because void edges have points at even heights.
void by_height(PatchSide& side, const Follower& follower, bool rising)
{
    const std::size_t n = side.chain.size();
    for (std::size_t i = 0; i < n; ++i) {
        const double even = static_cast<double>(i) / static_cast<double>(n - 1);
        const double height = follower.height(side.chain[i]);
        side.share[i] = std::isnan(height) ? even : rising ? height : 1 - height;
    }
    side.share.front() = 0;
    side.share.back() = 1;
}

/// Add a grid cell as two facets, with alternating diagonals to avoid a bias.
void add_halves(geometry::Triangulation& grid, const Quad& q, std::size_t turn)
{
    const std::size_t k = turn % 2;
    grid.triangles.push_back({q[k], q[k + 1], q[k + 2]});
    grid.triangles.push_back({q[k], q[k + 2], q[(k + 3) % 4]});
}

/// Triangulate a rectangle with equal numbers of points on opposite sides by a grid between these points.
/// Facets are then as fine as the sides, also at the corners.
geometry::Triangulation grid_between(const std::array<PatchSide, 4>& side, const Outline& outline,
                                     double width, double height)
{
    const std::size_t n = side[0].chain.size() - 1, m = side[1].chain.size() - 1;
    geometry::Triangulation grid{outline.flat, {}};
    for (std::size_t j = 1; j < m; ++j) {
        for (std::size_t i = 1; i < n; ++i) {
            const double low = side[0].share[i], lean = 1 - side[2].share[n - i] - low;
            const double left = 1 - side[3].share[m - j], slope = side[1].share[j] - left;
            const double s = (low + lean * left) / (1 - lean * slope);
            grid.points.emplace_back(s * width, (left + slope * s) * height);
        }
    }
    const auto at = [&](std::size_t i, std::size_t j) {
        const bool inside = i > 0 && i < n && j > 0 && j < m;
        const std::size_t round = j == 0 ? i : i == n ? n + j : j == m ? n + m + n - i : 2 * n + m + m - j;
        return static_cast<Index>(inside ? 2 * (n + m) + (j - 1) * (n - 1) + i - 1 : round);
    };
    for (std::size_t j = 0; j < m; ++j) {
        for (std::size_t i = 0; i < n; ++i) {
            add_halves(grid, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, i + j);
        }
    }
    return grid;
}

/// Largest distance of a patch between four straight sides from two flat facets over these sides [model
/// length].
double twist_of(const std::array<PatchSide, 4>& side)
{
    const auto corner = [&](std::size_t i) { return side[i].points.front(); };
    return (corner(0) - corner(1) + corner(2) - corner(3)).norm() / 4;
}

/// Triangulate a rectangle whose patch is twisted or doubly curved: an inner grid, usually at least as fine
/// as the sides, and facets between the grid and the sides.
/// @param width, height  segments of the sides in each direction, which are also the rectangle's size.
geometry::Triangulation grid_within(const Outline& outline, double width, double height,
                                    const RunContext& context)
{
    // The least number of cells per direction is `kChords`. Finer sides are curved; the grid is then as fine
    // as the sides.
    // Upper bound of the number of cells. Sides as fine as those of scans would give far more cells than the
    // shape of a void face needs. The grid is then coarser than the sides.
    constexpr double kMostFacets = 1e5;
    const double coarser = std::max(1.0, std::sqrt(width * height / kMostFacets));
    const Index across = std::max(kChords, static_cast<Index>(width / coarser));
    const Index along = std::max(kChords, static_cast<Index>(height / coarser));
    geometry::Triangulation inner{outline.flat, {}};
    const auto first = static_cast<Index>(inner.points.size());
    for (Index j = 1; j < along; ++j) {
        for (Index i = 1; i < across; ++i) inner.points.emplace_back(width * i / across, height * j / along);
    }
    const Index row = across - 1, rows = along - 1;
    const auto at = [&](Index i, Index j) { return first + j * row + i; };
    std::vector<std::vector<Index>> loops = outline.loops;
    std::vector<Index>& hole = loops.emplace_back();
    for (Index i = 0; i + 1 < row; ++i) hole.push_back(at(i, 0));
    for (Index j = 0; j + 1 < rows; ++j) hole.push_back(at(row - 1, j));
    for (Index i = row - 1; i > 0; --i) hole.push_back(at(i, rows - 1));
    for (Index j = rows - 1; j > 0; --j) hole.push_back(at(0, j));
    geometry::Triangulation grid = geometry::triangulate(inner.points, loops, {.interior_points = false},
                                                         context);
    for (Index j = 0; j + 1 < rows; ++j) {
        for (Index i = 0; i + 1 < row; ++i) {
            add_halves(grid, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, index(i + j));
        }
    }
    return grid;
}

} // namespace

VoidFilling fill_transfinite(const Model& model, const std::vector<std::vector<EdgeUse>>& sides,
                             const Follower* follower, const RunContext& context)
{
    std::array<PatchSide, 4> side;
    for (std::size_t i = 0; i < 4; ++i) side[i] = patch_side(model, sides[i]);
    if (follower != nullptr) {
        by_height(side[1], *follower, true);
        by_height(side[3], *follower, false);
    }
    // The unit of the rectangle is one segment of a side. Facets then are about as long as the segments of
    // the sides, whose length depends on curvature.
    const auto segments = [&](std::size_t i, std::size_t j) {
        return static_cast<double>(std::max(side[i].chain.size(), side[j].chain.size()) - 1);
    };
    const double width = segments(0, 2);
    const double height = segments(1, 3);
    const std::array<Vec2, 5> corner{Vec2(0, 0), Vec2(width, 0), Vec2(width, height), Vec2(0, height),
                                     Vec2(0, 0)};
    Outline outline;
    outline.loops.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k + 1 < side[i].chain.size(); ++k) {
            const double f = side[i].share[k];
            outline.loops.front().push_back(static_cast<Index>(outline.flat.size()));
            outline.model_point.push_back(side[i].chain[k]);
            outline.flat.emplace_back((1 - f) * corner[i] + f * corner[i + 1]);
        }
    }
    const bool even = side[0].chain.size() == side[2].chain.size() &&
                      side[1].chain.size() == side[3].chain.size();
    // A twisted patch needs more than a few facets, because the swept mesh follows the facets.
    const double across = (side[0].points.front() - side[2].points.front()).norm();
    const bool twisted = std::min(width, height) < kChords && twist_of(side) > kVisible * across;
    const bool bent_both_ways = std::min(width, height) >= kChords;
    const geometry::Triangulation flat = even && !twisted ? grid_between(side, outline, width, height)
                                         : twisted || bent_both_ways
                                             ? grid_within(outline, width, height, context)
                                             : geometry::triangulate(outline.flat, outline.loops, {},
                                                                     context);
    const auto backward = [](std::vector<Vec3> points) {
        std::reverse(points.begin(), points.end());
        return points;
    };
    const geometry::SweptPatch patch(side[0].points, side[1].points, backward(side[2].points),
                                     backward(side[3].points));
    const std::size_t walls = follower != nullptr ? follower->walls_at(side[0].chain.front()) : 0;
    VoidFilling result = filling_of(model, outline, flat, [&](std::size_t i) -> Vec3 {
        const double s = flat.points[i].x() / width, t = flat.points[i].y() / height;
        if (follower == nullptr) return patch(s, t);
        const auto led = [&](const Vec3& from, const Vec3& to) {
            return follower->morph(from, to, t, walls);
        };
        const Vec3 left = side[3].at(1 - t) - led(side[0].points.front(), side[2].points.back());
        const Vec3 right = side[1].at(t) - led(side[0].points.back(), side[2].points.front());
        return led(side[0].at(s), side[2].at(1 - s)) + (1 - s) * left + s * right;
    });
    const bool seam = sides[1].size() == sides[3].size() && sides[1].front().edge == sides[3].back().edge;
    result.geometry = follower != nullptr ? Geometry::followed
                      : seam              ? Geometry::annular
                                          : Geometry::transfinite;
    result.algorithm = seam ? "Algorithm 5" : "Algorithm 6";
    return result;
}

} // namespace lacuna::closure
