// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <optional>

namespace lacuna::quads {

/// Fill a region whose outline turns by right angles with the grid inside the corresponding polygon of grid
/// squares (submapping).
///
/// 1. Each boundary node is classified by its angle as an end, a side, a corner or a reversal, see
///    `grid_quads()`.
/// 2. Walking along a loop gives every node integer grid coordinates. In these coordinates, the outer loop
///    must close and turn once counter-clockwise, and a hole must close and turn once clockwise.
/// 3. A hole is placed in the grid: the grid coordinates of the outline are interpolated at the hole's nodes
///    by mean values (Floater 2003) and rounded.
/// 4. The grid cells within the loops become the quads. Inner nodes start between the boundary nodes of their
///    row and column, and are smoothed.
///
/// Follows White, Mingwu, Benzley & Sjaardema (1995), but does not change the numbers of edges, because a
/// region's boundary nodes are given. The two sides of a pointed notch may lie on one line of the grid, as a
/// slit.
/// @return empty in these cases: the angles fit no such polygon; the numbers of sides in opposite directions
///         differ; the grid overlaps itself; a quad would fold.
/// @pre   loops as `pave()` requires them.
/// @note  Deterministic. O(quads), and O(outer nodes × hole nodes) for holes.
std::optional<PlanarQuads> submap(const PlanarRegion& region, const RunContext& context = {});

/// Number of quads of a grid that suit a boundary node with the given inner angle: 1 at an end (about 90°), 2
/// on a side (180°), 3 at a corner (270°), 4 at a reversal (360°). 0 if the angle is too sharp for an end.
/// @param angle  from 0 to 2π [radians].
int grid_quads(double angle);

} // namespace lacuna::quads
