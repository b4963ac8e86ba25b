// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/quad_mesher.h>

#include <cstddef>
#include <functional>

namespace lacuna::surface {

struct CleanOptions {
    std::function<double(const Vec2&)>
        size;                ///< edge length asked for [model length]; none: shape alone counts
    double least = 0.5;      ///< what a change makes worse must not fall below this scaled Jacobian [-1, 1]
    int largest_patch = 400; ///< quads filled anew at once, >= 4
    int passes = 4;          ///< over the whole mesh, >= 1
};

struct CleanReport {
    std::size_t irregular_before = 0, irregular_after = 0; ///< interior points without four quads
    std::size_t doublets = 0;                              ///< points with two quads alone that went
    std::size_t swaps = 0;                                 ///< sides turned
    std::size_t collapses = 0; ///< quads pressed to nothing between two of their corners
    std::size_t patches = 0;   ///< patches filled anew with fewer irregular points
};

/// Change which points the quads join, so that more of them have four quads, and boundary points as many as right angles fit
/// in; the boundary stays as it is.
///
/// Local moves first: points with two quads go, sides turn, quads collapse. Then patches around irregular points are grown
/// until no corner is concave and filled with the pattern of 3, 4, 5 or 6 sides that has the fewest irregular
/// points (Verma and Suresh 2017; Bunin 2006), which brings points of three and five quads together over any distance.
/// A change stays when, smoothed, its corners are positive and neither its worst quad nor the mean suffers.
/// @param fixed  points on the boundary: the first ones, not moved nor renumbered; the others may be.
/// @pre   a valid mesh of quads, counter-clockwise; some corners may be folded.
/// @post  the least scaled Jacobian is not smaller than before.
/// @throw Cancelled
/// @note  Deterministic. Linear in the quads to look at, and in what is changed.
CleanReport clean_quads(PlanarQuads& mesh, std::size_t fixed, const CleanOptions& options = {},
                        const RunContext& context = {});

} // namespace lacuna::surface
