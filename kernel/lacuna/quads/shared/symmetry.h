// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::quads {

/// Move the inner nodes of quads over a symmetric region, so that their positions become as symmetric as
/// their connections.
///
/// The region's symmetries are the rotations and reflections that map its boundary nodes onto each other.
/// Only those that also map quads onto quads are used. Every inner node moves to the mean of its position and
/// the positions of its images, mapped back to it. Afterwards each of these symmetries maps the mesh onto
/// itself, to rounding.
/// @return number of symmetries of the mesh afterwards, including the identity. 1 if the mesh is unchanged:
///         it has no symmetry, or its least scaled Jacobian would fall by more than 0.01.
/// @pre   `find_fault()` finds no fault.
/// @note  Deterministic. At worst O(boundary nodes · quads); most candidates are not symmetries and are
///         rejected at once.
std::size_t symmetrise(PlanarQuads& mesh, const PlanarRegion& region);

/// Find the segments of a region's boundary that its symmetries map onto each other.
///
/// The caller gives such segments equal node spacing.
/// @param segment  for each boundary node, the number (0, 1, …) of the segment that contains the side from
///         this node to the next.
/// @return  for each segment, the lowest number among its images, itself included.
/// @note    A symmetry that maps the end of a segment into the inside of another does not count.
std::vector<std::size_t> segments_alike(const PlanarRegion& region, std::span<const int> segment);

} // namespace lacuna::quads
