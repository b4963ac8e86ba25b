// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/counted_loop.h>

#include <optional>
#include <vector>

namespace lacuna::quads {

/// Numbers of sides for a region of three or five straight or round sides, each one segment, that grids round
/// one node fill: one at each corner, `fill_template()`.
///
/// Such grids have more quads than the size asks for over a triangle and fewer over a pentagon, so the sides
/// get longer or shorter; where there would still be too many or too few, by as much as those of a ring may.
/// Of numbers near a few shares of those wanted, which no mirroring changes, those of the least sum of
/// (n − wanted)² / n over the sides and a quarter of (quads − asked)² / asked.
/// @return nothing where the region is no such patch, a grid would be narrow, or no numbers fit.
std::optional<std::vector<int>> star_counts(const CountTask& task);

} // namespace lacuna::quads
