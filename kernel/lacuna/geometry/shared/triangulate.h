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

/// A triangulated region of the plane.
struct Triangulation {
    std::vector<Vec2> points;        ///< the given ones first, unchanged, then the added ones
    std::vector<Triangle> triangles; ///< counter-clockwise
};

/// Options of `triangulate()`. Lengths are in the units of the points.
struct TriangulateOptions {
    bool interior_points = true; ///< false: use the given points only
    /// Upper limit of the target edge length at a point, > 0. Empty: no limit.
    std::function<double(const Vec2&)> size{};
    /// Growth of the target edge length with the distance from the rim [length per length, >= 0]. The target
    /// length at x is the minimum of `size` and of (spacing at p) + grading × |x − p| over all rim points p.
    /// With 0, the smallest spacing holds everywhere; with infinity, only `size` counts.
    double grading = 0.2;
    std::size_t max_points = 1'000'000; ///< refinement stops at this many added points
};

/// Constrained Delaunay triangulation of the region inside closed loops.
///
/// Loops may have any order and direction. A loop inside no other is an outer loop, a loop inside an outer
/// loop bounds a hole, a loop inside a hole is an outer loop again, and so on. The segments of the loops are
/// kept: each is a triangle side, and no point is added on them.
///
/// Inside, points are added by frontal Delaunay refinement with off-centres limited by the target size (Rebay
/// 1993; Üngör 2004). A triangle is refined if it is too large, or if its circumradius exceeds √2 × its
/// shortest side. It is not refined if the new point would lie inside the diametral circle of a rim segment:
/// only a point on the segment could improve such a triangle, and segments are kept. New points keep a
/// minimum distance from the points of the triangles that they replace, so the refinement terminates.
///
/// @param loops  point numbers in order, at least 3 for each loop; the first is not repeated, and no point
///               occurs twice. Points in no loop are returned but not used.
/// @throw InvalidInput  a loop has fewer than 3 points or only collinear ones, a point does not exist or is
///                      not finite, loops cross or touch; names the loops, counted from 1. Cancelled.
/// @note  Deterministic; orientation and circle tests are exact. O(n log n) in practice.
Triangulation triangulate(std::span<const Vec2> points, std::span<const std::vector<Index>> loops,
                          const TriangulateOptions& options = {}, const RunContext& context = {});

/// Two segments that intersect; segment k of a loop runs from its point k to the next.
struct LoopCrossing {
    std::size_t loop_a, segment_a, loop_b, segment_b;
};

/// The first pair of segments (by loop, then segment) that cross, overlap, or touch without being neighbours.
/// Decided exactly. Empty if there is none.
/// @note  O(n log n) if few segments are close to each other.
std::optional<LoopCrossing> find_crossing(std::span<const Vec2> points,
                                          std::span<const std::vector<Index>> loops);

} // namespace lacuna::geometry
