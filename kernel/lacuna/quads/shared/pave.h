// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <string>

namespace lacuna::quads {

/// The method by which `pave()` filled a region.
struct PaveReport {
    std::string used; ///< "mapped": one patch without rows; "submapped", "paved"
};

/// Options of `pave()`.
struct PaveOptions {
    /// Rows to place along every loop first, at the height `PlanarRegion::row_height`. They are not moved
    /// afterwards. A loop without room for a row gets none, which `PlanarQuads::how` reports. Rows that are
    /// not exact are placed where the region's shape requires them, and may move.
    int exact_rows = 0;
    bool grids = true; ///< whether one grid may fill the region
};

/// The mesh of `pave()` and how it was made.
struct Paved {
    PlanarQuads mesh;
    PaveReport report;
};

/// Fill a region of the plane with quads by paving. Rows are placed inward from the loops. The rest is cut in
/// two along the best line, recursively, until templates can fill the parts (CSALF-Q).
///
/// 1. A region of right angles is submapped (`submap()`). Another region of up to 4000 quads is filled by one
///    bent grid if possible (`fill_patterns()`). If the grid is good, it is the result.
/// 2. Rows are placed along loops that turn without corners and have room for them.
/// 3. Cuts are straight. A cut meets the outline at right angles if possible, and its nodes have the
///    requested spacing. Its number of edges is such that both parts have even numbers of sides and opposite
///    sides agree. A part that is a good patch of 3 to 5 sides is filled with grids that meet in one or two
///    irregular nodes.
/// 4. Boundary corners that lack a quad get one. Folded quads are opened. Irregular nodes are paired and
///    removed, nodes are smoothed, row heights are corrected.
///
/// A symmetric region whose boundary nodes allow it is cut along two perpendicular mirror axes, or along all
/// of them if its centre is in a hole. One part is filled and its images are joined, unless the result is
/// poor. Discs and rings are tried as a whole first. If the connections over a symmetric region are
/// symmetric, the nodes are made symmetric to rounding (`symmetrise()`), up to 20,000 quads.
///
/// Above 20,000 quads the paver meshes a coarse region, with every other boundary node and a quarter of the
/// quads, and cuts each of them in four. This requires that every loop has an even number of nodes and turns
/// by at most 20° at each node left out. If half the number of boundary sides is odd, the coarse mesh has a
/// triangle, which is cut in three. A coarse region of 8,000 quads or more is coarsened again; for this, up
/// to eight sides may be divided, each of which leaves a triangle.
///
/// Up to 4000 quads, the paver makes several meshes, with and without rows and with several weightings of the
/// cuts, and keeps the best by measured quality. Below about 1500 quads it makes three meshes without rows,
/// with weights chosen for few quads, and one with rows. It cleans and smooths the two with the fewest
/// initial irregular nodes, and the other two only if the worst quad of the first two is below 0.75. It tries
/// other weights only if these four meshes are poor. Sizes are compared with the size that the given sides
/// permit.
/// The search ends when a mesh is good and its number of irregular nodes is near the minimum that topology
/// allows (`least_irregular()`). Boundary nodes are kept, in order, bit for bit. Quads are counter-clockwise
/// and convex. Flat quads remain only where the boundary's sides are long compared with the gap between them;
/// the log reports this.
///
/// @throw InvalidInput "surface.pave_loops"   a loop is too short, repeats a node, crosses another loop or
///         lies outside the first one.
/// @throw InvalidInput "surface.pave_parity"  the number of boundary sides is odd.
/// @throw InvalidInput "surface.pave_rows"    the number of exact rows is negative, or there are exact rows
///         but no row height.
/// @throw NotSweepable "surface.pave"  no valid quads were found; names the place. This has not been observed
///         for regions that pass the checks above.
/// @note  Deterministic. Near linear in the number of quads.
Paved pave(const PlanarRegion& region, const PaveOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::quads
