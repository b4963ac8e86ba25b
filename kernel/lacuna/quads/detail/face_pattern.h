// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <vector>

namespace lacuna::quads {

/// Fill a region with one grid, or a few, bent so that grid lines follow the boundary. All suitable ways are
/// tried.
///
/// 1. Every boundary side gets one of four headings, by dynamic programming over its direction and the angles
///    at its ends. Directions are measured from circles around a hole, or from the region's main direction.
/// 2. If the headings turn and the boundary does not, the turn is soft: one to three rows of quads are placed
///    along the boundary up to the next corners, and the grid turns behind these rows, at a node of three
///    quads where the region bulges, of five where it is bent inward. These are the only irregular nodes, so
///    there are as few as the boundary's corners allow.
/// 3. Soft turns are moved along the loop until it closes in the grid; then other turns, as long as no angle
///    falls below 54° or exceeds 126°.
/// 4. Holes are placed in the grid at the interpolated grid coordinates of the boundary.
/// 5. The grid's cells within the loops are the quads. Inner nodes are smoothed.
///
/// A ring whose loops have different numbers of sides gets rows that change their number of sides, or fewer
/// rows where it is narrow.
///
/// An outline without holes, with three to six corners, that fits no such grid gets one grid at each corner:
/// a triangle, a sector, a pentagon, a rectangle with unequal numbers of sides (`patch_template`).
///
/// So a disc gets a square within rows. A ring whose loops have equal numbers of sides gets rows only. Slots,
/// rounded rectangles, plates with holes and flanges get one grid with four irregular nodes for each round
/// loop.
/// Ends of 135° are tried as soft turns first. Unless a mesh of nearly square quads is found, they are then
/// tried as hard turns, and after that headings with fewer soft turns that fit almost as well, as at the
/// blunt end of a slit.
/// @return valid meshes, the most promising first: those with lines around a hole, then those with straight
///         lines, by number of rows. The search ends after a mesh that is as good as such meshes get. Empty
///         if the numbers of sides fit no grid or quads would fold.
/// @pre   loops as `pave()` requires them.
/// @note  Deterministic. O(quads), plus O(outer nodes × hole nodes), for each way.
std::vector<PlanarQuads> fill_patterns(const PlanarRegion& region, const RunContext& context = {});

} // namespace lacuna::quads
