// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/counted_loop.h>

#include <optional>

namespace lacuna::quads {

/// Options for the numbers of sides of a straight grid.
struct StraightOptions {
    CountRange range = kSegment; ///< allowed range for the numbers of sides of segments
    bool is_part = false;        ///< whether the region is a part of another one, bounded by axes
    bool few = false; ///< whether there are so few quads that there may be no grid lines between holes
};

/// Numbers of sides for a straight grid. Both styles of turns at ends of 135° are tried, soft and hard (see
/// `TurnStyle`), and the cheaper result is used. The cost includes the deviation from the wanted number of
/// quads, because rows at soft turns add quads. Soft turns give quads of much better shape, so they may cost
/// more than hard turns. For a whole region with few quads, a grid is made for the cheapest results, and the
/// numbers of the grid with the best measured quality are used.
std::optional<Counts> straight_counts(const CountTask& task, const StraightOptions& options = {});

} // namespace lacuna::quads
