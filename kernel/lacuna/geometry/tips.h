// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <span>
#include <vector>

namespace lacuna::geometry {

/// Points inside facets whose angles there lack more than a tenth of a full turn: tips of cones. None where
/// there are more than 64, which coarse facets have.
/// @param triangles  oriented alike; a side that one of them has alone is the border.
std::vector<Index> find_tips(std::span<const Vec3> points, std::span<const Triangle> triangles);

} // namespace lacuna::geometry
