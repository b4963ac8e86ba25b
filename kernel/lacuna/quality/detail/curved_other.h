// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quality/detail/other_cells.h>
#include <lacuna/quality/shared/second_order.h>

#include <optional>
#include <span>

namespace lacuna::quality {

/// Measure a wedge, pyramid or tetrahedron of order 2. Internal to this folder.
///
/// The cell is the image of the unit cube with a side or the top collapsed. On the cube the map is
/// triquadratic, so the Bézier coefficients of the Jacobian follow as in `judge()`. The collapse adds factors
/// to the Jacobian: 1 - v for a triangle, (1 - w)² for an apex. The Jacobian is divided by these factors and
/// then tested as in `judge()`. The scaled Jacobian is the smallest at the corners, computed from the
/// tangents of the edges there.
/// @param nodes  the nodes of a hex20 with merged corners. Middle nodes of merged edges are repeated; the
///               middle node of a collapsed edge is its corner. The centre of a pyramid's base may follow.
/// @return  empty if the cell has the shape of a cell of order 1.
std::optional<CurvedCell> judge_other(CellKind kind, std::span<const Vec3> nodes, int max_depth = 4);

} // namespace lacuna::quality
