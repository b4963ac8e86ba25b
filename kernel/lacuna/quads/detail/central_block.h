// SPDX-License-Identifier: MIT
#pragma once

/// A square block of quads in the middle of a region with four mirror axes. Only sources of this folder
/// include it.

#include <lacuna/quads/detail/outline_symmetry.h>

#include <optional>

namespace lacuna::quads {

/// A block of quads around the centre of a region, and the region without it.
///
/// Four axes at 45° that meet inside a region halve no quads, but using four of their eight half-lines as
/// cuts would leave 45° corners at the centre. The block has a corner on every second axis and the middle of
/// a side on those between; the region around it is cut along all axes.
struct CentralBlock {
    PlanarRegion around;     ///< the region with the block as its last hole, whose nodes come last
    std::vector<Vec2> inner; ///< nodes inside the block, numbered after those of `around`
    std::vector<Quad> quads; ///< quads of the block
};

/// Place a block in a region.
/// @param symmetries  all symmetries of the region.
/// @param size        edge length of the block's quads.
/// @param choice      0: the block's corners lie on the axes on which the boundary is farthest; 1: on the
///                    others.
/// @return empty if the centre is in a hole or fewer than four axes pass through it.
std::optional<CentralBlock> central_block(const PlanarRegion& region, const std::vector<Symmetry>& symmetries,
                                          const SizeField& size, int choice);

/// The quads of the whole region from those around the block. The block's nodes come first in both meshes.
PlanarQuads with_block(const CentralBlock& block, PlanarQuads around);

} // namespace lacuna::quads
