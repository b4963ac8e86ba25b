// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>

#include <vector>

namespace lacuna::closure {

/// The loop of a void face that fills a rim of given faces: the rim reversed.
topology::Loop reversed(const topology::Rim& rim);

/// Find the loops of the void faces, one for each face, with the face on its left.
///
/// This is Algorithm 3 of the paper (docs/bibliography.md) as a walk along missing half-edges: a free edge
/// lacks one half-edge, a void edge lacks both. Walks start at missing half-edges, those on the source rim
/// first. A walk continues at each vertex with a missing half-edge that starts there.
///
/// If several missing half-edges start at a vertex, the walk changes from a given edge to a void edge, or
/// from a void edge to a given one, where possible. If several are left, it takes the half-edge from which
/// the path back to the start is shortest, so that the loop becomes four-sided.
/// @throw NotClosed  a walk does not return to its start; names the edge where it started.
std::vector<topology::Loop> void_loops(const topology::OpenVolume& volume,
                                       const std::vector<EdgeId>& void_edges);

} // namespace lacuna::closure
