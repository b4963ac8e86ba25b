// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>

#include <vector>

namespace lacuna::closure {

/// The loop of a void face inside a rim of given faces: the rim reversed.
topology::Loop reversed(const topology::Rim& rim);

/// The paper's Algorithm 3 as a walk along half-edges: a free edge lacks one half, a void edge both. Starting
/// at a free half on the source rim, turn at each vertex to the half that leaves it. One loop per void face,
/// with the face on its left.
///
/// At a vertex with several halves, the walk goes from a given edge to a void edge, and from a void edge to a
/// given one, if it can. If several halves remain, it takes the one with the shortest path back to the start,
/// which keeps the loop four-sided.
/// @throw NotClosed  a walk that does not return to its start; names the edge.
std::vector<topology::Loop> void_loops(const topology::OpenVolume& volume,
                                       const std::vector<EdgeId>& void_edges);

} // namespace lacuna::closure
