// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/matching/match.h>
#include <lacuna/topology/open_volume.h>

#include <utility>
#include <vector>

namespace lacuna::closure {

/// Cut the free edges that a match wants cut, so that each of its wall-free vertices has a partner. Given points stay as they are: an
/// edge becomes two of the same tag, and the vertex between them is void.
/// @return the pairs of vertices (source, target) that come to be; none for a vertex on a wall or a place on one.
std::vector<std::pair<VertexId, VertexId>> cut_edges(topology::OpenVolume& volume,
                                                     const matching::Match& match);

} // namespace lacuna::closure
