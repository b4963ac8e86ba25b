// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/polyline.h>

#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/angle.h>

#include <algorithm>

namespace lacuna::geometry {

std::vector<double> arc_lengths(std::span<const Vec3> points)
{
    std::vector<double> lengths(points.size(), 0.0);
    for (std::size_t i = 1; i < points.size(); ++i)
        lengths[i] = lengths[i - 1] + (points[i] - points[i - 1]).norm();
    return lengths;
}

double length(std::span<const Vec3> points) { return points.empty() ? 0 : arc_lengths(points).back(); }

Vec3 centre_of_ring(std::span<const Vec3> points)
{
    Vec3 sum = Vec3::Zero();
    double length = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 &a = points[i], &b = points[(i + 1) % points.size()];
        sum += (b - a).norm() * (a + b) / 2;
        length += (b - a).norm();
    }
    return length > 0 ? Vec3(sum / length) : mean_point(points);
}

PolylinePlace place_at(std::span<const double> arc_lengths, double s)
{
    const std::size_t count = arc_lengths.size();
    if (count < 2 || !(s > arc_lengths.front())) return {};
    if (s >= arc_lengths.back()) return {count - 2, 1.0};
    // The segment starts at the last point at or before s, so the next point is strictly after s.
    const auto after = std::upper_bound(arc_lengths.begin(), arc_lengths.end(), s);
    const auto segment = static_cast<std::size_t>(after - arc_lengths.begin()) - 1;
    const double begin = arc_lengths[segment];
    return {segment, (s - begin) / (*after - begin)};
}

Vec3 point_at(std::span<const Vec3> points, std::span<const double> arc_lengths, double s)
{
    if (points.size() == 1) return points.front();
    const PolylinePlace place = place_at(arc_lengths, s);
    const Vec3& a = points[place.segment];
    const Vec3& b = points[place.segment + 1];
    if (place.fraction == 0) return a;
    if (place.fraction == 1) return b;
    return a + place.fraction * (b - a);
}

std::vector<Vec3> even_places(std::span<const Vec3> points, std::size_t pieces)
{
    const std::vector<double> arc = arc_lengths(points);
    std::vector<Vec3> result{points.front()};
    for (std::size_t i = 1; i < pieces; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(pieces);
        result.push_back(point_at(points, arc, arc.back() * share));
    }
    result.push_back(points.back());
    return result;
}

Vec3 end_tangent(std::span<const Vec3> points)
{
    const std::size_t n = points.size();
    const Vec3 last = (points[n - 1] - points[n - 2]).stableNormalized();
    if (n < 3) return last;
    const Vec3 before = (points[n - 2] - points[n - 3]).stableNormalized();
    return (1.5 * last - 0.5 * before).stableNormalized();
}

double sag(std::span<const Vec3> points)
{
    double most = 0;
    for (std::size_t i = 0; i + 2 < points.size(); ++i) {
        const Vec3 a = points[i + 1] - points[i], b = points[i + 2] - points[i + 1];
        if (a.dot(b) <= 0) continue;
        const double angle = angle_between(a, b);
        most = std::max(most, std::max(a.norm(), b.norm()) * angle / 8);
    }
    return most;
}

} // namespace lacuna::geometry
