// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/error.h>
#include <lacuna/core/types.h>

#include <span>
#include <string>
#include <string_view>

namespace lacuna::geometry {

/// @param name  of the loop; `purpose`: what it is used for. For messages.
/// @throw InvalidInput  the loop has fewer than 3 points, or a point that does not exist or is not finite.
template <class Point>
void check_loop_points(std::span<const Point> points, std::span<const Index> loop, const std::string& name,
                       std::string_view purpose)
{
    if (loop.size() < 3) {
        throw InvalidInput("geometry.short_loop", name + " has " + std::to_string(loop.size()) + " points; " +
                                                      std::string(purpose) + " needs at least 3");
    }
    for (const Index p : loop) {
        if (p >= 0 && index(p) < points.size() && points[index(p)].allFinite()) continue;
        throw InvalidInput("geometry.bad_point", name + " uses point " + std::to_string(p + 1) + " of " +
                                                     std::to_string(points.size()) +
                                                     ", which does not exist or is not finite");
    }
}

} // namespace lacuna::geometry
