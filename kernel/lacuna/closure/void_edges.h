// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>

#include <vector>

namespace lacuna::closure {

/// The paper's Algorithm 2: a void edge between each matched pair of wall-free vertices.
///
/// Straight, or following the side lines next to it: the nearest ones' shape is carried over in a frame that
/// turns with them and fitted to both ends.
/// @param shape  straight or follow; `follow` is straight where no side line is near.
std::vector<EdgeId> make_void_edges(topology::OpenVolume& volume, const matching::Match& match, EdgeShape shape);

} // namespace lacuna::closure
