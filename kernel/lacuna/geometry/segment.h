// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <algorithm>

namespace lacuna::geometry {

/// Distance of a point from the straight line between two others.
inline double distance_to_segment(const Vec3& point, const Vec3& from, const Vec3& to)
{
    const Vec3 way = to - from;
    const double square = way.squaredNorm();
    const double at = square > 0 ? std::clamp((point - from).dot(way) / square, 0.0, 1.0) : 0;
    return (point - from - at * way).norm();
}

} // namespace lacuna::geometry
