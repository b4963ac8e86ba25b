// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <span>

namespace lacuna::geometry {

/// Orientation of a, b, c: > 0 counter-clockwise, < 0 clockwise, 0 exactly collinear.
///
/// The sign is exact for the given coordinates; the value approximates twice the area. A floating-point
/// filter decides most cases, the others are computed as expansions @cite shewchuk_1997_predicates.
/// @pre  no product of two coordinate differences overflows or underflows.
double orient2d(const Vec2& a, const Vec2& b, const Vec2& c);

/// Position of d relative to the circle through a, b, c (counter-clockwise): > 0 inside, < 0 outside, 0
/// exactly on it.
///
/// Exact in the same sense as `orient2d()`; the sign is reversed if a, b, c are clockwise.
double incircle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

/// Whether a point lies inside a closed polygon of either orientation. Counts the sides of the polygon that a
/// ray from the point crosses.
///
/// Exact in the same sense as `orient2d()`. A point on a side may count as inside or outside.
bool lies_inside(std::span<const Vec2> polygon, const Vec2& p);

/// Whether one closed polygon lies inside another. The two may share vertices or sides, but must not cross.
/// O(n log n).
bool encloses(std::span<const Vec2> outer, std::span<const Vec2> inner);

} // namespace lacuna::geometry
