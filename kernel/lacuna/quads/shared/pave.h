// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <string>

namespace lacuna::quads {

/// The method by which `pave()` filled a region.
struct PaveReport {
    std::string used; ///< "mapped" (one patch without rows), "submapped" or "paved"
};

/// Options of `pave()`.
struct PaveOptions {
    /// Number of rows to place along every loop first, at the height `PlanarRegion::row_height`. The paver
    /// does not move these rows afterwards. A loop without room for a row gets none, and `PlanarQuads::how`
    /// reports this. Other rows are placed where the region's shape requires them, and may move.
    int exact_rows = 0;
    bool grids = true; ///< whether a single (submapped or bent) grid may fill the region
    /// Minimum number of rows around a ring whose loops have equal numbers of sides, >= 0; 0: by the size.
    int across = 0;
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
/// 3. The remaining region is cut by straight lines. A cut meets the outline at right angles if possible, and
///    its nodes have the requested spacing. Its number of edges is chosen so that both parts have even
///    numbers of sides, with equal numbers on opposite sides if possible. A part that is a good patch of 3 to
///    5 sides is filled with grids that meet in one or two irregular nodes.
/// 4. Boundary corners that lack a quad get one. Folded quads are opened. Irregular nodes are paired and
///    removed, nodes are smoothed, row heights are corrected.
///
/// Symmetry: if the outline and the boundary nodes are symmetric, the region is cut along two perpendicular
/// mirror axes. A region with a hole at its centre is cut along all its axes. One part is meshed and its
/// mirror images are joined, unless the result is poor. Discs and rings are first tried uncut. If the final
/// connections are symmetric, the node positions are made symmetric to rounding (`symmetrise()`), up to
/// 20,000 quads.
///
/// Many quads: above 20,000 quads the paver meshes a coarse region, with every other boundary node and a
/// quarter of the quads, and cuts each quad in four. For this, every loop must have an even number of nodes
/// and turn by at most 20° at each node left out. If half the number of boundary sides is odd, the coarse
/// mesh has a triangle, which is cut in three. A coarse region of 8,000 quads or more is coarsened again. Up
/// to eight of its sides may then be divided; each divided side gives one triangle.
///
/// Few quads: up to 4000 quads, the paver makes several meshes, with and without rows and with several
/// weightings of the cuts, and keeps the one with the best measured quality. Below about 1500 quads it first
/// makes four: three without rows, with weights chosen for few quads, and one with rows. It cleans and
/// smooths the two with the fewest irregular nodes. It cleans and smooths the other two only if the worst
/// quad of the first two has a scaled Jacobian below 0.75. It tries other weights only if all four are poor.
/// The search ends when a mesh is good and has nearly the minimum number of irregular nodes that topology
/// allows (`least_irregular()`). Edge lengths are judged by the size that the given boundary sides permit,
/// not by the requested size alone.
///
/// Boundary nodes are kept, in order, bit for bit. Quads are counter-clockwise and convex. Flat quads remain
/// only where boundary sides are long compared with the gap between them; the log reports these quads.
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
