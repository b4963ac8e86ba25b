// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// A sealed volume whose bottom was parted from its walls.
struct Bowl {
    topology::OpenVolume volume; ///< with roles: the bottom is the source, the mouth the target
    std::vector<FaceId> parent;  ///< of each of its faces: the one of the sealed volume it is part of
    FaceId mouth;                ///< a face of the target
    double depth = 0;            ///< of the parting plane below the mouth [model length]
};

/// Part the bottom of a hollow from its walls where one goes over into the other smoothly, as of a
/// hemisphere, a bore with a round end or a pocket with a rounded floor.
///
/// A flat face with all else behind it is the mouth. What lies behind it is sorted by height. The plane
/// across is where the skin leans half as much as where it is steepest, found from the bottom up, so that
/// quads of both parts meet at like angles. Faces are split there.
/// @param sealed  watertight and oriented; its roles are not read.
/// @return  nothing where no face is such a mouth, where the skin leans alike everywhere, as a cone does, or
///          where the plane does not part it into one bottom and a ring of walls for each rim of the mouth.
/// @throw Cancelled
/// @note  O(facets) for each mouth that is tried; no more than four are.
std::optional<Bowl> part_bowl(const topology::OpenVolume& sealed, const RunContext& context);

} // namespace lacuna::closure
