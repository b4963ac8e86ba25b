// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <vector>

/// Midpoint subdivision. Internal to this folder.
namespace lacuna::closure {

/// Divide a sealed volume into blocks, one for each of its vertices, by midpoint subdivision @cite
/// li_1995_midpoint. Lines run from the middle of each edge to the middles of the faces at this edge, and
/// from there to the middle of the volume. Each block has six four-sided faces.
///
/// The middles of faces and of the volume start at centroids. They are moved, on their face or in space, as
/// long as this improves the corners of the blocks. Given faces are split along plane sections; void faces
/// between two blocks are bilinear.
///
/// If a vertex does not have three edges, or if a block would be folded, the volume is first divided into
/// cones from its centroid over triangles. A three-sided face is one such triangle; any other face is split
/// into triangles by lines from its vertices to its centroid. Each cone is then divided into blocks; the
/// middles of its faces stay at their centroids.
/// @param most  largest number of blocks.
/// @return  the blocks; all their faces are walls. Empty in any of these cases:
/// - a face has a given mesh;
/// - a face is not bounded by one loop of at least three edges between different faces;
/// - there would be more than `most` blocks;
/// - a line would leave its face;
/// - the scaled Jacobian at a corner of a block would be below 0.1.
/// @throw InvalidInput  an edge is too short to be split.
/// @throw Cancelled
/// @note  O(edges · facets).
std::vector<topology::OpenVolume> midpoint_blocks(const topology::OpenVolume& volume, std::size_t most,
                                                  const RunContext& context = {});

} // namespace lacuna::closure
