// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>

#include <vector>

namespace lacuna::closure {

/// The loop of a void face inside a rim of given faces: the rim reversed.
topology::Loop reversed(const topology::Rim& rim);

/// Find the loops of the void faces, one for each face, with the face on its left.
///
/// This is the paper's Algorithm 3 as a walk along missing half-edges: a free edge lacks one half-edge, a
/// void edge lacks both. A walk starts at a missing half-edge on the source rim and continues at each vertex
/// with a missing half-edge that leaves it.
///
/// If several missing half-edges leave a vertex, the walk goes from a given edge to a void edge, and from a
/// void edge to a given one, where possible. If there is still a choice, it takes the half-edge with the
/// shortest path back to the start, which keeps the loop four-sided.
/// @throw NotClosed  a walk that does not return to its start; names the edge.
std::vector<topology::Loop> void_loops(const topology::OpenVolume& volume,
                                       const std::vector<EdgeId>& void_edges);

} // namespace lacuna::closure
