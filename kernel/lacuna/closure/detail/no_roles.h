// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/readings.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <string>
#include <vector>

namespace lacuna::closure {

/// Whether a closed skin can be swept as a full turn: it has one handle, like a torus, and a plane cuts it
/// across in two places.
bool is_ring(const topology::OpenVolume& volume, const RunContext& context);

/// The error that no roles were found, with a remedy. Its code is "topology.sphere", "topology.cone" (a cone
/// that includes its apex), "topology.crossing_bores", or otherwise "topology.no_roles". The function tries
/// cuts by some planes, so that the remedy can name one that works.
/// @throw InvalidInput  the faces cannot be oriented.
/// @throw Cancelled
Message why_no_roles(const topology::Model& model, const std::vector<FaceId>& faces,
                     const RunContext& context);

/// The likeliest readings as words for a message: "1 (class IV, volume 2.1), 2 (class II, volume 3) and 3
/// more".
std::string listed(const std::vector<Reading>& readings, std::ptrdiff_t most = 6);

/// Check that the walls of a volume without ends are tubes or have branches.
/// @throw NotClosed "closure.tube_loops"  a connected part of the walls does not have two free loops; the
///         remedy names a way to open or cut the volume that was tried.
/// @throw InvalidInput "topology.crossing_bores"  such a volume has bores that cross each other.
/// @throw Cancelled
void check_tubes(const topology::OpenVolume& volume, const RunContext& context);

} // namespace lacuna::closure
