// SPDX-License-Identifier: MIT
#pragma once

/// A square of quads in the middle of a region that four mirror axes run through. Only sources of this folder
/// include it.

#include <lacuna/quads/detail/outline_symmetry.h>

#include <optional>

namespace lacuna::quads {

/// A block of quads about the centre of a region, and the region without it.
///
/// Four axes that meet inside a region at 45° halve no quads, but four of the eight would leave half right
/// angles at the centre. A block has a corner on every other axis and the middle of a side on those between;
/// about it the region is cut along all axes.
struct CentralBlock {
    PlanarRegion around;     ///< the region with the block as its last hole, whose nodes are its last
    std::vector<Vec2> inner; ///< nodes within the block, which come after those of `around`
    std::vector<Quad> quads; ///< of the block
};

/// Place a block in a region.
/// @param symmetries  all of the region.
/// @param size        edge length of the block's quads.
/// @param choice      0 or 1: its corners lie on the axes on which the boundary is farthest, or on the
///                    others.
/// @return nothing where the centre is in a hole or fewer than four axes run through it.
std::optional<CentralBlock> central_block(const PlanarRegion& region, const std::vector<Symmetry>& symmetries,
                                          const SizeField& size, int choice);

/// The whole region's quads from those about the block, whose nodes come first in both.
PlanarQuads with_block(const CentralBlock& block, PlanarQuads around);

} // namespace lacuna::quads
