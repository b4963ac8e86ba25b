// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// By how much the skin turns towards the void over each edge between two faces, on average along it
/// [radians]: positive where the void has more than a straight angle there, 0 for free edges and seams.
///
/// Which side the void is on is told of each connected part of the skin by itself. Of an open part with both
/// ends it is the side to which the walls go from them, where all go one way. Else the facets face away from
/// their middle, or towards it where the part lies within another.
/// @note  O(facets · parts).
std::vector<double> concave_turns(const topology::OpenVolume& volume);

/// Turn the parts of the skin so that they face away from the void.
void face_away(topology::OpenVolume& volume);

} // namespace lacuna::closure
