// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::geometry {

/// Options of `minimal_area()`. Costs are areas; options without a unit are their weights.
struct MinimalAreaOptions {
    /// Cost of a bend between two triangles: bend × (1 − cos angle) / 2 × (length of their side)².
    double bend = 0.1;
    /// Cost of slender triangles: shape × (area of the equilateral triangle with the same sum of squared
    /// sides − area). Decides between triangulations of equal area, as in a plane.
    double shape = 0.01;
    std::size_t exact_limit = 250; ///< larger loops are divided first, as the cost is cubic in this, >= 8
    std::size_t bridge_trials = 4; ///< number of ways tried to connect several loops; the best is kept

    bool interior_points = true; ///< refine to the spacing of the rim; false: use the given points only
    double grading = 0.2;        ///< growth of the target side length with the distance from the rim, >= 0
    int fairing_steps = 6;       ///< rounds of harmonic smoothing; the gain decreases quickly
    std::size_t max_points = 200'000; ///< refinement stops after adding this many points
};

/// A surface with a given boundary.
struct MinimalArea {
    std::vector<Vec3> points;        ///< the given ones first, unchanged, then inner points
    std::vector<Triangle> triangles; ///< boundary sides have the direction of their loop
    double area = 0;                 ///< [length²]
};

/// Fill closed loops in space by a surface of small area: one connected patch with the loops as boundary.
///
/// One loop: the triangulation of least cost among all that use its points only, by dynamic programming
/// @cite liepa_2003_holes with sums in place of the maximum. Several loops are connected to one by the
/// shortest bridges along a minimum spanning tree, and sides duplicated by that are flipped. (Zou, Ju and
/// Carr 2013 avoid bridges by searching all partitions of the loops.) More points than `exact_limit`: if the
/// projection of the loops to their Newell plane is simple, its Delaunay triangles are used; else a coarse
/// polygon, with corners chosen by arc length and turning, is triangulated first, then the part of the loop
/// in each coarse triangle. Then sides are split to the length given by the rim, and points are placed to
/// minimise the area for the present angles (Pinkall and Polthier 1993), alternating with Delaunay flips.
///
/// @param loops  point numbers in order, surface on the left, the first not repeated; at least 3 points in
///               each, no point twice.
/// @throw InvalidInput  a loop violates this, or the loops cannot be connected to a manifold; names the loop.
///         Cancelled.
/// @note  The surface may intersect itself if a loop is knotted or very irregular.
///        O(exact_limit² · n) for the triangulation; deterministic.
MinimalArea minimal_area(std::span<const Vec3> points, std::span<const std::vector<Index>> loops,
                         const MinimalAreaOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::geometry
