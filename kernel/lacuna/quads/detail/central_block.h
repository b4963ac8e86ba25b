// SPDX-License-Identifier: MIT
#pragma once

/// A square block of quads in the middle of a region with four mirror axes. Only sources of this folder
/// include it.

#include <lacuna/quads/detail/outline_symmetry.h>

#include <optional>

namespace lacuna::quads {

/// A block of quads around the centre of a region, and the rest of the region.
///
/// Four mirror axes at 45° to each other meet at the centre. If the region were cut along all of them, the
/// parts would have corners of 45° there, which are too sharp for quads. Therefore a block of quads replaces
/// the centre. The block's corners lie on two of the axes, and the middles of its sides on the other two. The
/// region around the block is cut along all axes.
struct CentralBlock {
    /// The region around the block. The block is its last hole, and the block's nodes come last.
    PlanarRegion around;
    std::vector<Vec2> inner; ///< nodes inside the block, numbered after those of `around`
    std::vector<Quad> quads; ///< quads of the block
};

/// Place a block in a region.
/// @param symmetries  all symmetries of the region.
/// @param size        edge length of the block's quads.
/// @param choice      0: the block's corners lie on the two axes on which the boundary is farthest from the
///         centre; 1: on the other two axes.
/// @return empty if the centre is in a hole or fewer than four axes pass through it.
std::optional<CentralBlock> central_block(const PlanarRegion& region, const std::vector<Symmetry>& symmetries,
                                          const SizeField& size, int choice);

/// Add the block to a mesh of the region around it.
/// @param around  mesh of `block.around`; its first nodes are the nodes of `block.around`.
PlanarQuads with_block(const CentralBlock& block, PlanarQuads around);

} // namespace lacuna::quads
