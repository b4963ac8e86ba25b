// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::quads {

/// Move the nodes of quads over a symmetric region so that the positions are as symmetric as the connections.
///
/// The region's symmetries are the rotations and reflections that map its boundary nodes onto each other.
/// Only those that also map quads onto quads are used. Every inner node moves to the mean of its position and
/// the positions of its images, mapped back to it. Afterwards each of these symmetries maps the mesh onto
/// itself, to rounding.
/// @return number of symmetries of the mesh afterwards, including the identity. 1 if the mesh is unchanged:
///         it has no symmetry, or its least scaled Jacobian would fall by more than 0.01.
/// @pre   `find_fault()` finds no fault.
/// @note  Deterministic. At worst O(boundary nodes · quads); most candidates are no symmetries and are
///         rejected at once.
std::size_t symmetrise(PlanarQuads& mesh, const PlanarRegion& region);

/// Find the segments of a region's boundary that its symmetries map onto each other.
///
/// @param segment  segment of the side from each node to the next, 0, 1, …. Segments that are mapped onto
///         each other get equal node spacing.
/// @return  for each segment, the lowest number among its images, itself included.
/// @note    A symmetry that maps the end of a segment into the inside of another does not count.
std::vector<std::size_t> segments_alike(const PlanarRegion& region, std::span<const int> segment);

} // namespace lacuna::quads
