// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/axis_rims.h>

#include <lacuna/closure/detail/flat_fill.h>
#include <lacuna/closure/detail/four_corners.h>
#include <lacuna/closure/detail/touching_faces.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/dense_solve.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Whether all places are at a given distance from the axis.
bool is_round(const geometry::Plane& base, double radius, const std::vector<Vec3>& places)
{
    return std::ranges::all_of(places, [&](const Vec3& p) {
        return std::abs(distance_to_axis(base, p) - radius) <= kAlikeSizes * radius;
    });
}

/// The circle through the projections of places on a plane; empty if a place is off the circle.
std::optional<Circle> circle_through(const std::vector<Vec3>& places, const geometry::Plane& plane)
{
    // |p|² = 2 c·p + (r² - |c|²) is linear in the unknowns.
    const auto count = static_cast<Eigen::Index>(places.size());
    Eigen::MatrixXd left(count, 3);
    Eigen::VectorXd right(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Vec2 flat = geometry::to_plane(plane, places[static_cast<std::size_t>(i)]);
        left.row(i) << 2 * flat.x(), 2 * flat.y(), 1;
        right(i) = flat.squaredNorm();
    }
    const Eigen::VectorXd fit = geometry::least_squares(left, right);
    const Circle circle{geometry::plane_across(geometry::from_plane(plane, fit.head<2>()), plane.normal),
                        std::sqrt(std::max(0.0, fit(2) + fit.head<2>().squaredNorm()))};
    if (!(circle.radius > 0) || !is_round(circle.base, circle.radius, places)) return std::nullopt;
    return circle;
}

} // namespace

double angle_at(const geometry::Plane& base, const Vec3& place)
{
    const Vec2 flat = geometry::to_plane(base, place);
    return std::atan2(flat.y(), flat.x());
}

double turn_between(double a, double b) { return std::remainder(b - a, 2 * std::numbers::pi); }

double turn_along(const geometry::Plane& base, const std::vector<Vec3>& places)
{
    double sum = 0;
    for (std::size_t i = 1; i < places.size(); ++i)
        sum += turn_between(angle_at(base, places[i - 1]), angle_at(base, places[i]));
    return sum;
}

double turn_round(const geometry::Plane& base, const std::vector<Vec3>& places)
{
    return turn_along(base, places) +
           turn_between(angle_at(base, places.back()), angle_at(base, places.front()));
}

double distance_to_axis(const geometry::Plane& base, const Vec3& place)
{
    return geometry::to_plane(base, place).norm();
}

double wall_radius(const RoundRim& rim, double height) { return rim.radius + rim.slope * height; }

bool is_on_wall(const RoundRim& rim, const std::vector<Vec3>& places)
{
    return std::ranges::all_of(places, [&](const Vec3& p) {
        const double radius = wall_radius(rim, geometry::height(rim.base, p));
        return std::abs(distance_to_axis(rim.base, p) - radius) <= kAlikeSizes * rim.radius;
    });
}

bool is_of_wall(const Model& model, const RoundRim& rim, FaceId face)
{
    return !plane_of(model, face) && is_on_wall(rim, places_at(model, corner_points(model[face])));
}

bool is_one_line(const std::vector<Vec3>& side)
{
    const Vec3 way = (side.back() - side.front()).stableNormalized();
    return std::ranges::all_of(side, [&](const Vec3& p) {
        return (p - side.front()).cross(way).norm() <= kFileAccuracy * geometry::length(side);
    });
}

std::vector<Circle> circles_across(const Sides& sides, const std::vector<Vec3>& places)
{
    std::vector<Circle> arcs, across;
    for (const std::vector<Vec3>& side : sides) {
        if (is_one_line(side)) {
            const geometry::Plane plane = geometry::plane_across(side.front(),
                                                                 (side.back() - side.front()).normalized());
            std::vector<Vec3> image;
            for (const Vec3& p : places) image.push_back(p - geometry::height(plane, p) * plane.normal);
            if (auto circle = circle_through(image, plane)) across.push_back(*circle);
        } else if (side.size() > 3) { // any three points lie on a circle
            const auto circle = circle_through(side, geometry::newell_plane({&side, 1}));
            if (circle && std::ranges::all_of(side, [&](const Vec3& p) {
                    return std::abs(geometry::height(circle->base, p)) <= kVisible * circle->radius;
                }))
                arcs.push_back(*circle);
        }
    }
    arcs.insert(arcs.end(), across.begin(), across.end());
    return arcs;
}

std::optional<RoundRim> round_rim(const Model& model, const Rim& rim, std::size_t loop, const Circle& circle)
{
    const std::vector<Vec3> places = loop_places(model, rim.uses);
    if (!is_round(circle.base, circle.radius, places) ||
        std::abs(std::abs(turn_round(circle.base, places)) - 2 * std::numbers::pi) > kParallel)
        return std::nullopt;
    RoundRim round;
    round.loop = loop;
    round.base = circle.base;
    round.base.origin = geometry::from_plane(circle.base, Vec2::Zero(),
                                             geometry::height(circle.base, geometry::mean_point(places)));
    round.radius = circle.radius;
    for (const EdgeUse& use : rim.uses) round.beside.insert(model.uses_of_edge(use.edge).front().face);
    round.flat = is_flat(model, rim);
    round.needs_wall = std::ranges::all_of(round.beside, [&](FaceId face) {
        return round.flat ? lies_in_plane(model, face, round.base) : !is_of_wall(model, round, face);
    });
    return round;
}

std::optional<RoundRim> round_rim(const Model& model, const Rim& rim, std::size_t loop)
{
    const std::vector<Vec3> places = loop_places(model, rim.uses);
    const auto circle = circle_through(places, geometry::newell_plane({&places, 1}));
    return circle ? round_rim(model, rim, loop, *circle) : std::nullopt;
}

std::optional<RoundRim> round_rim_along_arc(const Model& model, const Rim& rim, std::size_t loop)
{
    Sides sides;
    for (const EdgeUse& use : rim.uses) sides.push_back(use_places(model, use));
    for (const Circle& circle : circles_across(sides, loop_places(model, rim.uses)))
        if (auto round = round_rim(model, rim, loop, circle)) return round;
    return std::nullopt;
}

std::optional<double> radius_of_circle(const Model& model, const Rim& rim)
{
    if (!is_flat(model, rim) || !sharp_corners(model, {rim.uses}).empty()) return std::nullopt;
    const auto round = round_rim(model, rim, 0);
    return round ? std::optional(round->radius) : std::nullopt;
}

} // namespace lacuna::closure
