// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/region_loops.h>

namespace lacuna::quads::paving {

/// Remesh the surroundings of folded quads with quads that are certainly convex.
///
/// The folded quads are removed together with two rings of neighbours, and more
/// rings until the cavities have simple outlines; at worst a cavity is the whole region. Each is filled by
/// `quads_of_triangles()`.
/// @param size  edge length to aim for [length].
/// @return how many cavities were filled; 0 where nothing is folded.
/// @post  all quads are convex, if `region`'s loops are simple and the mesh is conforming.
/// @note  Deterministic. O(quads), and what is filled.
int refill_cavities(PlanarQuads& mesh, const PlanarRegion& region, const SizeField& size);

} // namespace lacuna::quads::paving
