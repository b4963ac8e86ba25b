// SPDX-License-Identifier: MIT
#include <lacuna/geometry/newell.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/spread.h>

#include <cmath>
#include <limits>

namespace lacuna::geometry {

namespace {

Vec3 least_squares_normal(std::span<const std::vector<Vec3>> loops)
{
    std::vector<Vec3> points;
    for (const std::vector<Vec3>& loop : loops) points.insert(points.end(), loop.begin(), loop.end());
    return spread_of(points).axis.col(0);
}

/// Largest distance of a point from `origin`.
double extent(std::span<const std::vector<Vec3>> loops, const Vec3& origin)
{
    double largest = 0;
    for (const std::vector<Vec3>& loop : loops)
        for (const Vec3& point : loop) largest = std::max(largest, (point - origin).norm());
    return largest;
}

} // namespace

Vec3 newell_vector(std::span<const Vec3> closed_loop)
{
    Vec3 sum = Vec3::Zero();
    if (closed_loop.size() < 3) return sum;
    // Compute relative to one of its points, to keep precision for a small loop far from the origin.
    const Vec3 origin = closed_loop.front();
    for (std::size_t i = 1; i + 1 < closed_loop.size(); ++i)
        sum += (closed_loop[i] - origin).cross(closed_loop[i + 1] - origin);
    return 0.5 * sum;
}

Plane plane_across(const Vec3& origin, const Vec3& normal)
{
    Plane plane;
    plane.origin = origin;
    plane.normal = normal.normalized();
    int thinnest = 0;
    plane.normal.cwiseAbs().minCoeff(&thinnest);
    // Of the three coordinate axes, use the one with the largest angle to the normal: its cross product with
    // the normal has the smallest rounding error.
    plane.v = plane.normal.cross(Vec3::Unit(thinnest)).normalized();
    plane.u = plane.v.cross(plane.normal);
    return plane;
}

Plane newell_plane(std::span<const std::vector<Vec3>> loops)
{
    Vec3 normal = Vec3::Zero();
    const std::vector<Vec3>* first = nullptr;
    for (const std::vector<Vec3>& loop : loops) {
        normal += newell_vector(loop);
        if (!first && !loop.empty()) first = &loop;
    }
    if (!first)
        throw InvalidInput("geometry.no_points",
                           "the plane of loops needs at least one loop of three points or more");
    Vec3 origin = Vec3::Zero();
    for (const Vec3& point : *first) origin += point - first->front();
    origin = first->front() + origin / static_cast<double>(first->size());

    // Below the rounding error of the summed products, the direction is undefined.
    const double size = extent(loops, origin);
    const double noise = std::sqrt(std::numeric_limits<double>::epsilon()) * size * size;
    if (normal.norm() <= noise) normal = least_squares_normal(loops);
    return plane_across(origin, normal);
}

Vec2 to_plane(const Plane& plane, const Vec3& point)
{
    const Vec3 d = point - plane.origin;
    return {d.dot(plane.u), d.dot(plane.v)};
}

Vec3 from_plane(const Plane& plane, const Vec2& uv, double height)
{
    return plane.origin + uv.x() * plane.u + uv.y() * plane.v + height * plane.normal;
}

double height(const Plane& plane, const Vec3& point) { return (point - plane.origin).dot(plane.normal); }

} // namespace lacuna::geometry
