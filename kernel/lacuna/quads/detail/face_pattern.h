// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <optional>
#include <vector>

namespace lacuna::quads {

/// Fill a region with one grid, or with a few grids. Grids are bent so that their lines follow the boundary.
/// Several grids are tried; for each, the steps are:
///
/// 1. Every boundary side gets a heading, one of the four grid directions. Dynamic programming chooses the
///    headings that fit the directions of the sides and the angles between them (`head_loop()`). Directions
///    are measured relative to circles around a hole, or to the region's main direction.
/// 2. Where the headings turn but the boundary does not, the turn is soft: one to three rows of quads are
///    placed along the boundary up to the next corners, and the grid turns behind these rows. The grid then
///    has a node of valence 3 where the region bulges, and a node of valence 5 where the region is bent
///    inward. There are no other irregular nodes, so their number is the smallest that the boundary's corners
///    allow.
/// 3. Soft turns are moved along the loop until the loop closes in the grid. If that is not enough, other
///    turns are moved too, as long as all angles stay between 54° and 126°.
/// 4. Holes are placed in the grid at the interpolated grid coordinates of their boundary.
/// 5. The grid's cells within the loops become the quads. Inner nodes are smoothed.
///
/// A ring whose loops have different numbers of sides gets rows that change their number of quads, or fewer
/// rows where it is narrow.
///
/// An outline without holes that has three to six corners and fits no such grid gets one grid at each corner
/// (`patch_template`). Examples are a triangle, a sector, a pentagon, and a rectangle with unequal numbers of
/// sides.
///
/// For example, a disc gets a square within rows, and a ring whose loops have equal numbers of sides gets
/// rows only. Slots, rounded rectangles, plates with holes, and flanges get one grid each, with four
/// irregular nodes for each round loop.
///
/// Ends of 135° (nodes halfway between an end and a side, see `TurnStyle`) are tried as soft turns first.
/// Unless this gives a mesh of nearly square quads, they are tried as hard turns. After that, headings with
/// fewer soft turns that fit almost as well are tried (`TurnStyle::few_soft`), for example at the blunt end
/// of a slit.
/// @return  valid meshes, the most promising first: meshes with grid lines around a hole, then meshes with
///         straight grid lines, both in order of their number of rows. The search stops after a mesh that
///         cannot be improved much. Empty if the numbers of sides fit no grid, or quads would fold.
/// @pre   loops as `pave()` requires them.
/// @note  Deterministic. O(quads), plus O(outer nodes × hole nodes), for each grid that is tried.
std::vector<PlanarQuads> fill_patterns(const PlanarRegion& region, const RunContext& context = {});

/// Fill a narrow ring with rows around its hole, if the size gives fewer rows than requested. The quads are
/// longer than wide.
/// @param rows  number of rows between the loops, >= 1.
/// @return  empty if the region is not a ring whose loops have equal numbers of sides, if its size gives as
///         many rows anyway, or if some quad would be poor.
std::optional<PlanarQuads> fill_narrow_ring(const PlanarRegion& region, int rows, const RunContext& context);

} // namespace lacuna::quads
