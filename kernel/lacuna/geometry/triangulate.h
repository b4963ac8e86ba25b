// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace lacuna::geometry {

/// A triangulated part of the plane.
struct Triangulation {
    std::vector<Vec2> points;        ///< the given ones first, unchanged, then those added
    std::vector<Triangle> triangles; ///< counter-clockwise
};

/// Options of `triangulate()`. Lengths are in the units of the points.
struct TriangulateOptions {
    bool interior_points = true; ///< false: the given points alone
    std::function<double(const Vec2&)>
        size{}; ///< wanted edge length, > 0; combined with the rim's by the lesser
    /// How fast edges may grow with the distance to the rim [length per length, >= 0]: the wanted length at x
    /// is the least of (spacing at p) + grading × |x − p| over the rim points p. 0: as fine as the finest
    /// spacing all over; infinity: the rim does not count, only `size`.
    double grading = 0.2;
    std::size_t max_points = 1'000'000; ///< refinement stops at this many added points
};

/// Constrained Delaunay triangulation of the region within closed loops.
///
/// Loops come in any order and direction: a loop inside no other is an outer one, one inside an outer loop
/// is an island, and so on alternately. The loops' segments stay as they are: every one is a triangle side,
/// and no point is added on them. Inside, points are added frontally, by Delaunay refinement with
/// size-bound off-centres (Rebay 1993; Üngör 2004), where a triangle is larger than wanted or has a
/// circumradius above √2 × its shortest side, unless the point would fall within the diametral circle of
/// a rim segment, which could only be cured by splitting it. Every point added keeps a distance from
/// all it sees, so the refinement ends.
///
/// @param loops  point numbers in walking order, the first not repeated; at least 3 each, no point twice.
///               Points in no loop are handed through and not used.
/// @throw InvalidInput  a loop of fewer than 3 points or all in line, a point that does not exist or is not
///                      finite, loops that cross or touch; names the loops, counted from 1. Cancelled.
/// @note  Deterministic; orientation and circle tests are exact. O(n log n) in practice.
Triangulation triangulate(std::span<const Vec2> points, std::span<const std::vector<Index>> loops,
                          const TriangulateOptions& options = {}, const RunContext& context = {});

/// Two segments that may not meet but do; segment k of a loop runs from its point k to the next.
struct LoopCrossing {
    std::size_t loop_a, segment_a, loop_b, segment_b;
};

/// The first pair of segments (by loop, then segment) that cross, touch without being neighbours or overlap,
/// decided exactly; nothing where the loops are clean.
/// @note  O(n log n) for segments that do not crowd.
std::optional<LoopCrossing> find_crossing(std::span<const Vec2> points,
                                          std::span<const std::vector<Index>> loops);

} // namespace lacuna::geometry
