// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <array>
#include <set>
#include <span>
#include <vector>

/// Cuts through facets that close round, from one of their two rims to the other.
namespace lacuna::geometry {

/// Shortest way along sides of facets from a point to one of `ends`, off the points of `off` but for the
/// start. Empty where there is none. O(facets log).
/// @throw Cancelled
std::vector<Index> shortest_way(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                Index start, const std::set<Index>& off, const std::set<Index>& ends,
                                const RunContext& context = {});

/// Turns of the triangles' corners along a cut, as `HarmonicProblem::corner_turns` wants them: seen so that
/// the triangles are counter-clockwise and the cut leads upwards, corners on it are one turn on for the
/// triangles on its right. O(triangles).
/// @param cut  points, each joined to the next by a side.
std::vector<std::array<int, 3>> turns_along(std::span<const Triangle> triangles, std::span<const Index> cut);

} // namespace lacuna::geometry
