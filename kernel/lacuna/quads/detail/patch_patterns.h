// SPDX-License-Identifier: MIT
#pragma once

/// Quads for patches with few corners; only sources of this folder include it.

#include <lacuna/quads/detail/patch_cuts.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::quads {

/// Quads that fill a loop.
struct Filling {
    std::vector<Vec2> inner; ///< points added; they have the numbers after the loop's
    std::vector<Quad> quads; ///< counter-clockwise
    int irregular = 0;       ///< inner points without four quads
};

/// Fill a loop of two to six corners with the fewest irregular points.
///
///      4 sides, opposite ones alike: a grid.
///      3 or 5 sides: a grid for every corner, round one point with three or five quads.
///      2, 4 or 6 sides, else: two parts of 3 and 3, 3 and 5 or 5 and 5 sides, on either side of the cut.
///
/// At a corner there is one quad of the patch, at other points of the loop two.
/// @param loop     in order, the patch on the left
/// @param corners  places in the loop, rising
/// @pre   the cut is one of `find_cuts()`
Filling fill(std::span<const Vec2> loop, std::span<const std::size_t> corners, const Cut& cut);

} // namespace lacuna::quads
