// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Mean turn of the skin towards the void at each edge between two faces [radians]: positive if the interior
/// angle of the void exceeds 180°, 0 for free edges and seams.
///
/// The side of the void is found for each connected part of the skin: its ends face the opposite end of
/// another part or, if the part is inside no other, its own opposite end; otherwise the facets face away from
/// their centre, or towards it if the part is inside another.
/// @note  O(facets · parts).
std::vector<double> concave_turns(const topology::OpenVolume& volume, const RunContext& context);

/// Orient the parts of the skin so that they face away from the void.
void face_away(topology::OpenVolume& volume, const RunContext& context);

} // namespace lacuna::closure
