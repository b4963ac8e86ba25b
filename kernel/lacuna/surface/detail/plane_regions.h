// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::surface {

/// A chain in the plane between two nodes. Chains meet only at nodes.
struct PlaneChain {
    std::vector<Vec2> line;       ///< points from node to node, at least two
    std::size_t from = 0, to = 0; ///< numbers of its nodes
    /// Whether the region on the left, and the region on the right, is part of the result.
    bool left = true, right = true;
};

/// A chain in a loop, and its direction there.
struct PlaneUse {
    std::size_t chain = 0;
    bool reversed = false;
};

/// A connected part of the plane between chains: loops with the region on the left, the outer one first.
struct PlaneRegion {
    std::vector<std::vector<PlaneUse>> loops;
};

/// The regions into which chains divide a part of the plane.
///
/// Half-edges are traced by the leftmost turn at each node. A loop of negative area is a hole of the smallest
/// loop around it.
/// @pre  chains do not cross, and none has a free end.
std::vector<PlaneRegion> plane_regions(std::span<const PlaneChain> chains);

} // namespace lacuna::surface
