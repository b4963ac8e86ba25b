// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>

#include <vector>

namespace lacuna::closure {

/// The loop of a void face within a rim of given ones: it runs against that.
topology::Loop reversed(const topology::Rim& rim);

/// The paper's Algorithm 3 as a walk along half-edges: a free edge lacks one half, a void edge both; from a
/// free half on the source rim turn at each vertex to the half that leaves it. One loop a void face, the
/// face on its left.
///
/// At a vertex with several halves a void edge comes first after a given one; where that does not decide,
/// the half with the shortest way home, which keeps the loop four-sided.
/// @throw NotClosed  a walk that does not come back; names the edge.
std::vector<topology::Loop> void_loops(const topology::OpenVolume& volume,
                                       const std::vector<EdgeId>& void_edges);

} // namespace lacuna::closure
