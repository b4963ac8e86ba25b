// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <vector>

/// Midpoint subdivision. Internal to this folder.
namespace lacuna::closure {

/// Divide a sealed volume into blocks, one at each vertex, each with six four-sided faces @cite
/// li_1995_midpoint: lines run from the middles of edges to the middles of their faces, and from these to the
/// middle of the volume.
///
/// Middles start at centroids and are moved on their face, or in space, as long as this improves the corners
/// of the blocks. Given faces are split along plane sections; void faces between two blocks are bilinear.
///
/// If a vertex does not have three edges, or if a block would be folded, the volume is first divided into
/// cones from its centroid over triangles. Three-sided faces are such triangles; other faces are split into
/// triangles by lines from their vertices to their centroid. Each cone is then divided, with the middles of
/// its faces at their centroids.
/// @param most  largest number of blocks.
/// @return  the blocks, whose faces are walls. Empty if a face keeps a mesh or is not bounded by one loop of
///          at least three edges between different faces, if there would be more than `most` blocks, if a
///          line would leave its face, or if the scaled Jacobian at a corner of a block would be below 0.1.
/// @throw InvalidInput  an edge is too short to be split.
/// @throw Cancelled
/// @note  O(edges · facets).
std::vector<topology::OpenVolume> midpoint_blocks(const topology::OpenVolume& volume, std::size_t most,
                                                  const RunContext& context = {});

} // namespace lacuna::closure
