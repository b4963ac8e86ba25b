// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <vector>

namespace lacuna::quads {

/// Fill a region with one grid, or a few, bent so that lines run along the boundary, in every way that goes.
///
/// 1. Every boundary side gets one of four headings, by dynamic programming over its direction and the angles
///    at its ends. Directions are counted from circles round a hole, or from the region's main direction.
/// 2. Where the headings turn and the boundary does not, the turn is soft. Along the part of the boundary up
///    to its next corners one to three rows of quads are laid, and the grid turns behind them: in a node of
///    three quads where the region bulges, of five where it is bent inward. These are the only irregular
///    nodes, so that there are as few as the boundary's corners allow.
/// 3. Soft turns are moved along until every loop closes in the grid; then others, where no angle gets below
///    54° or above 126°.
/// 4. Holes are placed in the grid where the boundary's own grid coordinates, interpolated, put them.
/// 5. The grid's cells within the loops are the quads. Inner nodes are smoothed.
///
/// A ring whose loops have unlike numbers of sides has rows that change theirs, or a part with fewer rows
/// where it is narrow.
///
/// An outline without holes, of three to six corners, that fits no such grid gets one at each corner: a
/// triangle, a sector, a pentagon, a rectangle with unlike numbers of sides (`patch_template`).
///
/// A disc so gets a square within rows; a ring whose loops have as many sides each gets rows alone; slots,
/// rounded rectangles, plates with holes and flanges get one grid with four irregular nodes for each round
/// loop.
/// Ends of 135° are tried as soft turns and, where those are too many for the quads asked, as hard ones.
/// Where headings with fewer soft turns fit hardly worse, as at the blunt end of a slit, they are tried last.
/// @return valid meshes, the likeliest first: with lines round a hole, then straight ones, by rows; none
///         after one that is as good as such meshes get. None at all where the numbers of sides fit no
///         grid, or quads would fold.
/// @pre   loops as `pave()` demands them.
/// @note  Deterministic. O(quads), and O(outer nodes × hole nodes), for each way.
std::vector<PlanarQuads> fill_patterns(const PlanarRegion& region, const RunContext& context = {});

} // namespace lacuna::quads
