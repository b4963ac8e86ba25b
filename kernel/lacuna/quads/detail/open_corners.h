// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

namespace lacuna::quads::paving {

/// Give every boundary node at least as many quads as its angle needs, so that no corner is straight or
/// reflex: swap a nearby edge towards the node, or pillow its widest quad.
void open_corners(PlanarQuads& mesh, const PlanarRegion& region);

/// Pillow each quad whose least sine is at most `least`: a smaller quad inside it and four around that one,
/// which gives it nodes that can move.
void pillow_folds(PlanarQuads& mesh, double least);

} // namespace lacuna::quads::paving
