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

/// The sides of a region in the order in which they should be divided. The side that is longest relative to
/// the local size comes first.
std::vector<RegionSide> sides_by_length(const PlanarRegion& region);

/// Fill a region whose boundary may have an odd number of sides. If the number is odd, the mesh has one
/// triangle, the fewest possible. It is the last of the quads (`mesh::is_triangle()`).
///
/// The function divides a side in two, which makes the number even, and `mesher` fills the region. A row of
/// quads leads inward from each half of the side. The function closes one of these rows, from the boundary to
/// one of its quads, which becomes the triangle; the added node disappears. Nearby nodes are then moved to
/// improve their worst cell. The function tries the first quads of both rows, and keeps the triangle with
/// which the worst cell is best. If that cell is poor, it tries other sides.
/// @pre    those of `mesher`, except for the number of sides.
/// @throw NotSweepable  by `mesher`; "surface.odd_region": no row leads inward from any of the sides tried.
/// @note   Deterministic. A region with an even number of sides is passed to `mesher` unchanged.
PlanarQuads fill_odd_region(const PlanarRegion& region, const PlanarQuadMesher& mesher,
                            const RunContext& context = {});

/// Fill a region after dividing the given sides in two, and close a row at each of them as
/// `fill_odd_region()` does. The mesh has one triangle for each side; the triangles come last. No other sides
/// are tried, and nearby nodes are moved little, because the caller smooths the mesh later.
/// @pre    no side occurs twice; those of `mesher` for the divided region.
/// @throw NotSweepable  by `mesher`; "surface.odd_region": no row leads inward from a side.
/// @note   Deterministic.
PlanarQuads fill_divided_region(const PlanarRegion& region, std::span<const RegionSide> sides,
                                const PlanarQuadMesher& mesher, const RunContext& context = {});

} // namespace lacuna::quads
