// SPDX-License-Identifier: MIT
#pragma once

/// Rings whose loops have unlike numbers of sides, or are not about one centre. Only sources of this folder
/// include it.

#include <lacuna/quads/detail/pattern_loop.h>

#include <span>
#include <vector>

namespace lacuna::quads {

/// How wide a ring is along its outer loop.
struct RingWidths {
    double least = 0, most = 0; ///< [model length]
    std::size_t narrowest = 0;  ///< the outer loop's node there
    std::size_t half = 0; ///< nodes from there to where the width is half way to the widest, on the mean

    /// By how many rows of a height the narrow part of the ring should be lower than the rest, so that all
    /// are about as high; 0 where plain rows have heights that `measure_plane()` takes for the size asked.
    [[nodiscard]] int steps(double height) const;
    /// Rows of a height, on the mean, less one: those in which sides may be added or taken away.
    [[nodiscard]] int changing(double height) const;
};

/// @pre  the loops have a node each. O(outer nodes × inner nodes).
RingWidths ring_widths(std::span<const Vec2> points, const std::vector<Index>& outer,
                       const std::vector<Index>& inner);

/// Whether a loop runs round without a turn.
bool runs_round(const PatternLoop& loop);

/// Let a loop that runs round step inward by some rows on the part within `half` nodes of `middle`, and out
/// again: two soft turns each way. It is then shorter along by twice as many sides.
/// @return false where the part is too short.
bool step_in(PatternLoop& loop, std::size_t middle, std::size_t half, int rows);

/// Lay rows along a loop that runs round until it has another number of sides.
///
/// The first row is as long as the loop, so that no irregular node lies on the boundary. In the next ones
/// each of `corners` nodes, evenly apart, is an end of the grid or a corner of it, which takes two sides from
/// the row or adds two. That leaves a node of three quads and one of five for each of them, as many rows
/// apart as it changed. Rows get even sides.
/// @param by  sides more (> 0) or fewer, an even number.
/// @return false where the corners would meet.
bool change_sides(PatternLoop& loop, int by, int corners, std::vector<Vec2>& points, std::vector<Quad>& quads,
                  const SizeField& height);

} // namespace lacuna::quads
