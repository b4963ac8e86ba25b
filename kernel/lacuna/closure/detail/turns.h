// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// For each edge, the angle between its two faces minus 180°, measured through the void and averaged along
/// the edge [degrees]: positive at a concave edge of the void. 0 for free edges and seams.
///
/// For each connected part of the skin, the side of the void follows from the side of its ends on which its
/// walls lie, otherwise from the position of the opposite ends, otherwise from the part's centre; see
/// `parts_facing_void()`.
/// @note  O(facets · parts).
std::vector<double> concave_turns(const topology::OpenVolume& volume, const RunContext& context);

/// The result of `concave_turns()`, and which faces are oriented towards the void.
struct SkinTurns {
    std::vector<double> concave;
    std::vector<bool> faces_void;
};
SkinTurns skin_turns(const topology::OpenVolume& volume, const RunContext& context);

/// Orient the parts of the skin so that they face away from the void.
void face_away(topology::OpenVolume& volume, const RunContext& context);

} // namespace lacuna::closure
