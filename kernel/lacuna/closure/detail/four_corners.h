// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Whether a loop turns sharply where one use goes over into the next.
bool turns_sharply(const topology::Model& model, topology::EdgeUse before, topology::EdgeUse after);

/// The uses of a loop that begin where it turns sharply, rising.
std::vector<std::size_t> sharp_corners(const topology::Model& model, const topology::Loop& loop);

/// The four sides of a loop that turns sharply at four of its vertices, in walking order; empty where it
/// turns at more or fewer.
///
/// Of the two ways to pair them the one is taken by which a patch that is moved along the second and the
/// fourth side brings the first nearest to the third: round an axis those two are arcs about it.
std::vector<std::vector<topology::EdgeUse>> four_corners(const topology::Model& model,
                                                         const topology::Loop& loop);

/// Whether uses that go on from each other lie on one straight line.
bool is_straight(const topology::Model& model, const std::vector<topology::EdgeUse>& side);

/// Whether two sides that face each other are straight, so that straight lines between the other two make
/// the patch.
bool is_ruled(const topology::Model& model, const std::vector<std::vector<topology::EdgeUse>>& sides);

} // namespace lacuna::closure
