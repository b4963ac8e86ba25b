// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/region_loops.h>

namespace lacuna::quads::paving {

/// Remesh the surroundings of folded quads with quads that are guaranteed to be convex.
///
/// The folded quads are removed together with two rings of neighbours, and with more rings until the cavities
/// have simple outlines; at worst a cavity is the whole region. `quads_of_triangles()` fills each cavity.
/// @param size  target edge length [length].
/// @return number of cavities filled; 0 if nothing is folded.
/// @post  all quads are convex, if `region`'s loops are simple and the mesh is conforming.
/// @note  Deterministic. O(quads), plus the filling.
int refill_cavities(PlanarQuads& mesh, const PlanarRegion& region, const SizeField& size);

} // namespace lacuna::quads::paving
