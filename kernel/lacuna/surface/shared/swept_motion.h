// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/shared/motion.h>
#include <lacuna/topology/open_volume.h>

namespace lacuna::surface {

/// The motion from the source to the target, or from the target to the source, if one motion made all walls.
/// Null otherwise, and also if the walls end before the motion ends, as on a piece of a swept volume.
/// @note  O(facets of the walls).
geometry::MotionPointer swept_motion(const topology::OpenVolume& volume);

} // namespace lacuna::surface
