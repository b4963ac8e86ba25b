// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <vector>

namespace lacuna::quads {

/// Fill a region with one grid, bent so that its lines run along the boundary, in every way that goes.
///
/// 1. Every boundary side gets one of four headings, by dynamic programming over its direction and the angles
///    at its ends. Directions are counted from circles round a hole, or from the region's main direction.
/// 2. Where the headings turn and the boundary does not, the turn is soft. Along the part of the boundary up
///    to its next corners one to three rows of quads are laid, and the grid turns behind them: in a node of
///    three quads where the region bulges, of five where it is bent inward. These are the only irregular
///    nodes, so that there are as few as the boundary's corners allow.
/// 3. Soft turns are moved along until every loop closes in the grid.
/// 4. Holes are placed in the grid where the boundary's own grid coordinates, interpolated, put them.
/// 5. The grid's cells within the loops are the quads. Inner nodes are smoothed.
///
/// A ring whose loops have unlike numbers of sides has rows that change theirs, or a part with fewer rows
/// where it is narrow.
///
/// A disc so gets a square within rows; a ring whose loops have as many sides each gets rows alone; slots,
/// rounded rectangles, plates with holes and flanges get one grid with four irregular nodes for each round
/// loop.
/// @return valid meshes, the likeliest first: with lines round a hole, then straight ones, by rows. None
///         where the numbers of sides fit no grid, or quads would fold.
/// @pre   loops as `pave()` demands them.
/// @note  Deterministic. O(quads), and O(outer nodes × hole nodes), for each way.
std::vector<PlanarQuads> fill_patterns(const PlanarRegion& region, const RunContext& context = {});

} // namespace lacuna::quads
