// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/counted_loop.h>

#include <optional>

namespace lacuna::quads {

/// Options for the numbers of sides of a straight grid.
struct StraightOptions {
    CountRange range = kSegment; ///< allowed range for the numbers of sides of segments
    bool is_part = false;        ///< whether the region is a part of another one, bounded by axes
    bool few = false; ///< whether there are so few quads that the grid lines may leave no room for holes
};

/// Numbers of sides for a straight grid: the cheaper result of soft and of hard turns at ends of 135°. The
/// cost includes the deviation from the wanted number of quads, because rows in front of soft ends add quads.
/// Soft ends give quads of much better shape than hard ends, so the result with soft ends may cost more. For
/// a whole region with few quads, the result is the numbers whose grid has the best measured quality.
std::optional<Counts> straight_counts(const CountTask& task, const StraightOptions& options = {});

} // namespace lacuna::quads
