// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/region_loops.h>

namespace lacuna::quads::paving {

/// Correct row heights: move the inner nodes of the first row so that its quads are perpendicular to the
/// boundary and have the requested height. Smoothing alone makes rows too high where the boundary curves away
/// from the region.
///
/// For each boundary node with two quads, the inner neighbour is moved. No other node moves. A move is made
/// only if afterwards the worst quad around the moved node is good (`kGoodQuad`) or not worse than before. If
/// the row's height was already within `kRowOffHeight` of the requested height, the worst quad must not get
/// worse.
void correct_row_heights(PlanarQuads& mesh, const PlanarRegion& region, const SizeField& height);

} // namespace lacuna::quads::paving
