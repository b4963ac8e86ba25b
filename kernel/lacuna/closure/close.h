// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/matching/match.h>
#include <lacuna/topology/open_volume.h>

#include <string>
#include <vector>

namespace lacuna::closure {

/// How a void edge runs between its two vertices.
enum class EdgeShape {
    automatic, ///< straight; `follow` where straight would stray from the walls or cross the given faces
    straight,  ///< the paper's
    follow,    ///< as the side edges next to it
};

struct CloseOptions {
    EdgeShape edge_shape = EdgeShape::automatic;
};

/// What was added to seal the volume, and how.
struct Closure {
    topology::VolumeClass value = topology::VolumeClass::closed;
    std::vector<EdgeId> void_edges;
    std::vector<FaceId> void_faces;
    std::vector<std::string> algorithms; ///< of the paper, in the order used: "Algorithm 8", "Algorithm 4", …
    bool watertight = false;
};

/// Seal the volume: add void edges and faces with their geometry, and give every face its role.
///
/// Algorithms 2–6 and one closer a class, 8–11. Classes IV and V have no target before, and both ends after.
/// @param volume  out: with the void entities added.
/// @param match   of source and target; not read for classes IV and V, which have no two ends to match.
/// @throw NotClosed  names the free loop, face or edge that cannot be sealed, and why.
/// @throw Cancelled
/// @post  every edge is used twice, in opposite directions, and the volume enclosed is positive.
Closure close(topology::OpenVolume& volume, const matching::Match& match, const CloseOptions& options = {},
              const RunContext& context = {});

/// True when every edge is used twice in opposite directions and the facets enclose a positive volume.
bool is_watertight(const topology::OpenVolume& volume);

/// Volume the facets enclose, positive when they are oriented outward [model length³].
double enclosed_volume(const topology::OpenVolume& volume);

} // namespace lacuna::closure
