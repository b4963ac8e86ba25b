// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/counted_loop.h>

#include <optional>

namespace lacuna::quads {

/// Options for the numbers of sides of a straight grid.
struct StraightOptions {
    CountRange range = kSegment; ///< allowed for segments
    bool is_part = false;        ///< whether the region is a part of another, with axes
    bool few = false;            ///< whether there are so few quads that lines may leave no place for holes
};

/// Numbers of sides for a straight grid: the cheapest with either soft or hard turns at ends of 135°. The
/// cost includes the deviation from the number of quads asked, because rows before soft ends add quads. Soft
/// ends give much better shaped quads than hard ones, so they may cost more. For a whole region with few
/// quads: the numbers whose grid has the best measured quality.
std::optional<Counts> straight_counts(const CountTask& task, const StraightOptions& options = {});

} // namespace lacuna::quads
