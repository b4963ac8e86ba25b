// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/shared/motion.h>
#include <lacuna/topology/open_volume.h>

namespace lacuna::surface {

/// The motion from the source to the target, if one motion made all walls, in either direction; otherwise
/// null. Also null if the walls end before the end of the motion, as those of a piece do.
/// @note  O(facets of the walls).
geometry::MotionPointer swept_motion(const topology::OpenVolume& volume);

} // namespace lacuna::surface
