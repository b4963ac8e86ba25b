// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cmath>
#include <numbers>

namespace lacuna::geometry {

/// Twice the signed area of the triangle spanned by u and v, > 0 if v is to the left of u.
inline double cross(const Vec2& u, const Vec2& v) { return u.x() * v.y() - u.y() * v.x(); }

/// Angle from u counter-clockwise to v, in (0, 2π] [radians].
inline double turn_between(const Vec2& u, const Vec2& v)
{
    const double angle = std::atan2(cross(u, v), u.dot(v));
    return angle > 0 ? angle : angle + 2 * std::numbers::pi;
}

} // namespace lacuna::geometry
