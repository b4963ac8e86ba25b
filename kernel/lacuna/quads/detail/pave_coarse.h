// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/pave.h>

#include <functional>
#include <optional>
#include <vector>

namespace lacuna::quads::paving {

/// Whether a loop turns so much at its node at `place` that the node is not left out.
bool stays(const PlanarRegion& region, const std::vector<Index>& loop, std::size_t place);

/// A region with every other node of its loops.
struct CoarseRegion {
    PlanarRegion region;     ///< of twice the size; may have an odd number of boundary sides
    std::vector<Index> own;  ///< its points in the region it was made of
    std::vector<Index> next; ///< in that region: the node left out after each of its points
};

/// Leave every other boundary node out.
/// @return nothing where a loop has an odd number of nodes, or one left out stands where its loop turns.
std::optional<CoarseRegion> coarse_region(const PlanarRegion& region);

/// Cut every cell of a mesh of the coarse region into four quads, a triangle into three, through the nodes
/// that were left out. The others are put half way between their neighbours.
/// @param fine    the region that the coarse one was made of; its points come first.
/// @param coarse  quads and triangles (`mesh::is_triangle()`), the coarse region's points first.
PlanarQuads cut_in_four(const PlanarRegion& fine, const CoarseRegion& made, const PlanarQuads& coarse);

/// Pave the coarse region, or one coarser still, cut its cells in four and smooth the quads.
/// @param size  of the region, with its boundary's.
/// @return nothing where there is no coarse region, or it cannot be filled.
/// @throw Cancelled
std::optional<Paved> pave_in_four(const PlanarRegion& region, const PaveOptions& options,
                                  const std::function<double(const Vec2&)>& size, const RunContext& context);

} // namespace lacuna::quads::paving
