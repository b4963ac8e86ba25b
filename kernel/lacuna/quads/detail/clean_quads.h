// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <cstddef>
#include <functional>

namespace lacuna::quads {

struct CleanOptions {
    std::function<double(const Vec2&)> size; ///< target edge length [model length]; null: only shape counts
    /// Scaled Jacobian [-]. A change is refused if it makes a quad that is worse than this and also worse
    /// than the worst quad before.
    double least = 0.6;
    int largest_patch = 400; ///< maximum number of quads that are refilled at once, >= 4
    int passes = 4;          ///< number of passes over all irregular points, >= 1
    /// Whether a third search with larger limits follows the first two.
    bool thorough = true;
    /// Limits the total number of quads in all fillings that are tried: `effort` times the mesh's number of
    /// quads, plus 50,000 if `thorough`, otherwise plus 15,000.
    double effort = 3;
};

/// Change the connections of quads so that more interior points have valence 4, and more boundary points have
/// the valence that suits their angle. The boundary is not changed.
///
/// 1. Doublets are removed: an interior point of valence 2 is deleted, and its two quads become one.
/// 2. Patches are grown around irregular points until no corner of their outline is concave.
/// 3. Each patch is filled with the template of two to six sides that has the fewest irregular points (Bunin
///    2006; Verma and Suresh 2017). One template replaces many local changes (collapsed quads, swapped and
///    opened edges, collapsed chords). It also removes pairs of points of valence 3 and 5 that are far apart.
///
/// A filling is kept if the smoothed patch fulfils three conditions:
/// - all corners are positive;
/// - no quad is worse than both `options.least` and the worst quad before;
/// - the loss of quality, summed over the quads, is within a limit for each irregular point removed.
/// @param fixed  number of boundary points. They come first and are neither moved nor renumbered; other
///         points may be renumbered.
/// @pre   quads are counter-clockwise and conforming; some may be folded. Nothing is done if they do not
///        conform.
/// @post  the least scaled Jacobian is not smaller than before, or not smaller than `options.least`. Quads
///        merged at doublets are not checked.
/// @throw Cancelled
/// @note  Deterministic. Linear in the quads to check and in the quads changed.
void clean_quads(PlanarQuads& mesh, std::size_t fixed, const CleanOptions& options = {},
                 const RunContext& context = {});

} // namespace lacuna::quads
