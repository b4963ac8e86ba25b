// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::geometry {

/// Options of `minimal_area()`. Costs are areas; the numbers without a unit weigh them.
struct MinimalAreaOptions {
    /// What a turn between two triangles costs: bend × (1 − cos turn) / 2 × (length of their side)².
    double bend = 0.1;
    /// What slender triangles cost: shape × (area of the equilateral triangle with the same sum of squared
    /// sides − own area). Decides among equal areas, as in a plane.
    double shape = 0.01;
    std::size_t exact_limit = 250; ///< loops of more points are cut up first; the work is cubic in this, >= 8
    std::size_t bridge_trials = 4; ///< ways to join several loops that are tried, the best is kept

    bool interior_points = true; ///< refine to the rim's spacing and fair; false: the given points alone
    double grading = 0.2;        ///< growth of the wanted side length with the distance to the rim, >= 0
    int fairing_steps = 6;       ///< rounds of harmonic placing; each lessens the area, few are left to gain
    std::size_t max_points = 200'000; ///< refinement stops at this many added points
};

/// A surface with a given boundary.
struct MinimalArea {
    std::vector<Vec3> points;        ///< the given ones first, unchanged, then those added inside
    std::vector<Triangle> triangles; ///< every boundary side runs as its loop does
    double area = 0;                 ///< [length²]
};

/// Span closed loops in space by a surface of small area: one connected piece with the loops as boundary.
///
/// One loop: the triangulation of least cost over all that use its points alone, by dynamic programming
/// @cite liepa_2003_holes with sums in place of his maximum. Several loops are joined to one by the
/// shortest bridges along a minimum spanning tree (Zou, Ju and Carr 2013 do without, at the price of a
/// search over all ways to part the loops), and sides doubled by that are flipped away. More points than
/// `exact_limit`: where the loops' shadow on their Newell plane is simple, its Delaunay triangles; else the
/// joined loop is spanned coarsely first, through points chosen by arc length and turning, then within each
/// coarse triangle's part of the loop. Then sides are halved until they have the length the rim asks for,
/// and points placed where the area is least for the triangles' angles (Pinkall and Polthier 1993), in turn
/// with Delaunay flips.
///
/// @param loops  point numbers in walking order, the surface on the left, the first not repeated; at least 3
///               each, no point twice in all.
/// @throw InvalidInput  such a loop is not given, or the loops cannot be joined to a manifold; names the
///         loop. Cancelled.
/// @note  Nothing keeps the surface from passing through itself where a loop is knotted or crumpled.
///        O(exact_limit² · n) for the triangles; deterministic.
MinimalArea minimal_area(std::span<const Vec3> points, std::span<const std::vector<Index>> loops,
                         const MinimalAreaOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::geometry
