// SPDX-License-Identifier: MIT
#include <lacuna/geometry/point_in_polygon.h>

#include <lacuna/geometry/predicates.h>

#include <cstddef>

namespace lacuna::geometry {

bool point_in_polygon(const Vec2& p, std::span<const Vec2> polygon)
{
    bool within = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if ((a.y() > p.y()) == (b.y() > p.y())) continue;
        const bool left = orient2d(a, b, p) > 0;
        if (left == (b.y() > a.y())) within = !within;
    }
    return within;
}

} // namespace lacuna::geometry
