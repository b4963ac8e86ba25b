// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::surface {

/// A chain in the plane between two nodes; it meets other chains at nodes only.
struct PlaneChain {
    std::vector<Vec2> line;         ///< from node to node, at least two points
    std::size_t from = 0, to = 0;   ///< numbers of its nodes
    bool left = true, right = true; ///< whether there is something to be bounded on that side
};

/// A chain as a loop uses it.
struct PlaneUse {
    std::size_t chain = 0;
    bool reversed = false;
};

/// A connected part of the plane between chains: loops with the region on the left, the outer one first.
struct PlaneRegion {
    std::vector<std::vector<PlaneUse>> loops;
};

/// The regions that chains cut a part of the plane into.
///
/// Half-edges are traced by turning as far left as can be at each node; loops of negative area are holes of
/// the smallest loop round them.
/// @pre  chains do not cross; none ends loose.
std::vector<PlaneRegion> plane_regions(std::span<const PlaneChain> chains);

} // namespace lacuna::surface
