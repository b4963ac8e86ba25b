// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::quads {

/// A side of a region's boundary: from the node at a place of one of its loops to the next node.
struct RegionSide {
    std::size_t loop, place;
};

/// The boundary sides of a region in the order in which they should be divided: the side that is longest
/// relative to the local size comes first.
std::vector<RegionSide> sides_by_length(const PlanarRegion& region);

/// Fill a region whose boundary may have an odd number of sides. If the number is odd, the mesh has one
/// triangle, the fewest possible. The triangle is the last of the quads (`mesh::is_triangle()`).
///
/// 1. One boundary side is divided in two, so the number of sides is even, and `mesher` fills the region. A
///    row of quads leads inward from each half of the divided side.
/// 2. One of these two rows is closed: the quads from the boundary up to a chosen quad of the row are
///    removed, and the chosen quad becomes the triangle. The node that divided the side disappears.
/// 3. Nearby nodes are moved to improve the worst cell around them.
///
/// Step 2 is tried for the first quads of both rows, and the triangle that gives the best worst cell is kept.
/// If this cell is poor, other sides are divided instead.
/// @pre    the preconditions of `mesher`, except that the number of sides may be odd.
/// @throw NotSweepable  by `mesher`; "surface.odd_region": no row leads inward from any of the sides tried.
/// @note   Deterministic. A region with an even number of sides is passed to `mesher` unchanged.
PlanarQuads fill_odd_region(const PlanarRegion& region, const PlanarQuadMesher& mesher,
                            const RunContext& context = {});

/// Fill a region after dividing the given sides in two, and close one row at each of these sides as
/// `fill_odd_region()` does. The mesh has one triangle for each given side; the triangles come last. No other
/// sides are tried. Nearby nodes are moved only a little, because the caller smooths the mesh later.
/// @pre    no side occurs twice; the preconditions of `mesher` hold for the divided region.
/// @throw NotSweepable  by `mesher`; "surface.odd_region": no row leads inward from a side.
/// @note   Deterministic.
PlanarQuads fill_divided_region(const PlanarRegion& region, std::span<const RegionSide> sides,
                                const PlanarQuadMesher& mesher, const RunContext& context = {});

} // namespace lacuna::quads
