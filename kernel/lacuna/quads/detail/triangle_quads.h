// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

namespace lacuna::quads {

/// Fill a region with quads made from triangles. This works for all simple loops. It is the last resort if
/// rows and cuts give folded quads.
///
/// Constrained Delaunay triangles of the requested size are merged in pairs that form convex quads, the best
/// pairs first. All cells are then split into quads (`split_cells()`). The quads are valid, but many and
/// irregular, so the caller should clean and smooth them.
/// @return no quads if loops touch.
/// @pre    the total number of edges of the loops is even.
/// @note   Deterministic. O(n log n) in practice.
PlanarQuads quads_of_triangles(const PlanarRegion& region);

} // namespace lacuna::quads
