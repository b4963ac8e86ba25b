// SPDX-License-Identifier: MIT
#pragma once

/// Loops of a region: places and angles along them, and regions within a mesh. Only sources of this folder
/// include it.

#include <lacuna/quads/detail/corner_sine.h>
#include <lacuna/quads/region.h>

#include <functional>
#include <span>
#include <vector>

namespace lacuna::quads {

/// Node numbers in walking order, with the region on the left. In a mesh with cuts, a node may occur twice.
using Cycle = std::vector<Index>;

/// A length as a function of the position: the requested size of quads, or the height of rows.
using SizeField = std::function<double(const Vec2&)>;

/// The point at a position of a loop. Positions past the end continue from the start.
inline const Vec2& point_of(std::span<const Vec2> points, const Cycle& loop, std::size_t place)
{
    return points[index(loop[place % loop.size()])];
}

/// The point that is `sides` sides further along a loop than a position. Positions past the end continue from
/// the start.
Vec2 point_along(std::span<const Vec2> points, const Cycle& loop, std::size_t from, double sides);

/// Add points that divide a loop evenly from one place to another. The point at the second place is not
/// added.
void add_divided(std::span<const Vec2> points, const Cycle& loop, std::size_t from, std::size_t to, int sides,
                 std::vector<Vec2>& divided);

/// The points between a and b that divide the line into sides whose lengths are proportional to the size.
std::vector<Vec2> points_between(const Vec2& a, const Vec2& b, std::size_t sides, const SizeField& size);

/// The angle inside the region at a place of a loop [radians].
double corner_angle(std::span<const Vec2> points, const Cycle& loop, std::size_t place);

/// The angles at all places of a loop [radians].
std::vector<double> corner_angles(std::span<const Vec2> points, const Cycle& loop);

/// Twice the area within a loop, > 0 where it runs counter-clockwise.
double twice_area(std::span<const Vec2> points, const Cycle& loop);

/// Call `visit(from, to)` with the nodes of every side, loop after loop.
template <class Visit>
void for_sides_of(const std::vector<Cycle>& loops, const Visit& visit)
{
    for (const Cycle& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) visit(loop[i], loop[(i + 1) % loop.size()]);
    }
}

/// Call `visit` with the end points of every side of a region's boundary.
template <class Visit>
void for_boundary_sides(const PlanarRegion& region, const Visit& visit)
{
    for_sides_of(region.loops,
                 [&](Index from, Index to) { visit(region.points[index(from)], region.points[index(to)]); });
}

/// A point at a height above a position of a loop. The direction is perpendicular to the mean of the
/// directions of the two sides there.
Vec2 point_above(std::span<const Vec2> points, const Cycle& loop, std::size_t place, const SizeField& height);

/// The region inside loops of a mesh.
struct RegionWithin {
    PlanarRegion region;
    std::vector<Index> own; ///< for each point of the region, its number in the mesh
};
RegionWithin region_within(std::span<const Vec2> points, const std::vector<Cycle>& loops,
                           const SizeField& size = {});

/// Add quads over a region made by `region_within()` to the mesh.
/// @param own    for each point of the region, its number in the mesh.
/// @param inner  points inside the region; they are added to the mesh.
void add_filling(std::vector<Vec2>& points, std::vector<Quad>& quads, const std::vector<Index>& own,
                 std::span<const Vec2> inner, std::span<const Quad> filling);
void add_filling(PlanarQuads& mesh, const std::vector<Index>& own, const PlanarQuads& filling);

/// Remove points that no quad uses, except the first `fixed` ones. The other points are renumbered in the
/// order of their first use.
void drop_loose_points(PlanarQuads& mesh, std::size_t fixed);

} // namespace lacuna::quads
