// SPDX-License-Identifier: MIT
#pragma once

/// The sine of the corners of planar quads, the quality measure of this folder.

#include <lacuna/core/shared/constants.h>
#include <lacuna/geometry/shared/plane.h>

#include <algorithm>

namespace lacuna::quads {

using geometry::cross;
using geometry::turn_between;

/// Number of quads that suits an angle: the number of right angles nearest to it, at least one.
inline int quads_in(double angle) { return std::max(1, static_cast<int>(angle / kRightAngle + 0.5)); }

/// Sine of a corner; 0 if one of its sides has no length.
/// @param area     cross product of the two sides
/// @param lengths  product of their lengths
inline double corner_sine(double area, double lengths) { return lengths > 0 ? area / lengths : 0.0; }

/// Least sine of the corners of the quad a, b, c, d: 1 for a rectangle, > 0 if it is convex.
inline double least_sine(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
    const Vec2 ab = b - a, bc = c - b, cd = d - c, da = a - d;
    const double l0 = ab.norm(), l1 = bc.norm(), l2 = cd.norm(), l3 = da.norm();
    return std::min({corner_sine(cross(da, ab), l3 * l0), corner_sine(cross(ab, bc), l0 * l1),
                     corner_sine(cross(bc, cd), l1 * l2), corner_sine(cross(cd, da), l2 * l3)});
}

} // namespace lacuna::quads
