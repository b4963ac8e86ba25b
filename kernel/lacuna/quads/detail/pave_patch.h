// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/pave_draft.h>

#include <span>

namespace lacuna::quads::paving {

/// Whether `fill_patch()` can fill a loop as one patch with its corners there.
/// @param cycle    the outline, counter-clockwise, of an even number of nodes.
/// @param corners  2 to 6 positions in the cycle, rising: where the patch's sides meet.
bool can_fill(const Draft& draft, const Cycle& cycle, std::span<const std::size_t> corners);

/// Fill a patch by its template (`fill_template()`): grids that meet in two irregular nodes at most.
/// @return false, and nothing changed, where the numbers of edges have no template.
bool fill_patch(Draft& draft, const Cycle& cycle, std::span<const std::size_t> corners);

/// Close a loop of 4 or 6 nodes by the template that suits its shape best. @pre cycle.size() is 4 or 6
void fill_small(Draft& draft, const Cycle& cycle);

} // namespace lacuna::quads::paving
