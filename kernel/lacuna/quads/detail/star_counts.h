// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/counted_loop.h>

#include <optional>
#include <vector>

namespace lacuna::quads {

/// Numbers of edges for a region with three or five sides (from corner to corner), each of which is one
/// segment, straight or round. With these numbers, `fill_template()` fills the region with one grid at each
/// corner, around a common node.
///
/// On a triangle, such grids have more quads than the size requires, so edges are made longer. On a pentagon
/// they have fewer quads, so edges are made shorter. If there are still too many or too few quads, the
/// numbers may deviate from the wanted ones as much as on a ring (`kRingSegment`).
///
/// Candidates are numbers near several multiples of the wanted numbers that are symmetric under all
/// reflections of the region. The best candidate minimises the sum of (n − wanted)² / n over the sides, plus
/// a quarter of (quads − wanted quads)² / (wanted quads).
/// @return empty if the region has no such sides, a grid would be narrow, or no numbers fit.
std::optional<std::vector<int>> star_counts(const CountTask& task);

} // namespace lacuna::quads
