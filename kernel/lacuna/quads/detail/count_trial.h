// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <optional>
#include <span>

namespace lacuna::quads {

/// Score of the best grid that `fill_patterns()` makes with other numbers of sides: its `paving::score_of()`,
/// minus a penalty if its number of quads differs from `asked`.
/// @param region   with a node at the start of every segment.
/// @param segment  segment of the side from each node to the next.
/// @param counts   number of sides of every segment.
/// @param asked    number of quads asked for.
/// @return empty if no grid can be made.
/// @note  Nodes are spaced evenly along the region's own sides, so round segments become slightly flatter.
std::optional<double> score_of_counts(const PlanarRegion& region, std::span<const int> segment,
                                      std::span<const int> counts, double asked);

} // namespace lacuna::quads
