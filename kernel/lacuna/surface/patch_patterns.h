// SPDX-License-Identifier: MIT
#pragma once

/// Quads for patches with few corners; only sources of this folder include it.

#include <lacuna/core/types.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::surface {

/// Quads that fill a loop.
struct Filling {
    std::vector<Vec2> inner; ///< points added; they have the numbers after the loop's
    std::vector<Quad> quads; ///< counter-clockwise
    int irregular = 0;       ///< inner points without four quads
};

/// The ways to fill a loop of two to six corners with the fewest irregular points, at most `most`, the likeliest first.
///
///      4 sides, opposite ones alike: a grid.
///      3 or 5 sides: a grid for every corner, round one point with three or five quads.
///      2, 4 or 6 sides, else: one cut that leaves 3 and 3, 3 and 5 or 5 and 5; straight and square to the sides where it may be.
///
/// At a corner there is one quad of the patch, at other points of the loop two.
/// @param loop     in order, the patch on the left
/// @param corners  places in the loop, rising
std::vector<Filling> fillings(std::span<const Vec2> loop, std::span<const std::size_t> corners,
                              std::size_t most);

/// Irregular points at most of what `fillings()` finds, where it finds one; a large number for other numbers of corners.
int fewest_irregular(std::size_t loop, std::span<const std::size_t> corners);

} // namespace lacuna::surface
