// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/void_geometry.h>

#include <vector>

namespace lacuna::closure {

/// Fill a loop of four sides with a patch that is parametrised by the arc length of the sides. This is
/// Algorithm 6 of the paper (docs/bibliography.md), or Algorithm 5 if two opposite sides are the same edge (a
/// seam); see `fill()`.
/// @param sides  the four sides, in the order of the loop
/// @param follower  null, or the motion that the patch follows, see `fill()`.
/// @throw InvalidInput  the patch folds.
VoidFilling fill_transfinite(const topology::Model& model,
                             const std::vector<std::vector<topology::EdgeUse>>& sides,
                             const Follower* follower, const RunContext& context);

} // namespace lacuna::closure
