// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <Eigen/Geometry>

#include <cmath>

namespace lacuna::geometry {

/// Angle between two directions of any length, 0 to π [radian]: to rounding near both ends too, where an arc
/// cosine is not. 0 where one of them has no length.
inline double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

} // namespace lacuna::geometry
