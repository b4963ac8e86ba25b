// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/tips.h>

#include <lacuna/geometry/shared/angle.h>

#include <cstdint>
#include <numbers>
#include <vector>

namespace lacuna::geometry {

std::vector<double> angles_at_points(std::span<const Vec3> points, std::span<const Triangle> triangles)
{
    std::vector<double> angle(points.size(), 0);
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& at = points[index(t[k])];
            const Vec3 a = points[index(t[(k + 1) % 3])] - at;
            const Vec3 b = points[index(t[(k + 2) % 3])] - at;
            angle[index(t[k])] += angle_between(a, b);
        }
    }
    return angle;
}

std::vector<Index> find_tips(std::span<const Vec3> points, std::span<const Triangle> triangles)
{
    // At a tip, the angles sum to at least this much less than a full turn (see tips.h). If there are more
    // tips than the limit, the facets are coarse, and the points are not tips of cones.
    constexpr double kLack = 0.2 * std::numbers::pi;
    constexpr std::size_t kMostTips = 64;
    const std::vector<double> angle = angles_at_points(points, triangles);
    // For each point, the sum of the neighbours' numbers, positive where the neighbour follows the point in a
    // triangle and negative where it precedes the point. At an inner point, every neighbour does both once,
    // so the sum is zero. At a border point it is not, because the first and the last neighbour do not
    // cancel.
    std::vector<std::int64_t> turn(points.size(), 0);
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k)
            turn[index(t[k])] += t[(k + 1) % 3] - std::int64_t{t[(k + 2) % 3]};
    }
    std::vector<Index> tips;
    for (std::size_t p = 0; p < angle.size(); ++p) {
        if (turn[p] != 0 || !(angle[p] > 0 && 2 * std::numbers::pi - angle[p] > kLack)) continue;
        if (tips.size() == kMostTips) return {};
        tips.push_back(static_cast<Index>(p));
    }
    return tips;
}

} // namespace lacuna::geometry
