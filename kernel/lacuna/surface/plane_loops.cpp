// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/plane_loops.h>

#include <algorithm>

namespace lacuna::surface {

double signed_area(std::span<const Vec2> points, std::span<const Index> loop)
{
    double sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2& a = points[static_cast<std::size_t>(loop[i])];
        const Vec2& b = points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
        sum += a.x() * b.y() - a.y() * b.x();
    }
    return sum / 2;
}

void sort_outer_first(std::span<const Vec2> points, std::vector<std::vector<Index>>& loops)
{
    std::ranges::stable_sort(
        loops, [&](const auto& a, const auto& b) { return signed_area(points, a) > signed_area(points, b); });
}

} // namespace lacuna::surface
