// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <algorithm>

namespace lacuna::geometry {

/// Distance of a point from the segment between two others, in the plane or in space.
template <class Vec>
double distance_to_segment(const Vec& point, const Vec& from, const Vec& to)
{
    const Vec way = to - from;
    const double square = way.squaredNorm();
    const double at = square > 0 ? std::clamp((point - from).dot(way) / square, 0.0, 1.0) : 0.0;
    return (from + at * way - point).norm();
}

} // namespace lacuna::geometry
