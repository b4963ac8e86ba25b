// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <string>

namespace lacuna::quads {

/// What `pave()` did.
struct PaveReport {
    int rows = 0;      ///< rows of quads laid inward, over all loops
    int mapped = 0;    ///< parts filled by a grid, with at most a few irregular nodes
    int cuts = 0;      ///< splitting lines drawn
    int templates = 0; ///< loops of six nodes or fewer closed
    int refilled = 0;  ///< places where rows and cuts folded, filled with split triangles
    std::string used;  ///< "mapped": one patch without rows; "paved"
};

/// Options of `pave()`.
struct PaveOptions {
    /// Most rows to lay inward from each loop; -1: as many as its shape needs, mostly 1 to 3. Where the region has a row
    /// height of its own: rows of that height, one at least, that stay as they are laid wherever there is room.
    int rows = -1;
    bool grids = true;            ///< a region of right angles may be filled by the grid it encloses
    bool clean = true;            ///< mend irregular nodes
    bool smooth = true;           ///< move inner nodes
    PaveReport* report = nullptr; ///< filled where given
};

/// Fill a region of the plane with quads: rows laid inward from the loops, the rest cut in two again and
/// again along the best line until the parts can be filled by grids or templates (CSALF-Q).
///
/// A region of right angles is submapped (`submap()`), and that is all where the grid is good. Else rows are laid where a loop turns
/// without corners and there is room; a cut is straight, with nodes as the size asks, and its ends square to the outline where that
/// goes; its number of edges leaves even parts whose sides agree. A part that is a good patch of 3 to 5 sides is filled
/// with grids that meet in 1, 2 or 4 irregular nodes. Then corners that lack a quad get one, folds are opened or
/// filled anew (`paving::refill_cavities()`), irregular nodes paired off, nodes smoothed, rows made true. Up to 4000 quads are made
/// with and without rows and by several weightings of the cuts, and the best by measure kept. Boundary nodes are kept, in order, bit
/// for bit. The quads are counter-clockwise and convex; flat ones are left only where the boundary's sides are long for
/// the gap between them, which the log says.
/// @throw InvalidInput  a loop that is too short, repeats a node, crosses another or lies outside the first; an odd number of
///                      boundary sides.
/// @throw NotSweepable "surface.pave"  no valid quads were found; names the place. Not seen for regions that pass the above.
/// @note  Deterministic. Near linear in the number of quads.
PlanarQuads pave(const PlanarRegion& region, const PaveOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::quads
