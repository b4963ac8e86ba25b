// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/shared/motion.h>
#include <lacuna/topology/open_volume.h>

namespace lacuna::surface {

/// The motion from the source to the target, if all walls are made by one: as of class 0, also from the other
/// end or in an assembly. Null otherwise, as for pieces that end on the way.
/// @note  O(facets of the walls).
geometry::MotionPointer swept_motion(const topology::OpenVolume& volume);

} // namespace lacuna::surface
