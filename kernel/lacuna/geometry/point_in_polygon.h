// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <span>

namespace lacuna::geometry {

/// Whether a point lies within a closed polygon, by the even-odd rule; the first corner is not repeated.
///
/// A ray to the right is counted through the sides; each side is half open, so that a corner on the ray
/// counts once. Exact but for points on the polygon itself, which count as within on some sides only.
/// O(corners).
bool point_in_polygon(const Vec2& p, std::span<const Vec2> polygon);

} // namespace lacuna::geometry
