// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <optional>
#include <span>

namespace lacuna::quads {

/// How good the best grid is that `fill_patterns()` makes with other numbers of sides: `paving::score_of()`
/// of it, less what it costs that its quads are not as many as asked.
/// @param region   with a node at the start of every segment.
/// @param segment  of the side from each node to the next.
/// @param counts   sides of every segment.
/// @param asked    quads.
/// @return nothing where no grid is made.
/// @note  Nodes are divided evenly along the region's own sides, so round segments are taken a little flat.
std::optional<double> score_of_counts(const PlanarRegion& region, std::span<const int> segment,
                                      std::span<const int> counts, double asked);

} // namespace lacuna::quads
