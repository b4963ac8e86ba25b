// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/void_geometry.h>

#include <vector>

namespace lacuna::closure {

/// Algorithm 6, or Algorithm 5 if two opposite sides are the same edge (a seam): a patch between four sides
/// over arc length, see `fill()`.
/// @param sides  four, in walking order
/// @param follower  null, or the motion that the patch follows, see `fill()`.
/// @throw InvalidInput  the patch folds.
VoidFilling fill_transfinite(const topology::Model& model,
                             const std::vector<std::vector<topology::EdgeUse>>& sides,
                             const Follower* follower, const RunContext& context);

} // namespace lacuna::closure
