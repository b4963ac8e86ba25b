// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/region_loops.h>

namespace lacuna::quads::paving {

/// Row height correction: move the nodes of the first row so that its quads stand upright on the boundary at
/// the height asked. Smoothing alone makes rows too high where sides bend away.
///
/// Only the inner neighbour of a boundary node with two quads is moved, and only if the worst quad around it
/// stays good or does not get worse. If the row is within the promised height already, no quad may get worse.
void correct_row_heights(PlanarQuads& mesh, const PlanarRegion& region, const SizeField& height);

} // namespace lacuna::quads::paving
