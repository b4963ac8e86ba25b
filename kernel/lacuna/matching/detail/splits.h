// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/matching/detail/loop_shape.h>
#include <lacuna/matching/match.h>

namespace lacuna::matching {

/// The split of an edge at a share of the rim's length.
/// @param shape  of the rim.
Split split_at(const topology::Rim& rim, const LoopShape& shape, double share);

} // namespace lacuna::matching
