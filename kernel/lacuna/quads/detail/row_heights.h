// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/region_loops.h>

namespace lacuna::quads::paving {

/// Row height correction: move the nodes of the first row so that its quads stand upright on the boundary, as
/// high as asked. Smoothing alone lets rows grow where sides bend away.
///
/// Only the inner neighbour of a boundary node with two quads is moved, and only where the worst quad around
/// it stays good or gets no worse; only the latter where the row is as high as is promised.
void correct_row_heights(PlanarQuads& mesh, const PlanarRegion& region, const SizeField& height);

} // namespace lacuna::quads::paving
