// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <array>
#include <set>
#include <span>
#include <vector>

/// Cuts through a strip of facets that is closed to a ring, from one of its two rims to the other.
namespace lacuna::geometry {

/// Shortest path along sides of facets from a point to one of `ends`. Except at its start, the path avoids
/// the points in `off`. Empty if there is no such path. O(facets log facets).
/// @throw Cancelled
std::vector<Index> shortest_way(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                Index start, const std::set<Index>& off, const std::set<Index>& ends,
                                const RunContext& context = {});

/// `HarmonicProblem::corner_turns` for a cut: 1 at the corners on the cut of those triangles that lie to the
/// right of the cut, seen along the cut with triangles counter-clockwise; 0 at all other corners.
/// O(triangles).
/// @param cut  points; consecutive ones are joined by a side of a triangle.
std::vector<std::array<int, 3>> turns_along(std::span<const Triangle> triangles, std::span<const Index> cut);

} // namespace lacuna::geometry
