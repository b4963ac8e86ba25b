// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/plane_loops.h>

#include <lacuna/geometry/shared/signed_area.h>

#include <algorithm>

namespace lacuna::surface {

double signed_area(std::span<const Vec2> points, std::span<const Index> loop)
{
    std::vector<Vec2> outline;
    for (const Index p : loop) outline.push_back(points[index(p)]);
    return geometry::signed_area(outline);
}

void sort_outer_first(std::span<const Vec2> points, std::vector<std::vector<Index>>& loops)
{
    std::ranges::stable_sort(
        loops, [&](const auto& a, const auto& b) { return signed_area(points, a) > signed_area(points, b); });
}

} // namespace lacuna::surface
