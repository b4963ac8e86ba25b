// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Whether a loop turns sharply from one use to the next.
bool turns_sharply(const topology::Model& model, topology::EdgeUse before, topology::EdgeUse after);

/// Indices of the uses that begin at a sharp corner, ascending.
std::vector<std::size_t> sharp_corners(const topology::Model& model, const topology::Loop& loop);

/// The four sides of a loop with exactly four sharp corners, in walking order; otherwise empty.
///
/// The list starts with the first or the second side: the one that comes closer to its opposite side when it
/// is moved along its two neighbours. On a face round an axis, these neighbours are then arcs about the axis.
std::vector<std::vector<topology::EdgeUse>> four_corners(const topology::Model& model,
                                                         const topology::Loop& loop);

/// Whether consecutive uses lie on one straight line.
bool is_straight(const topology::Model& model, const std::vector<topology::EdgeUse>& side);

/// Whether two opposite sides are straight, so that the patch is ruled between the other two.
bool is_ruled(const topology::Model& model, const std::vector<std::vector<topology::EdgeUse>>& sides);

} // namespace lacuna::closure
