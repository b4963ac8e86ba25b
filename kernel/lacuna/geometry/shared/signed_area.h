// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/shared/plane.h>

#include <span>

namespace lacuna::geometry {

/// Signed area of a closed outline, > 0 if it runs counter-clockwise.
inline double signed_area(std::span<const Vec2> outline)
{
    double twice = 0;
    for (std::size_t i = 0; i < outline.size(); ++i)
        twice += cross(outline[i], outline[(i + 1) % outline.size()]);
    return twice / 2;
}

} // namespace lacuna::geometry
