// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <cstddef>

namespace lacuna::quads::paving {

/// Give every boundary node at least as many quads as its angle needs, so that none of its corners must be
/// straight or more: an edge nearby is swapped towards it, or its widest quad is pillowed.
void open_corners(PlanarQuads& mesh, const PlanarRegion& region);

/// Pillow each quad whose least sine is at most `least`: a smaller quad inside it and four around that, so
/// that it has nodes that can move.
void pillow_folds(PlanarQuads& mesh, double least);

/// Remove the points no quad uses, except the first `fixed` ones. Points are renumbered by their first use.
void drop_loose_points(PlanarQuads& mesh, std::size_t fixed);

} // namespace lacuna::quads::paving
