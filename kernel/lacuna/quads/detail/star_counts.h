// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/counted_loop.h>

#include <optional>
#include <vector>

namespace lacuna::quads {

/// Numbers of sides for a region with three or five sides, each of which is one segment, straight or round.
/// With these numbers, `fill_template()` fills the region with one grid at each corner, around a common node.
///
/// On a triangle, such grids have more quads than the size requires, so edges are made longer. On a pentagon
/// they have fewer quads, so edges are made shorter. If there are still too many or too few quads, the
/// numbers of sides may deviate from the wanted ones as much as on a ring.
///
/// Candidates are grids whose sides are near several multiples of the wanted numbers, and whose numbers
/// respect all reflections. The best one minimises the sum of (n − wanted)² / n over the sides, plus a
/// quarter of (quads − wanted quads)² / (wanted quads).
/// @return empty if the region is no such patch, a grid would be narrow, or no numbers fit.
std::optional<std::vector<int>> star_counts(const CountTask& task);

} // namespace lacuna::quads
