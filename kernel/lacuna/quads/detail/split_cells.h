// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/quad_repair.h>

namespace lacuna::quads {

/// Cut convex cells into convex quads without touching the boundary: what no rows, cuts or pairs can fill is
/// filled by this, always.
///
/// Every inner side is halved but for some, chosen so that each cell has an even number of whole ones: along short
/// ways through the mesh from one cell with an odd number of boundary sides to another. A cell with halved sides alone
/// becomes four quads, or three of a triangle; with two whole ones, two, three or, a triangle, five. All corners are below a
/// straight angle as long as the cells' are.
/// @pre  the boundary has an even number of sides; cells are convex, side to side, in one piece.
/// @note  Deterministic. O(cells log cells).
MixedMesh split_cells(const MixedMesh& mesh);

} // namespace lacuna::quads
