// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/pave_draft.h>

#include <array>
#include <span>

namespace lacuna::quads::paving {

/// Can `fill_patch()` fill a patch of 3, 4 or 5 sides of so many edges each?
bool can_fill(std::span<const std::size_t> sides);

/// Where on each side of a patch of 3 or 5 sides the line from its centre ends, in edges from the side's
/// start.
/// @pre can_fill()
std::vector<std::size_t> star_feet(std::span<const std::size_t> sides);

/// Fill a patch with grids that meet in few irregular nodes.
///
/// @param cycle    the outline, counter-clockwise.
/// @param corners  3 to 5 places in the cycle, rising: where its sides meet.
/// @return false, and nothing changed, where the numbers of edges do not go.
bool fill_patch(Draft& draft, const Cycle& cycle, std::span<const std::size_t> corners);

/// Close a loop of 4 or 6 nodes by the template that suits its shape best. @pre cycle.size() is 4 or 6
void fill_small(Draft& draft, const Cycle& cycle);

} // namespace lacuna::quads::paving
