// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

namespace lacuna::quads::paving {

/// Give every boundary node at least as many quads as its angle needs. With fewer quads, one of them would
/// have a straight or reflex corner at the node. Either a nearby edge is swapped so that it ends at the node,
/// or the quad with the widest corner at the node is pillowed.
void open_corners(PlanarQuads& mesh, const PlanarRegion& region);

/// Pillow each quad whose smallest sine is at most `least`: put a smaller quad inside it, and surround this
/// smaller quad by four quads. The new nodes can move.
void pillow_folds(PlanarQuads& mesh, double least);

} // namespace lacuna::quads::paving
