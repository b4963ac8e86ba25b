// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/counted_loop.h>

#include <optional>
#include <vector>

namespace lacuna::quads {

/// Numbers of sides for a region of three or five straight or round sides, one segment each, that
/// `fill_template()` fills with grids around one node, one grid at each corner.
///
/// Over a triangle such grids have more quads than the size asks for, over a pentagon fewer. So their edges
/// are made longer or shorter. If there are still too many or too few quads, the sides may deviate as far as
/// those of a ring. Candidates are grids whose sides are near several multiples of the wanted ones and whose
/// numbers respect all reflections. The best minimises the sum of (n − wanted)² / n over the sides plus a
/// quarter of (quads − asked)² / asked.
/// @return empty if the region is no such patch, a grid would be narrow, or no numbers fit.
std::optional<std::vector<int>> star_counts(const CountTask& task);

} // namespace lacuna::quads
