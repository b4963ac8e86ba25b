// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <span>
#include <vector>

namespace lacuna::geometry {

/// Sum of the angles of the facets at each point [radians].
std::vector<double> angles_at_points(std::span<const Vec3> points, std::span<const Triangle> triangles);

/// Tips of cones: inner points at which the angles of the facets sum to less than 90 % of a full turn. Empty
/// if there are more than 64 such points: then the facets are coarse, and the points are no tips.
/// @param triangles  consistently oriented; a side of only one triangle belongs to the border.
std::vector<Index> find_tips(std::span<const Vec3> points, std::span<const Triangle> triangles);

} // namespace lacuna::geometry
