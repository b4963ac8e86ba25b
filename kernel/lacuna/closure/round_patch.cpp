// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/round_patch.h>

#include <lacuna/closure/detail/axis_rims.h>
#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/detail/unrolled_wall.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/dense_solve.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/geometry/shared/signed_area.h>
#include <lacuna/geometry/shared/spread.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>

namespace lacuna::closure {

using namespace topology;

namespace {

/// A surface of revolution with a straight section: the distance from the axis is linear in the height.
struct RoundWall {
    geometry::Plane base; ///< plane normal to the axis
    double radius = 0, slope = 0;
    double step = 0; ///< mean segment length of the arc that it was found from [model length]

    [[nodiscard]] double radius_at(double height) const { return radius + slope * height; }
};

/// Mean length of the segments of the sides that are not straight [model length].
double bent_step(const Sides& sides)
{
    double sum = 0;
    std::size_t segments = 0;
    for (const std::vector<Vec3>& side : sides) {
        if (is_one_line(side)) continue;
        sum += geometry::length(side);
        segments += side.size() - 1;
    }
    return sum / static_cast<double>(segments);
}

/// The round wall along some sides; empty if there is none.
std::optional<RoundWall> wall_along(const Sides& sides)
{
    std::vector<Vec3> places;
    for (const std::vector<Vec3>& side : sides) {
        places.insert(places.end(), side.begin(), side.end());
        if (is_one_line(side)) // a chord has its ends on the wall, but not its middle
            places.push_back((side.front() + side.back()) / 2);
    }
    if (std::ranges::all_of(sides, is_one_line)) return std::nullopt;
    const double thickness = std::sqrt(geometry::spread_of(places).square(0));
    for (const Circle& circle : circles_across(sides, places)) {
        const auto count = static_cast<Eigen::Index>(places.size());
        Eigen::MatrixXd left(count, 2);
        Eigen::VectorXd right(count);
        for (Eigen::Index i = 0; i < count; ++i) {
            const Vec3& p = places[static_cast<std::size_t>(i)];
            left.row(i) << 1, geometry::height(circle.base, p);
            right(i) = distance_to_axis(circle.base, p);
        }
        const double low = left.col(1).minCoeff(), high = left.col(1).maxCoeff();
        if (high - low <= kVisible * circle.radius) continue; // a single circle determines no wall
        const Eigen::VectorXd fit = geometry::least_squares(left, right);
        const double off = (left * fit - right).cwiseAbs().maxCoeff(), least = right.minCoeff();
        // Sides that are nearly planar lie near any wide cylinder.
        if (off > kVisible * std::min(circle.radius, thickness) || !(least > kAlikeSizes * circle.radius))
            continue;
        return RoundWall{circle.base, fit(0), fit(1), bent_step(sides)};
    }
    return std::nullopt;
}

/// The round wall through a whole loop; empty if there is none, or if the loop runs round its axis.
std::optional<RoundWall> wall_through(const Model& model, const Loop& loop)
{
    Sides sides;
    for (const EdgeUse& use : loop.uses) sides.push_back(use_places(model, use));
    std::optional<RoundWall> wall = wall_along(sides);
    if (wall && std::abs(turn_round(wall->base, loop_places(model, loop.uses))) > kParallel) wall.reset();
    return wall;
}

} // namespace

bool given_sides_show_round_wall(const Model& model, const Loop& loop)
{
    Sides given;
    for (const EdgeUse& use : loop.uses)
        if (model[use.edge].origin == Origin::given) given.push_back(use_places(model, use));
    return !given.empty() && wall_along(given) && wall_through(model, loop);
}

std::vector<Vec3> edge_in_plane(const std::vector<std::vector<Vec3>>& sides, const geometry::Plane& plane)
{
    const std::optional<RoundWall> wall = wall_along(sides);
    // Straight sides that meet in the apex of a cone also bound lofts, which can end in a straight edge.
    if (!wall || std::abs(wall->slope) > kVisible) return {};
    const double slope = wall->base.normal.dot(plane.normal);
    if (std::abs(slope) <= kParallel) return {};
    double turn = 0;
    for (const std::vector<Vec3>& side : sides) turn += turn_along(wall->base, side);
    const Vec3 &start = sides.back().back(), &end = sides.front().front();
    const double first = angle_at(wall->base, start);
    const auto count = static_cast<int>(std::ceil(std::abs(turn) * wall->radius / wall->step - kVisible));
    std::vector<Vec3> edge{start};
    for (int k = 1; k < count; ++k) {
        const double angle = first - turn * k / count;
        const Vec2 out(std::cos(angle), std::sin(angle));
        const Vec3 low = geometry::from_plane(wall->base, wall->radius * out);
        edge.push_back(low - geometry::height(plane, low) / slope * wall->base.normal);
    }
    edge.push_back(end);
    return edge.size() > 2 ? edge : std::vector<Vec3>();
}

std::optional<VoidFilling> fill_round_patch(const Model& model, const Loop& loop, const RunContext& context)
{
    const std::optional<RoundWall> wall = wall_through(model, loop);
    if (!wall) return std::nullopt;
    const std::vector<Vec3> places = loop_places(model, loop.uses);
    std::vector<Vec2> unrolled;
    double turn = angle_at(wall->base, places.front());
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (i > 0) turn += turn_between(turn, angle_at(wall->base, places[i]));
        unrolled.emplace_back(turn * wall->radius, geometry::height(wall->base, places[i]));
    }
    // The facets run the same way round as the loop.
    const double sense = std::copysign(1, geometry::signed_area(unrolled));
    for (Vec2& p : unrolled) p.x() *= sense;
    Outline outline;
    outline.add_loop(unrolled, loop_points(model, loop.uses));
    if (geometry::find_crossing(outline.flat, outline.loops)) return std::nullopt;
    const geometry::Triangulation flat = triangulate_unrolled(outline, wall->step, context);
    VoidFilling result = filling_of(model, outline, flat, [&](std::size_t i) -> Vec3 {
        const double angle = sense * flat.points[i].x() / wall->radius, height = flat.points[i].y();
        const double radius = wall->radius_at(height);
        return geometry::from_plane(wall->base, radius * Vec2(std::cos(angle), std::sin(angle)), height);
    });
    result.loops = {loop};
    result.geometry = Geometry::transfinite;
    result.algorithm = "Algorithm 6";
    return result;
}

} // namespace lacuna::closure
