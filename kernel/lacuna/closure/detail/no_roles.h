// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Say why faces have no roles, and what to call instead; planes to cut by were tried.
/// @throw InvalidInput  always: "topology.torus", "topology.sphere", "topology.cone" (one that runs to its
///        tip), "topology.crossing_bores", else "topology.no_roles". Cancelled.
[[noreturn]] void refuse_without_roles(const topology::Model& model, const std::vector<FaceId>& faces,
                                       const RunContext& context);

/// @throw NotClosed "closure.tube_loops"  walls of a volume without ends that hang together and have not two
///        free loops; says how they are opened or cut, as it was tried. InvalidInput
///        "topology.crossing_bores". Cancelled.
void check_tubes(const topology::OpenVolume& volume, const RunContext& context);

} // namespace lacuna::closure
