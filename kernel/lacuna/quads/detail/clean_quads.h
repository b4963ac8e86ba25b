// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <cstddef>
#include <functional>

namespace lacuna::quads {

struct CleanOptions {
    std::function<double(const Vec2&)> size; ///< target edge length [model length]; none: only shape counts
    /// Scaled Jacobian [-]; no change may produce a quad below both this and the previous worst.
    double least = 0.6;
    int largest_patch = 400; ///< limit of quads refilled at once, >= 4
    int passes = 4;          ///< over all irregular points, >= 1
    /// Search a third time, with larger limits, and use a base budget of 50,000 quads; otherwise 15,000.
    bool thorough = true;
    /// Budget of quads in all tried fillings: this many times the mesh's quads, plus the base budget.
    double effort = 3;
};

/// Change the connections of quads so that more interior points have four quads, and more boundary points
/// have as many as right angles fit in their angle. The boundary stays as it is.
///
/// Doublets are removed first. Then the function grows patches around irregular points until no corner is
/// concave, and fills each with the template of two to six sides that has the fewest irregular points (Bunin
/// 2006; Verma and Suresh 2017). One template replaces many local changes (collapsed quads, swapped and
/// opened edges, collapsed chords) and pairs points of three and of five quads over any distance. After
/// smoothing, a change is kept if its corners are positive, no quad is worse than both `options.least` and
/// the previous worst, and the quality lost, summed over the quads, is within a limit per irregular point
/// removed.
/// @param fixed  number of boundary points. They come first and are neither moved nor renumbered; other
///               points may be.
/// @pre   quads are counter-clockwise and conforming; some may be folded. Nothing is done if they do not
///        conform.
/// @post  the least scaled Jacobian is not smaller than before, or not smaller than `options.least`. Quads
///        merged at doublets are not checked.
/// @throw Cancelled
/// @note  Deterministic. Linear in the quads to check and in the quads changed.
void clean_quads(PlanarQuads& mesh, std::size_t fixed, const CleanOptions& options = {},
                 const RunContext& context = {});

} // namespace lacuna::quads
