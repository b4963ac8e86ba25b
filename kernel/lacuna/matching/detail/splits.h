// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/matching/detail/loop_shape.h>
#include <lacuna/matching/match.h>

namespace lacuna::matching {

/// The place of a rim at a share of its length, as a split of an edge.
/// @param shape  of the rim.
Split split_at(const topology::Rim& rim, const LoopShape& shape, double share);

} // namespace lacuna::matching
