// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// A sealed volume whose bottom was separated from its walls.
struct Bowl {
    topology::OpenVolume volume; ///< with roles: the bottom is the source, the mouth the target
    std::vector<FaceId> parent;  ///< by face: the face of the sealed volume that it is part of
    FaceId mouth;                ///< a face of the target
    double depth = 0;            ///< depth of the cutting plane below the mouth [model length]
};

/// Separate the bottom of a hollow from its walls if they blend smoothly, as in a hemisphere, a bore with a
/// round end or a pocket with a rounded floor.
///
/// The mouth is a flat face with all other faces behind it. The cutting plane is at the lowest height where
/// the skin is inclined half as much as at its steepest, so that quads on both sides meet at similar angles.
/// Faces are split there.
/// @param sealed  watertight and oriented; its roles are ignored.
/// @return  empty if no face is such a mouth, if the inclination is the same everywhere, as on a cone, or if
///          the plane does not separate the skin into one bottom and a ring of walls for each rim of the
///          mouth.
/// @throw Cancelled
/// @note  O(facets) for each mouth tried, at most four.
std::optional<Bowl> part_bowl(const topology::OpenVolume& sealed, const RunContext& context);

} // namespace lacuna::closure
