// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Mean turn of the skin towards the void at each edge between two faces [degrees]: positive if the interior
/// angle of the void exceeds 180°, 0 for free edges and seams.
///
/// The side of the void is found for each connected part of the skin: by the side of its ends on which its
/// walls stand, by the position of the opposite ends, or else by the part's centre; see
/// `parts_facing_void()`.
/// @note  O(facets · parts).
std::vector<double> concave_turns(const topology::OpenVolume& volume, const RunContext& context);

/// The result of `concave_turns()` and, by face, whether its facets face the void.
struct SkinTurns {
    std::vector<double> concave;
    std::vector<bool> faces_void;
};
SkinTurns skin_turns(const topology::OpenVolume& volume, const RunContext& context);

/// Orient the parts of the skin so that they face away from the void.
void face_away(topology::OpenVolume& volume, const RunContext& context);

} // namespace lacuna::closure
