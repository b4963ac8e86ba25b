// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <optional>

namespace lacuna::quads {

/// Fill a region whose outlines turn as a polygon of squares does with the grid inside that polygon (submapping).
///
/// Each boundary node is an end, a side, a corner or a reversal by its angle. Walking along a loop gives every node
/// whole grid coordinates; an outer loop must close in them and turn once about, a hole the other way. A hole's place and
/// turn in the grid follow from where it lies: the outline's coordinates, carried inward by mean values (Floater 2003), rounded.
/// The grid's cells within are the quads; inner nodes start half way between the lines of their row and column, and are
/// smoothed.
///
/// With `round_loops`, a loop without right angles gets a row of quads, and four nodes of the row's inner side are
/// its corners: where a square lies nearest to where the hole is in the grid. Four irregular nodes a loop are all there are.
///
/// Follows White, Mingwu, Benzley & Sjaardema (1995); the departure is that counts are taken as they are, for a region's nodes
/// are given: `seed_source()` makes them agree beforehand.
/// @return nothing where the region is no such polygon, its counts do not close, its grid overlaps or touches itself, or
///         a quad would fold.
/// @pre   loops as `pave()` wants them.
/// @note  Deterministic. O(quads), and O(outer nodes × hole nodes) for holes.
std::optional<PlanarQuads> submap(const PlanarRegion& region, bool round_loops = false,
                                  const RunContext& context = {});

/// How many quads suit an inner angle: 1 an end, 2 a side, 3 a corner, 4 a reversal; 0 where it lies too far from all of
/// them for a grid [radians, 0…2π].
int grid_quads(double angle);

} // namespace lacuna::quads
