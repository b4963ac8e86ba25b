// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <optional>

namespace lacuna::quads {

/// Fill a region whose outline turns by right angles, as a polygon of squares does, with the grid inside that
/// polygon (submapping).
///
/// By its angle, each boundary node is an end, a side, a corner or a reversal. Walking along a loop gives
/// every node whole grid coordinates. In them the outer loop must close and turn once about, a hole the other
/// way. Position and turn of a hole in the grid follow from where it lies: the outline's grid coordinates,
/// interpolated by mean values (Floater 2003) and rounded. The grid's cells within the loops are the quads.
/// Inner nodes start between the boundary nodes of their row and column, and are smoothed.
///
/// Follows White, Mingwu, Benzley & Sjaardema (1995). The departure: numbers of edges are taken as they are,
/// for a region's nodes are given.
/// The two sides of a pointed notch may lie on one line of the grid, as a slit.
/// @return nothing where the region is no such polygon, its counts do not close, its grid overlaps itself, or
///         a quad would fold.
/// @pre   loops as `pave()` demands them.
/// @note  Deterministic. O(quads), and O(outer nodes × hole nodes) for holes.
std::optional<PlanarQuads> submap(const PlanarRegion& region, const RunContext& context = {});

/// How many quads suit an inner angle in a grid: 1 at an end, 2 on a side, 3 at a corner, 4 at a reversal. 0
/// where it is too far from all of them.
/// @param angle  from 0 to 2π [radians].
int grid_quads(double angle);

} // namespace lacuna::quads
