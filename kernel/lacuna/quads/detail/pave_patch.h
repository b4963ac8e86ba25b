// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/partial_mesh.h>

#include <span>

namespace lacuna::quads::paving {

/// Fill a patch by its template (`fill_template()`), without a cut.
/// @param cycle    the outline, counter-clockwise.
/// @param corners  3 to 5 positions in the cycle, ascending, at which the patch's sides meet.
/// @return false, with nothing changed, if no template has these numbers of edges.
bool fill_patch(PartialMesh& partial, const Cycle& cycle, std::span<const std::size_t> corners);

/// Close a loop of 4 or 6 nodes by the template that suits its shape best. @pre cycle.size() is 4 or 6
void fill_small(PartialMesh& partial, const Cycle& cycle);

} // namespace lacuna::quads::paving
