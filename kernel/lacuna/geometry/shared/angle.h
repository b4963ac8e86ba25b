// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <Eigen/Geometry>

#include <cmath>

namespace lacuna::geometry {

/// Angle between two vectors of any length, 0 to π [radian]. Accurate near 0 and π too, unlike an arc cosine.
/// 0 if a vector has zero length.
inline double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

} // namespace lacuna::geometry
