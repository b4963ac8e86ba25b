// SPDX-License-Identifier: MIT
#include "plane_figures.h"

#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lacuna::bench {

namespace {

constexpr double kPi = std::numbers::pi;
/// Of the outline's radius: curves and their images that agree by this are the same. Arcs are exact.
constexpr double kSame = 1e-6;

using Lines = std::vector<std::vector<std::vector<Vec2>>>; ///< of each curve of each loop

Lines lines_of(const test::PlaneDomain& domain)
{
    Lines lines;
    for (const auto& loop : domain.loops) {
        lines.emplace_back();
        for (const test::PlaneCurve& curve : loop) lines.back().push_back(test::fine_line(curve));
    }
    return lines;
}

/// Points sorted by x, to be asked for the nearest.
class NearestPoint {
public:
    explicit NearestPoint(std::span<const Vec2> points) : points_(points.begin(), points.end())
    {
        std::sort(points_.begin(), points_.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
    }
    [[nodiscard]] double distance(const Vec2& p) const
    {
        const auto start = std::lower_bound(points_.begin(), points_.end(), p.x(),
                                            [](const Vec2& a, double x) { return a.x() < x; });
        double best = std::numeric_limits<double>::infinity();
        for (auto q = start; q != points_.end() && q->x() - p.x() < best; ++q)
            best = std::min(best, (*q - p).norm());
        for (auto q = start; q != points_.begin() && p.x() - (q - 1)->x() < best; --q)
            best = std::min(best, (*(q - 1) - p).norm());
        return best;
    }

private:
    std::vector<Vec2> points_;
};

} // namespace

int least_irregular(std::span<const double> angles, int euler)
{
    constexpr double kEither = 0.15; // see the header
    return quads::least_irregular(angles, euler, kEither);
}

int least_irregular(const test::PlaneDomain& domain)
{
    std::vector<double> angles;
    for (const auto& loop : lines_of(domain)) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::vector<Vec2>&in = loop[(i + loop.size() - 1) % loop.size()], &out = loop[i];
            const Vec2 back = in[in.size() - 2] - in.back(), ahead = out[1] - out[0];
            const double angle = std::atan2(ahead.x() * back.y() - ahead.y() * back.x(), ahead.dot(back));
            angles.push_back(angle > 0 ? angle : angle + 2 * kPi);
        }
    }
    return least_irregular(angles, 2 - static_cast<int>(domain.loops.size()));
}

std::vector<Symmetry> symmetries_of(const test::PlaneDomain& domain)
{
    if (domain.relative_size) return {};
    std::vector<Vec2> ends, line;
    double area = 0;
    Vec2 centre(0, 0);
    for (const auto& loop : lines_of(domain)) {
        for (const std::vector<Vec2>& curve : loop) {
            ends.push_back(curve.front());
            line.insert(line.end(), curve.begin(), curve.end());
            for (std::size_t i = 1; i < curve.size(); ++i) {
                const Vec2 &a = curve[i - 1], &b = curve[i];
                const double part = (a.x() * b.y() - a.y() * b.x()) / 2;
                area += part;
                centre += part * (a + b) / 3;
            }
        }
    }
    centre /= area;
    // The farthest end goes to ends as far away.
    const auto radius = [&](const Vec2& p) { return (p - centre).norm(); };
    const Vec2 far = *std::max_element(ends.begin(), ends.end(), [&](const Vec2& a, const Vec2& b) {
        return radius(a) < radius(b) - kSame * radius(b);
    });
    const double same = kSame * radius(far);
    const NearestPoint nearest_end(ends), nearest(line);
    const auto maps = [&](const Symmetry& s, const std::vector<Vec2>& points, const NearestPoint& onto) {
        return std::all_of(points.begin(), points.end(), [&](const Vec2& p) {
            return onto.distance(s.centre + s.turn * (p - s.centre)) < same;
        });
    };
    std::vector<Symmetry> found;
    const auto angle = [&](const Vec2& p) { return std::atan2(p.y() - centre.y(), p.x() - centre.x()); };
    for (const Vec2& end : ends) {
        if (std::abs(radius(end) - radius(far)) > same) continue;
        for (const bool reflects : {false, true}) {
            if (!reflects && (end - far).norm() < same) continue;
            const double by = reflects ? angle(end) + angle(far) : angle(end) - angle(far);
            Symmetry s{centre, Eigen::Rotation2Dd(by).toRotationMatrix()};
            if (reflects) s.turn.col(1) = -s.turn.col(1);
            const bool known = std::any_of(found.begin(), found.end(), [&](const Symmetry& other) {
                return (other.turn - s.turn).norm() < kSame;
            });
            if (!known && maps(s, ends, nearest_end) && maps(s, line, nearest)) found.push_back(s);
        }
    }
    return found;
}

double symmetry_error(std::span<const Vec2> points, std::span<const Symmetry> symmetries)
{
    const NearestPoint nearest(points);
    double most = 0;
    for (const Symmetry& s : symmetries) {
        for (const Vec2& p : points)
            most = std::max(most, nearest.distance(s.centre + s.turn * (p - s.centre)));
    }
    return most;
}

} // namespace lacuna::bench
