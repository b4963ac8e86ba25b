// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <span>

namespace lacuna::geometry {

/// Which way a, b, c turn: > 0 counter-clockwise, < 0 clockwise, 0 exactly in line.
///
/// The sign is that of exact arithmetic on the coordinates given; the value is near twice the area. A filter
/// in plain doubles answers nearly always, the rest is summed as an expansion @cite shewchuk_1997_predicates.
/// @pre  no product of two coordinate differences over- or underflows.
double orient2d(const Vec2& a, const Vec2& b, const Vec2& c);

/// Where d lies to the circle through a, b, c (counter-clockwise): > 0 inside, < 0 outside, 0 exactly on it.
///
/// Exact in the same sense as `orient2d()`; the sign is turned when a, b, c run clockwise.
double incircle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

/// Whether a point lies inside a closed polygon that runs either way: by the sides that a ray from it meets.
///
/// Exact in the same sense as `orient2d()`. A point on a side may count as either.
bool lies_inside(std::span<const Vec2> polygon, const Vec2& p);

} // namespace lacuna::geometry
