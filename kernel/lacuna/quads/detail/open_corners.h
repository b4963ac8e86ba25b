// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

namespace lacuna::quads::paving {

/// Give every boundary node at least as many quads as its angle needs, so that no quad has a straight or
/// reflex corner there. For this, an edge nearby is swapped so that it ends at the node, or the widest quad
/// at the node is pillowed.
void open_corners(PlanarQuads& mesh, const PlanarRegion& region);

/// Pillow each quad whose smallest sine is at most `least`: put a smaller quad inside it and four quads
/// around that one. The new nodes can move.
void pillow_folds(PlanarQuads& mesh, double least);

} // namespace lacuna::quads::paving
