// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Whether the angle between consecutive uses of a loop exceeds `kCreaseAngle`.
bool turns_sharply(const topology::Model& model, topology::EdgeUse before, topology::EdgeUse after);

/// Indices of the uses that begin at a sharp corner (see `turns_sharply()`), ascending.
std::vector<std::size_t> sharp_corners(const topology::Model& model, const topology::Loop& loop);

/// The four sides of a loop with exactly four sharp corners, in the order of the loop; otherwise empty.
///
/// The list starts with a side whose sweep along its two neighbours comes close to the opposite side. Side 1
/// is swept along sides 2 and 4 and compared with side 3; side 2 is swept along sides 3 and 1 and compared
/// with side 4. The list starts with the side whose sweep is closer. For a face of revolution, the sides that
/// guide the sweep are then the arcs about the axis.
std::vector<std::vector<topology::EdgeUse>> four_corners(const topology::Model& model,
                                                         const topology::Loop& loop);

/// Whether consecutive uses lie on one straight line.
bool is_straight(const topology::Model& model, const std::vector<topology::EdgeUse>& side);

/// Whether two opposite sides are straight. The patch is then ruled between the other two.
bool is_ruled(const topology::Model& model, const std::vector<std::vector<topology::EdgeUse>>& sides);

} // namespace lacuna::closure
