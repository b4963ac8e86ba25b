// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/matching/detail/loop_shape.h>
#include <lacuna/matching/match.h>

namespace lacuna::matching {

/// The split that makes a partner for a vertex, at a share of a rim's length.
/// @param shape  shape of the rim.
Split split_at(VertexId vertex, bool on_target, const topology::Rim& rim, const LoopShape& shape,
               double share);

} // namespace lacuna::matching
