// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <cstddef>

namespace lacuna::quads::paving {

/// Give every boundary node as many quads as its angle cannot do without, so that no corner at it must be
/// straight or more: a side nearby is turned towards it, or a quad at it is surrounded by four others.
/// @return how many changes were made.
int open_corners(PlanarQuads& mesh, const PlanarRegion& region);

/// Move the inner nodes of folded or flat quads, one at a time, to where the worst quad around is better:
/// what straight lines made flat opens at once, and less is left to untangle.
void ease_folds(PlanarQuads& mesh, std::size_t fixed);

/// Surround each quad with a corner that is not positive by four quads, whose new nodes can move.
/// @return how many quads were.
int loosen_folds(PlanarQuads& mesh, double least);

/// Points no quad uses go, but the first `fixed` ones.
void drop_loose_points(PlanarQuads& mesh, std::size_t fixed);

} // namespace lacuna::quads::paving
