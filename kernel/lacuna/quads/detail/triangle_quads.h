// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

namespace lacuna::quads {

/// Fill a region with quads by way of triangles. It always works where the loops are simple, so it is the
/// last resort where rows and cuts fold.
///
/// Constrained Delaunay triangles of the asked size are merged in pairs where that gives convex quads
/// (greedily, then by augmenting paths), and all cells are split into quads (`split_cells()`). These are
/// valid, but many and irregular: clean and smooth them.
/// @return no quads where loops touch.
/// @pre    the loops have an even number of edges in sum.
/// @note   Deterministic. O(n log n) in practice.
PlanarQuads quads_of_triangles(const PlanarRegion& region);

} // namespace lacuna::quads
