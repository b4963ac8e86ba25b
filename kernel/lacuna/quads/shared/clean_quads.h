// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <cstddef>
#include <functional>

namespace lacuna::quads {

struct CleanOptions {
    std::function<double(const Vec2&)>
        size;           ///< edge length asked for [model length]; none: shape alone counts
    double least = 0.6; ///< below it no change may make a quad worse than the worst was: scaled Jacobian [-]
    int largest_patch = 400; ///< quads refilled at once, >= 4
    int passes = 4;          ///< over all irregular points, >= 1
    bool thorough = true;    ///< look again with more patience; where not, 15,000 below for 50,000
    double effort = 3;       ///< quads in fillings tried: so many times those of the mesh, and 50,000
};

/// Change the connections of quads so that more interior points have four quads, and boundary points as many
/// as right angles fit in. The boundary stays as it is.
///
/// Doublets are removed first. Then patches around irregular points are grown until no corner is concave, and
/// filled with the template of two to six sides that has the fewest irregular points (Bunin 2006; Verma and
/// Suresh 2017). Templates do at once what collapsed quads, swapped and opened edges and collapsed chords do
/// one by one, and bring points of three and of five quads together over any distance. A change stays when,
/// after smoothing, its corners are positive, none is worse than both `options.least` and the worst there
/// was, and its quads lose little in sum for the irregular points it removes.
/// @param fixed  points on the boundary: the first ones, neither moved nor renumbered; the others may be.
/// @pre   quads counter-clockwise and conforming; some may be folded. Where they do not conform nothing
///        is done.
/// @post  the least scaled Jacobian is not smaller than before or than `options.least`, whichever is less.
///        Quads merged at doublets are not looked at.
/// @throw Cancelled
/// @note  Deterministic. Linear in the quads to look at, and in what is changed.
void clean_quads(PlanarQuads& mesh, std::size_t fixed, const CleanOptions& options = {},
                 const RunContext& context = {});

} // namespace lacuna::quads
