// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::quads {

/// A side of a region's boundary: of one of its loops, from the node at a place of it to the next.
struct RegionSide {
    std::size_t loop, place;
};

/// The sides of a region in the order they are worth dividing: the longest over the size there first.
std::vector<RegionSide> sides_by_length(const PlanarRegion& region);

/// Fill a region whose boundary may have an odd number of sides: then with quads and one triangle, which is
/// as few as there can be, and is the last of the quads (`mesh::is_triangle()`).
///
/// A side is divided in two, which makes the number even, and `mesher` fills the region. From either half a
/// row of quads leads inward, as wide at its start as that half. It is closed up to one of its quads, which
/// becomes the triangle; so the half is gone, and with it the node that was added. Nodes near by are moved
/// uphill on the worst cell they have. Of both halves and the first quads of their rows the place with the
/// best worst cell there stays; where that is poor, other sides are tried.
/// @pre    what `mesher` wants, but for the number of sides.
/// @throw NotSweepable  what `mesher` throws; "surface.odd_region": no row leads inward from any of the sides
///                      that were tried.
/// @note   Deterministic. A region with an even number of sides is handed to `mesher` as it is.
PlanarQuads fill_odd_region(const PlanarRegion& region, const PlanarQuadMesher& mesher,
                            const RunContext& context = {});

/// Fill a region with some of its sides divided in two, each of which is then closed as `fill_odd_region()`
/// does: with as many triangles, the last of the quads. No other sides are tried, and nodes near by are
/// moved little, for a mesh that is smoothed later.
/// @pre    no side twice; what `mesher` wants of the divided region.
/// @throw NotSweepable  what `mesher` throws; "surface.odd_region": no row leads inward from a side.
/// @note   Deterministic.
PlanarQuads fill_divided_region(const PlanarRegion& region, std::span<const RegionSide> sides,
                                const PlanarQuadMesher& mesher, const RunContext& context = {});

} // namespace lacuna::quads
