// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/swept_surface.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/polyline.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lacuna::geometry {

namespace {

} // namespace

void PointPath::evaluate(std::span<const double> params, std::span<Vec3> points, const RunContext&) const
{
    for (std::size_t i = 0; i < params.size(); ++i) points[i] = motion_->place(point_, params[i]);
}

void MovedCurve::evaluate(std::span<const double> params, std::span<Vec3> points,
                          const RunContext& context) const
{
    curve_->evaluate(params, points, context);
    for (Vec3& p : points) p = motion_->place(p, height_);
}

void MovedSurface::project(std::span<Vec3> points, std::span<Vec2> uv, const RunContext& context) const
{
    const Eigen::Affine3d map = motion_->at(height_), back = map.inverse();
    for (Vec3& p : points) p = back * p;
    surface_->project(points, uv, context);
    for (Vec3& p : points) p = map * p;
}

std::vector<Vec3> SweptSurface::at(std::span<const Vec2> uv, const RunContext& context) const
{
    std::vector<Vec3> places(uv.size());
    if (edge_.curve) {
        std::vector<double> params;
        for (const Vec2& p : uv) params.push_back(p.x());
        edge_.curve->evaluate(params, places, context);
    } else {
        for (std::size_t i = 0; i < uv.size(); ++i)
            places[i] = point_at(edge_.points, edge_.params, uv[i].x());
    }
    for (std::size_t i = 0; i < uv.size(); ++i) places[i] = motion_->place(places[i], uv[i].y());
    return places;
}

void SweptSurface::project(std::span<Vec3> points, std::span<Vec2> uv, const RunContext& context) const
{
    const Vec2 low(edge_.params.front(), from_), high(edge_.params.back(), to_);
    // Central differences are most accurate for steps near the cube root of the rounding error.
    const Vec2 small = std::cbrt(std::numeric_limits<double>::epsilon()) * (high - low);
    const auto inside = [&](const Vec2& p) -> Vec2 { return p.cwiseMax(low).cwiseMin(high); };
    const std::size_t n = points.size();
    for (Vec2& p : uv) p = inside(p);
    // A projection starts at the nearest facet, so the first distance is at most the sag of a chord. Three to
    // five steps reduce the error to rounding.
    for (int step = 0; step < kMostRounds; ++step) {
        check_cancelled(context);
        // The place itself, and one place before and after it in each parameter.
        std::vector<Vec2> around(uv.begin(), uv.end());
        for (int d = 0; d < 2; ++d)
            for (const double way : {-1.0, 1.0})
                for (const Vec2& p : uv) around.push_back(inside(p + way * small[d] * Vec2::Unit(d)));
        const std::vector<Vec3> places = at(around, context);
        double largest = 0;
        for (std::size_t i = 0; i < n; ++i) {
            Eigen::Matrix<double, 3, 2> slope;
            for (std::size_t d = 0; d < 2; ++d) {
                const std::size_t before = (1 + 2 * d) * n + i, after = before + n;
                const auto row = static_cast<Eigen::Index>(d);
                slope.col(row) = (places[after] - places[before]) / (around[after] - around[before])[row];
            }
            const Eigen::Matrix2d normal = slope.transpose() * slope;
            const Vec2 off = slope.transpose() * (points[i] - places[i]);
            if (!(normal.determinant() > kRoundoff * normal(0, 0) * normal(1, 1))) continue;
            const Vec2 moved = inside(uv[i] + normal.inverse() * off);
            largest = std::max(largest, ((moved - uv[i]).cwiseQuotient(high - low)).cwiseAbs().maxCoeff());
            uv[i] = moved;
        }
        if (largest < kRoundoff) break;
    }
    const std::vector<Vec3> places = at(uv, context);
    std::ranges::copy(places, points.begin());
}

} // namespace lacuna::geometry
