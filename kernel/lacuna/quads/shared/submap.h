// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <optional>

namespace lacuna::quads {

/// Fill a region whose outline turns by right angles with the grid inside the corresponding polygon of grid
/// squares (submapping).
///
/// By its angle, each boundary node is an end, a side, a corner or a reversal. Walking along a loop gives
/// every node integer grid coordinates. With these coordinates, the outer loop must close and turn once
/// counter-clockwise, and a hole must close and turn once clockwise. The position and rotation of a hole in
/// the grid follow from its location: the outline's grid coordinates are interpolated by mean values (Floater
/// 2003) and rounded. The grid's cells within the loops are the quads. Inner nodes start between the boundary
/// nodes of their row and column, and are smoothed.
///
/// Follows White, Mingwu, Benzley & Sjaardema (1995), but does not change the numbers of edges, because a
/// region's boundary nodes are given. The two sides of a pointed notch may lie on one line of the grid, as a
/// slit.
/// @return empty if the region is no such polygon, its numbers of sides do not close, its grid overlaps
///         itself, or a quad would fold.
/// @pre   loops as `pave()` requires them.
/// @note  Deterministic. O(quads), and O(outer nodes × hole nodes) for holes.
std::optional<PlanarQuads> submap(const PlanarRegion& region, const RunContext& context = {});

/// Number of quads that suit an inner angle in a grid: 1 at an end, 2 on a side, 3 at a corner, 4 at a
/// reversal. 0 if the angle is too far from all of these.
/// @param angle  from 0 to 2π [radians].
int grid_quads(double angle);

} // namespace lacuna::quads
