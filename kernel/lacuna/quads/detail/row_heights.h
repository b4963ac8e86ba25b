// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/region_loops.h>

namespace lacuna::quads::paving {

/// Correct row heights: move the nodes of the first row so that its quads stand upright on the boundary and
/// have the requested height. Smoothing alone makes rows too high where sides bend away.
///
/// The inner neighbour of a boundary node with two quads is moved; no other node is. It is moved only if the
/// worst quad around it stays good or does not get worse. If the row's height is already within the promised
/// tolerance, no quad may get worse.
void correct_row_heights(PlanarQuads& mesh, const PlanarRegion& region, const SizeField& height);

} // namespace lacuna::quads::paving
