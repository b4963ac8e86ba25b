// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::quads {

/// Make quads over a symmetric region as symmetric as their connections are.
///
/// The region's symmetries are the turns and mirrorings that map its boundary nodes onto each other. Those
/// that also map quads onto quads move every inner node to the mean of where they see it. Then each of them
/// maps the mesh onto itself, to rounding.
/// @return how many symmetries the mesh has then, the identity among them; 1 where it stays as it is, also
///         where the least scaled Jacobian would become smaller by more than 0.01.
/// @pre   `find_fault()` finds none.
/// @note  Deterministic. O(boundary nodes · quads) at worst; most symmetries that fail do so at once.
std::size_t symmetrise(PlanarQuads& mesh, const PlanarRegion& region);

/// Which segments of a region's boundary its symmetries map onto each other.
///
/// @param segment  of the side from each node to the next, 0, 1, …; nodes stand alike on segments that are.
/// @return  of each segment the least of those that it is mapped onto, itself among them.
/// @note    Symmetries that map the end of a segment onto the inside of another are none.
std::vector<std::size_t> segments_alike(const PlanarRegion& region, std::span<const int> segment);

} // namespace lacuna::quads
