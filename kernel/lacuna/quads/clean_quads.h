// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <cstddef>
#include <functional>

namespace lacuna::quads {

struct CleanOptions {
    std::function<double(const Vec2&)>
        size; ///< edge length asked for [model length]; none: shape alone counts
    double least =
        0.6; ///< scaled Jacobian below which no change may leave a quad worse than the worst there was [-]
    int largest_patch = 400; ///< quads filled anew at once, >= 4
    int passes = 4;          ///< over all irregular points, >= 1
    double effort = 3;       ///< quads in fillings tried: so many times those of the mesh, and 50,000
};

struct CleanReport {
    std::size_t irregular_before = 0, irregular_after = 0; ///< interior points without four quads
    std::size_t doublets = 0;                              ///< points with two quads alone that went
    std::size_t patches = 0; ///< patches filled anew with fewer irregular points
    std::size_t tried = 0;   ///< patches filled for trial
};

/// Change which points the quads join, so that more of them have four quads, and boundary points as many as right angles fit
/// in; the boundary stays as it is.
///
/// Points with two quads go first. Then patches around irregular points are grown until no corner is concave and
/// filled with the pattern of two to six sides that has the fewest irregular points (Bunin 2006; Verma and Suresh 2017): what
/// collapses of quads, turned and opened sides and collapsed chords do one by one, and points of three and of five
/// quads are brought together over any distance. A change stays when, smoothed, its corners are positive, none is worse than
/// both `options.least` and the worst there was, and what its quads lose in sum is little for the irregular points they shed.
/// @param fixed  points on the boundary: the first ones, not moved nor renumbered; the others may be.
/// @pre   quads counter-clockwise, joined side to side; some may be folded. Where that is not so nothing is done.
/// @post  the least scaled Jacobian is not smaller than before or than `options.least`, whichever is less: it may fall from above
///        `options.least` down to there. Quads merged over points with two quads are not looked at.
/// @throw Cancelled
/// @note  Deterministic. Linear in the quads to look at, and in what is changed.
CleanReport clean_quads(PlanarQuads& mesh, std::size_t fixed, const CleanOptions& options = {},
                        const RunContext& context = {});

} // namespace lacuna::quads
