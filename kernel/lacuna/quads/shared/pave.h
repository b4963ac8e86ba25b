// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <string>

namespace lacuna::quads {

/// How `pave()` filled a region.
struct PaveReport {
    int refilled = 0; ///< places where rows and cuts folded, filled with split triangles
    std::string used; ///< "mapped": one patch without rows; "submapped", "paved"
};

/// Options of `pave()`.
struct PaveOptions {
    /// Rows to lay along every loop first, as high as `PlanarRegion::row_height` says. They stay as they are
    /// laid; a loop without room for one goes without, which `PlanarQuads::how` tells. All others are laid as
    /// the region's shape needs, and are free to move.
    int exact_rows = 0;
    bool grids = true; ///< a region may be filled by one grid
};

/// What `pave()` built, and how.
struct Paved {
    PlanarQuads mesh;
    PaveReport report;
};

/// Fill a region of the plane with quads by paving: rows placed inward from the loops, the rest cut in two
/// along the best line, again and again, until templates can fill the parts (CSALF-Q).
///
/// 1. A region of right angles is submapped (`submap()`), another of up to 4000 quads filled by one bent grid
///    where that can be (`fill_patterns()`). Where that is good, it is the result.
/// 2. Rows are placed along loops that turn without corners and have room for them.
/// 3. A cut is straight. It meets the outline at right angles where it can, its nodes are spaced as the size
///    asks, and its number of edges leaves even parts whose sides agree. A part that is a good patch of 3 to
///    5 sides is filled with grids that meet in one or two irregular nodes.
/// 4. Boundary corners that lack a quad get one. Folded quads are opened, or removed and their cavity
///    remeshed (`paving::refill_cavities()`). Irregular nodes are paired off, nodes smoothed, row heights
///    corrected.
///
/// A symmetric region is cut along two mirror axes square to each other, or about a hole in its middle along
/// all, if its boundary nodes allow it. The part is filled and its images are joined, unless that is poor.
/// Discs and rings are tried as a whole first. Symmetric quads of a symmetric region are made so to rounding
/// (`symmetrise()`), up to 20,000.
///
/// More than 20,000 are made of a quarter as many, over every other boundary node, each cut in four. That
/// takes every loop to have an even number of nodes and to turn by 20° at most at those left out; where half
/// of all is an odd number, a triangle is cut in three. 8,000 and more of the coarse ones are made in the
/// same way; for that up to eight sides may be divided, and become a triangle each.
///
/// Up to 4000 quads are made several times, with and without rows and by several weightings of the cuts, and
/// the best by measure is kept. Below about 1500 they are made three times without rows, by weightings of
/// their own, and once with rows. The two that begin with the fewest irregular nodes are cleaned and
/// smoothed, the others only where the worst quad of those is below 0.75; all else is tried only where they
/// are poor. Sizes are judged by those that the given sides leave room for. The search ends where a mesh is
/// good and near the fewest irregular nodes that topology allows (`least_irregular()`). Boundary nodes are
/// kept, in order, bit for bit. The quads are counter-clockwise and convex. Flat ones are left only where the
/// boundary's sides are long for the gap between them, which the log says.
///
/// @throw InvalidInput "surface.pave_loops"   a loop that is too short, repeats a node, crosses another or
///                                            lies outside the first.
/// @throw InvalidInput "surface.pave_parity"  an odd number of boundary sides.
/// @throw InvalidInput "surface.pave_rows"    exact rows below 0, or of a region without a row height.
/// @throw NotSweepable "surface.pave"         no valid quads were found; names the place. Not seen for
///                                            regions that pass the checks above.
/// @note  Deterministic. Near linear in the number of quads.
Paved pave(const PlanarRegion& region, const PaveOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::quads
