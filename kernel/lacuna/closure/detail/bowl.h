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
    std::vector<FaceId> parent;  ///< by face: the face of the sealed volume that this face is a part of
    FaceId mouth;                ///< a face of the target
    double depth = 0;            ///< depth of the cutting plane below the mouth [model length]
};

/// Separate the bottom of a hollow from its walls if they blend smoothly, as in a hemisphere, a bore with a
/// round end or a pocket with a rounded floor.
///
/// The mouth is the only end of the volume. If it has none or both, the mouth is a flat face, and all other
/// faces lie on one side of its plane. The cutting plane is perpendicular to the mean normal of the mouth, at
/// the lowest height where the inclination of the skin to the mouth reaches half of its largest value. Quads
/// of the bottom and of the walls are then about equally inclined to the cutting plane. The plane splits the
/// faces that it crosses.
/// @param sealed  watertight and oriented
/// @return  empty in any of these cases:
/// - no face is such a mouth;
/// - the inclination is the same everywhere, as on a cone;
/// - the bottom has sharp edges;
/// - the plane does not separate the skin into one bottom and a ring of walls for each rim of the mouth.
/// @throw Cancelled
/// @note  O(facets) for each mouth tried, at most four.
std::optional<Bowl> part_bowl(const topology::OpenVolume& sealed, const RunContext& context);

} // namespace lacuna::closure
