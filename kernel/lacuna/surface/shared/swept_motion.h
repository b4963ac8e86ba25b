// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/shared/motion.h>
#include <lacuna/topology/open_volume.h>

namespace lacuna::surface {

/// If one motion created all walls (`geometry::SweptSurface`): the motion from the source to the target. Null
/// otherwise. Also null if the walls end before the motion ends, as on a piece of a swept volume.
/// @note  O(facets of the walls).
geometry::MotionPointer swept_motion(const topology::OpenVolume& volume);

} // namespace lacuna::surface
