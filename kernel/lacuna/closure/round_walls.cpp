// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/round_walls.h>

#include <lacuna/closure/detail/four_corners.h>
#include <lacuna/closure/detail/guesses.h>
#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/detail/touching_faces.h>
#include <lacuna/closure/detail/transfinite_fill.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/closure/detail/void_faces.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/dense_solve.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/geometry/shared/signed_area.h>
#include <lacuna/geometry/shared/spread.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <ranges>
#include <set>
#include <span>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

/// A rim that runs once round an axis at one distance.
struct RoundRim {
    std::size_t loop = 0;
    geometry::Plane base; ///< plane normal to the axis, through the centre of the rim
    double radius = 0;
    double slope = 0;        ///< of the wall at the rim: increase of its radius with the height above `base`
    bool flat = false;       ///< whether the rim is planar
    bool needs_wall = false; ///< whether no face inside the rim can close it
    std::set<FaceId> beside; ///< the given faces at the rim
    double along = 0;        ///< position on the common axis of the rims
};

/// Angle of a place round the axis of a rim [radian].
double angle_at(const geometry::Plane& base, const Vec3& place)
{
    const Vec2 flat = geometry::to_plane(base, place);
    return std::atan2(flat.y(), flat.x());
}

/// The angle from `a` to `b`, in (-π, π].
double turn_between(double a, double b) { return std::remainder(b - a, 2 * std::numbers::pi); }

/// The turn of an open chain round the axis.
double turn_along(const geometry::Plane& base, const std::vector<Vec3>& places)
{
    double sum = 0;
    for (std::size_t i = 1; i < places.size(); ++i)
        sum += turn_between(angle_at(base, places[i - 1]), angle_at(base, places[i]));
    return sum;
}

/// The turn of a closed chain round the axis: ±2π if the chain runs round the axis once.
double turn_round(const geometry::Plane& base, const std::vector<Vec3>& places)
{
    return turn_along(base, places) +
           turn_between(angle_at(base, places.back()), angle_at(base, places.front()));
}

double distance_to_axis(const geometry::Plane& base, const Vec3& place)
{
    return geometry::to_plane(base, place).norm();
}

/// Whether all places are at a given distance from the axis.
bool is_round(const geometry::Plane& base, double radius, const std::vector<Vec3>& places)
{
    return std::ranges::all_of(places, [&](const Vec3& p) {
        return std::abs(distance_to_axis(base, p) - radius) <= kAlikeSizes * radius;
    });
}

double wall_radius(const RoundRim& rim, double height) { return rim.radius + rim.slope * height; }

/// Whether all places are on the round wall through a rim.
bool is_on_wall(const RoundRim& rim, const std::vector<Vec3>& places)
{
    return std::ranges::all_of(places, [&](const Vec3& p) {
        const double radius = wall_radius(rim, geometry::height(rim.base, p));
        return std::abs(distance_to_axis(rim.base, p) - radius) <= kAlikeSizes * rim.radius;
    });
}

/// Whether a given face at a rim is a part of the round wall through the rim.
bool is_of_wall(const Model& model, const RoundRim& rim, FaceId face)
{
    return !plane_of(model, face) && is_on_wall(rim, places_at(model, corner_points(model[face])));
}

/// The circle that some places in one plane lie on.
struct Circle {
    geometry::Plane base; ///< plane of the circle, with its origin at the centre
    double radius = 0;
};

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

/// Consecutive sides of a rim, each with both of its ends.
using Sides = std::vector<std::vector<Vec3>>;

bool is_one_line(const std::vector<Vec3>& side)
{
    const Vec3 way = (side.back() - side.front()).stableNormalized();
    return std::ranges::all_of(side, [&](const Vec3& p) {
        return (p - side.front()).cross(way).norm() <= kFileAccuracy * geometry::length(side);
    });
}

/// The circles across the axes that a round wall along some sides may have: that of each side that is an arc
/// about the axis, and those about the directions of the straight sides.
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

/// A rim that runs once round the axis of a circle at its radius; empty for any other rim.
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

/// A rim that is not flat and runs once round the axis of one of its arcs; empty for any other rim.
std::optional<RoundRim> round_rim_along_arc(const Model& model, const Rim& rim, std::size_t loop)
{
    Sides sides;
    for (const EdgeUse& use : rim.uses) sides.push_back(use_places(model, use));
    for (const Circle& circle : circles_across(sides, loop_places(model, rim.uses)))
        if (auto round = round_rim(model, rim, loop, circle)) return round;
    return std::nullopt;
}

/// Whether a wall between two rims may be missing: they have one axis, and no given face at them continues
/// the wall.
bool may_join(const Model& model, const RoundRim& a, const RoundRim& b)
{
    const Vec3 apart = b.base.origin - a.base.origin;
    const double radius = std::max(a.radius, b.radius);
    if (a.base.normal.cross(b.base.normal).norm() > kVisible ||
        apart.cross(a.base.normal).norm() > kVisible * std::max(radius, apart.norm()))
        return false;
    const auto continues = [&](const RoundRim& rim) {
        return std::ranges::any_of(rim.beside, [&](FaceId face) { return is_of_wall(model, rim, face); });
    };
    return std::abs(a.radius - b.radius) <= kAlikeSizes * radius && !continues(a) && !continues(b);
}

/// Whether a loop is the rim of a hole in the round wall between two rims: it lies between the lowest and the
/// highest of the places of both rims.
bool is_hole_between(const Model& model, const Rim& loop, const RoundRim& axis,
                     const std::vector<Vec3>& rim_places)
{
    const std::vector<Vec3> places = loop_places(model, loop.uses);
    const auto height = [&](const Vec3& p) { return geometry::height(axis.base, p); };
    const auto [low, high] = std::ranges::minmax(rim_places, {}, height);
    return is_on_wall(axis, places) && std::abs(turn_round(axis.base, places)) <= kParallel &&
           std::ranges::all_of(
               places, [&](const Vec3& p) { return height(p) > height(low) && height(p) < height(high); });
}

/// Choose, among rims on one axis with one radius, the pairs between which a wall is missing.
std::vector<std::pair<RoundRim, RoundRim>> pairs_of(std::vector<RoundRim> group,
                                                    const std::vector<std::size_t>& part)
{
    const auto along = [&](const RoundRim& rim) {
        return (rim.base.origin - group.front().base.origin).dot(group.front().base.normal);
    };
    for (RoundRim& rim : group) rim.along = along(rim);
    std::ranges::stable_sort(group, {}, &RoundRim::along);
    std::vector<RoundRim> needy, other;
    for (const RoundRim& rim : group) (rim.needs_wall ? needy : other).push_back(rim);
    const auto total = [](const std::vector<RoundRim>& rims) {
        double sum = 0;
        for (std::size_t i = 0; i + 1 < rims.size(); i += 2) sum += rims[i + 1].along - rims[i].along;
        return sum;
    };
    if (needy.size() % 2 != 0) {
        std::vector<RoundRim> best;
        for (const RoundRim& one : other) {
            std::vector<RoundRim> with = needy;
            with.insert(std::ranges::upper_bound(with, one.along, {}, &RoundRim::along), one);
            if (best.empty() || total(with) < total(best)) best = std::move(with);
        }
        needy = std::move(best);
    }
    const auto part_of = [&](const RoundRim& rim) { return part[rim.beside.begin()->index()]; };
    if (needy.empty() && other.size() == 2 && part_of(other[0]) != part_of(other[1])) needy = other;
    std::vector<std::pair<RoundRim, RoundRim>> pairs;
    for (std::size_t i = 0; i + 1 < needy.size(); i += 2) pairs.emplace_back(needy[i], needy[i + 1]);
    return pairs;
}

/// Shift an unrolled hole by whole turns into an unrolled outline. @return  false if it lies outside
bool shift_inside(std::vector<Vec2>& hole, const std::vector<Vec2>& outer, double turn)
{
    for (const int turns : {0, 1, -1, 2, -2}) {
        const Vec2 shift(turns * turn, 0);
        if (!geometry::lies_inside(outer, hole.front() + shift)) continue;
        for (Vec2& place : hole) place += shift;
        return true;
    }
    return false;
}

/// The triangulation of a part of a round wall that is unrolled: angle times radius, and height.
geometry::Triangulation triangulate_unrolled(const Outline& outline, double step, const RunContext& context)
{
    Eigen::AlignedBox2d box;
    for (const Vec2& place : outline.flat) box.extend(place);
    geometry::TriangulateOptions fine;
    fine.size = [size = std::max(step, box.diagonal().norm() / kFineChords)](const Vec2&) { return size; };
    return geometry::triangulate(outline.flat, outline.loops, fine, context);
}

/// A closed chain of points, the first one repeated at the end.
struct Chain {
    std::vector<Vec3> places;
    std::vector<Index> points;
};

/// The chain of a loop, beginning at the point at which `cost` is least.
template <class Cost>
Chain chain_from(const Model& model, const std::vector<EdgeUse>& loop, const Cost& cost)
{
    Chain chain{loop_places(model, loop), loop_points(model, loop)};
    const auto first = std::ranges::min_element(chain.places, {}, cost) - chain.places.begin();
    std::ranges::rotate(chain.places, chain.places.begin() + first);
    std::ranges::rotate(chain.points, chain.points.begin() + first);
    chain.places.push_back(chain.places.front());
    chain.points.push_back(chain.points.front());
    return chain;
}

/// A round wall that is cut open and unrolled: angle times radius, and height.
struct UnrolledWall {
    Outline outline;
    std::vector<Vec2> cut;      ///< inner points of the cut, from the foot to the top
    std::size_t foot_count = 0; ///< number of the outline's points on the foot, which come first
    std::size_t last = 0;       ///< the last point of the outline that is not on a hole
    double step = 0;            ///< mean side of the foot [model length]
};

/// Unroll the wall between two rims. It is cut open between two points of the rims, as far from the holes as
/// possible; of the points at one angle, such as those at a step of a rim, the one next to the other rim is
/// taken. @return  empty if the outline crosses itself
std::optional<UnrolledWall> unroll_wall(const Model& model, const RoundRim& from,
                                        const std::vector<EdgeUse>& a, const std::vector<EdgeUse>& b,
                                        const std::vector<Loop>& holes)
{
    const double whole = 2 * std::numbers::pi;
    const auto angle = [&](const Vec3& p) { return angle_at(from.base, p); };
    const auto unroll = [&](const std::vector<Vec3>& places, double& turn) {
        std::vector<Vec2> flat;
        for (const Vec3& p : places) {
            turn += turn_between(turn, angle(p));
            flat.emplace_back(turn * from.radius, geometry::height(from.base, p));
        }
        return flat;
    };
    const double side = std::copysign(
        1, geometry::height(from.base, geometry::mean_point(loop_places(model, b))));
    const auto height = [&](const Vec3& p) { return side * geometry::height(from.base, p); };
    const Chain foot = chain_from(model, a, [&](const Vec3& p) {
        double least = std::numbers::pi;
        for (const Loop& hole : holes)
            for (const Vec3& q : loop_places(model, hole.uses))
                least = std::min(least, std::abs(turn_between(angle(p), angle(q))));
        return std::pair(-least, -height(p));
    });
    Chain top = chain_from(model, b, [&](const Vec3& p) {
        const double off = std::abs(turn_between(angle(foot.places.front()), angle(p)));
        return std::pair(std::round(off / kAlikeSizes), height(p)); // rounded: points at one angle are alike
    });
    std::ranges::reverse(top.places);
    std::ranges::reverse(top.points);

    UnrolledWall wall;
    wall.foot_count = foot.places.size();
    wall.step = whole * from.radius / static_cast<double>(foot.places.size() - 1);
    double turn = angle(foot.places.front());
    std::vector<Vec2> flat = unroll(foot.places, turn);
    const std::vector<Vec2> above = unroll(top.places, turn);
    const Vec2 start = flat.back(), round = flat.front() - start;
    const auto cuts = static_cast<std::size_t>((top.places.front() - foot.places.front()).norm() / wall.step);
    for (std::size_t k = 1; k <= cuts; ++k)
        wall.cut.push_back(start +
                           static_cast<double>(k) / static_cast<double>(cuts + 1) * (above.front() - start));
    flat.insert(flat.end(), wall.cut.begin(), wall.cut.end());
    flat.insert(flat.end(), above.begin(), above.end());
    for (const Vec2& p : wall.cut | std::views::reverse) flat.push_back(p + round);
    std::vector<Index> points = foot.points;
    points.resize(points.size() + cuts);
    points.insert(points.end(), top.points.begin(), top.points.end());
    points.resize(points.size() + cuts);
    wall.last = flat.size() - 1;
    wall.outline.add_loop(flat, points);
    for (const Loop& hole : holes) {
        turn = 0;
        std::vector<Vec2> places = unroll(loop_places(model, hole.uses), turn);
        if (!shift_inside(places, flat, whole * from.radius)) return std::nullopt;
        wall.outline.add_loop(places, loop_points(model, hole.uses));
    }
    if (geometry::find_crossing(wall.outline.flat, wall.outline.loops)) return std::nullopt;
    return wall;
}

/// The wall between two rims with holes, as one face without void edges.
/// @return  empty if the unrolled wall crosses itself or a hole
std::optional<VoidFilling> fill_round_wall(const Model& model, const RoundRim& from,
                                           const std::vector<EdgeUse>& a, const std::vector<EdgeUse>& b,
                                           const std::vector<Loop>& holes, const RunContext& context)
{
    std::optional<UnrolledWall> wall = unroll_wall(model, from, a, b, holes);
    if (!wall) return std::nullopt;
    Outline& outline = wall->outline;
    const geometry::Triangulation net = triangulate_unrolled(outline, wall->step, context);
    const auto lift = [&](const Vec2& p) -> Vec3 {
        const double at = p.x() / from.radius;
        return geometry::from_plane(from.base, wall_radius(from, p.y()) * Vec2(std::cos(at), std::sin(at)),
                                    p.y());
    };
    // The points of the cut follow those inside. Each is listed twice in the outline.
    for (std::size_t k = 0; k < wall->cut.size(); ++k)
        outline.model_point[wall->foot_count + k] = outline.model_point[wall->last - k] = static_cast<Index>(
            model.points.size() + net.points.size() - outline.flat.size() + k);
    VoidFilling result = filling_of(model, outline, net, [&](std::size_t i) { return lift(net.points[i]); });
    for (const Vec2& p : wall->cut) result.points.push_back(lift(p));
    result.loops = {{a}, {closure::reversed({b})}};
    result.loops.insert(result.loops.end(), holes.begin(), holes.end());
    result.geometry = Geometry::transfinite;
    result.algorithm = "Algorithm 6";
    return result;
}

/// Add the wall between two rims. @return  false if the unrolled wall crosses itself or a hole
bool add_tube(FlatFilling& filling, const RoundRim& from, const std::vector<EdgeUse>& a,
              std::vector<EdgeUse> b, const std::vector<Loop>& holes, const RunContext& context)
{
    const Model& model = filling.volume.model;
    const auto sense = [&](const std::vector<EdgeUse>& uses) {
        return turn_round(from.base, loop_places(model, uses)) > 0;
    };
    if (sense(a) != sense(b)) b = closure::reversed({b}).uses;
    auto wall = fill_round_wall(model, from, a, b, holes, context);
    if (!wall) return false;
    filling.closure.void_faces.push_back(add_void_face(filling.volume, std::move(*wall), Role::wall));
    return true;
}

/// Whether the given faces at a rim run along an axis.
bool runs_along(const Model& model, const Rim& rim, const Vec3& axis)
{
    return std::ranges::all_of(rim.uses, [&](const EdgeUse& use) {
        return std::ranges::all_of(model.uses_of_edge(use.edge), [&](const FaceUse& by) {
            return model[by.face].origin != Origin::given ||
                   std::ranges::all_of(facet_normals(model, by.face).normals,
                                       [&](const Vec3& n) { return std::abs(n.dot(axis)) <= kParallel; });
        });
    });
}

/// The nearest flat rim across the axis of a round rim, on one side of it, whose given faces run along the
/// axis, and which lies inside or around the image of the round rim in its plane. Empty if there is none.
std::optional<geometry::Plane> plane_beyond(const Model& model, const std::vector<Rim>& loops,
                                            const std::set<std::size_t>& joined, const RoundRim& rim)
{
    const std::vector<Vec3> own = loop_places(model, loops[rim.loop].uses);
    std::optional<geometry::Plane> nearest;
    double distance = kInfinity;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        if (l == rim.loop || joined.contains(l) || !is_flat(model, loops[l])) continue;
        const std::vector<Vec3> places = loop_places(model, loops[l].uses);
        const geometry::Plane plane = geometry::newell_plane({&places, 1});
        const auto height = [&](const Vec3& p) { return geometry::height(plane, p); };
        const auto [low, high] = std::ranges::minmax(own, {}, height);
        const double apart = std::max(height(low), -height(high)); // negative if the plane crosses the rim
        const auto is_inside = [&](const Vec3& p) { return distance_to_axis(rim.base, p) < rim.radius; };
        const auto inside = std::ranges::count_if(places, is_inside);
        if (plane.normal.cross(rim.base.normal).norm() > kParallel || apart <= model.tolerance ||
            apart >= distance || (inside > 0 && inside < std::ssize(places)))
            continue;
        if (!runs_along(model, loops[l], rim.base.normal)) continue;
        nearest = plane;
        distance = apart;
    }
    return nearest;
}

/// A conical wall between two rims on one axis.
struct ConeWall {
    RoundRim from;
    std::size_t to = 0; ///< the other loop
    double height = 0;  ///< mean height of the other loop above the rim
};

/// The conical wall through a circle and a loop round its axis, at which no given face continues this wall;
/// empty if there is none.
std::optional<ConeWall> cone_to(const Model& model, RoundRim circle, const Rim& loop, std::size_t to)
{
    const std::vector<Vec3> places = loop_places(model, loop.uses);
    double product = 0, square = 0;
    for (const Vec3& p : places) {
        const double height = geometry::height(circle.base, p);
        product += height * (distance_to_axis(circle.base, p) - circle.radius);
        square += height * height;
    }
    circle.slope = product / square;
    const double rise = std::sqrt(square / static_cast<double>(places.size()));
    if (!(rise > model.tolerance) || std::abs(circle.slope) * rise <= kAlikeSizes * circle.radius ||
        !is_on_wall(circle, places) ||
        std::abs(std::abs(turn_round(circle.base, places)) - 2 * std::numbers::pi) > kParallel)
        return std::nullopt;
    const auto continues = [&](FaceId face) { return is_of_wall(model, circle, face); };
    if (std::ranges::any_of(circle.beside, continues) ||
        std::ranges::any_of(loop.uses, [&](const EdgeUse& use) {
            return continues(model.uses_of_edge(use.edge).front().face);
        }))
        return std::nullopt;
    return ConeWall{std::move(circle), to, rise};
}

/// Conical walls between free loops that are not joined yet, the shortest first. One of the rims needs a
/// wall, or these are the only two loops, of unconnected parts. Unless the cone is one of 45°, such as a
/// chamfer, a straight wall up to the plane of the next flat rim is likelier, and one rim does not suffice
/// that needs a wall because it is a hole: the hole may be closed, or go through another face.
std::vector<ConeWall> cones_between(const Model& model, const std::vector<Rim>& loops,
                                    const std::vector<RoundRim>& round, const std::set<std::size_t>& joined,
                                    const std::vector<std::size_t>& part)
{
    const auto part_of = [&](std::size_t l) {
        return part[model.uses_of_edge(loops[l].uses.front().edge).front().face.index()];
    };
    std::vector<ConeWall> cones;
    for (const RoundRim& circle : round) {
        if (!circle.flat || joined.contains(circle.loop)) continue;
        for (std::size_t l = 0; l < loops.size(); ++l) {
            const auto other = std::ranges::find(round, l, &RoundRim::loop);
            const bool is_circle = other != round.end() && other->flat;
            if (joined.contains(l) || l == circle.loop || (is_circle && l < circle.loop)) continue;
            auto cone = cone_to(model, circle, loops[l], l);
            if (!cone) continue;
            const bool alone = loops.size() == joined.size() + 2 && part_of(l) != part_of(circle.loop);
            const bool needs = !is_circle || other->needs_wall;
            const auto ends_face = [&](const RoundRim& rim) {
                return rim.needs_wall && std::ranges::any_of(rim.beside, [&](FaceId face) {
                           const std::vector<EdgeUse>& outer = model[face].loops.front().uses;
                           return std::ranges::find(outer, loops[rim.loop].uses.front().edge,
                                                    &EdgeUse::edge) != outer.end();
                       });
            };
            const bool ends = ends_face(circle) || (is_circle && ends_face(*other));
            const auto is_stepped = [&](const RoundRim& rim) {
                const auto plane = rim.needs_wall ? plane_beyond(model, loops, joined, rim) : std::nullopt;
                return plane &&
                       std::abs(geometry::height(*plane, rim.base.origin)) <= cone->height + model.tolerance;
            };
            const bool stepped = is_stepped(circle) || (is_circle && is_stepped(*other));
            const bool is_chamfer = std::abs(std::abs(cone->from.slope) - 1) <= kAlikeSizes;
            const bool both = circle.needs_wall && needs, any = circle.needs_wall || needs;
            if (is_chamfer ? !(any || alone) : stepped || !(ends || both || alone)) continue;
            cones.push_back(std::move(*cone));
        }
    }
    std::ranges::stable_sort(cones, {}, &ConeWall::height);
    return cones;
}

/// The image of a round rim in a plane across its axis. Empty if the rim turns back on its way.
std::vector<Vec3> image_in(const RoundRim& rim, const std::vector<Vec3>& places, const geometry::Plane& plane)
{
    std::vector<Vec3> image;
    const double sense = turn_round(rim.base, places);
    for (const Vec3& p : places) {
        const double turn = image.empty() ? sense : turn_along(rim.base, {image.back(), p});
        if (std::abs(turn) <= kAlikeSizes) continue; // along the axis
        if (turn * sense < 0) return {};
        image.push_back(p - geometry::height(plane, p) * plane.normal);
    }
    if (std::abs(turn_along(rim.base, {image.back(), image.front()})) <= kAlikeSizes) image.pop_back();
    return image;
}

/// Add a closed void edge through some places.
Rim add_closed_edge(Model& model, const std::vector<Vec3>& places)
{
    ModelBuilder builder(std::move(model));
    builder.points.push_back(places.front());
    const VertexId start = builder.add_void_vertex(static_cast<Index>(builder.points.size()) - 1);
    model = std::move(builder).finish();
    return {{{add_void_edge_through(model, start, start, {places.begin() + 1, places.end()}), false}}};
}

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

void add_wall(FlatFilling& filling, const std::vector<std::vector<EdgeUse>>& sides, const RunContext& context)
{
    VoidFilling wall = fill_transfinite(filling.volume.model, sides, nullptr, context);
    Loop& loop = wall.loops.emplace_back();
    for (const std::vector<EdgeUse>& side : sides)
        loop.uses.insert(loop.uses.end(), side.begin(), side.end());
    filling.closure.void_faces.push_back(add_void_face(filling.volume, std::move(wall), Role::wall));
}

std::optional<double> radius_of_circle(const Model& model, const Rim& rim)
{
    if (!is_flat(model, rim) || !sharp_corners(model, {rim.uses}).empty()) return std::nullopt;
    const auto round = round_rim(model, rim, 0);
    return round ? std::optional(round->radius) : std::nullopt;
}

bool continues_given_planes(const Model& model, const Rim& rim)
{
    if (!is_flat(model, rim)) return false;
    const std::vector<Vec3> places = loop_places(model, rim.uses);
    const geometry::Plane plane = geometry::newell_plane({&places, 1});
    return std::ranges::all_of(rim.uses, [&](const EdgeUse& use) {
        const std::span<const FaceUse> by = model.uses_of_edge(use.edge);
        return !by.empty() && lies_in_plane(model, by.front().face, plane);
    });
}

bool is_ring_at_step(const Model& model, FaceId face)
{
    const std::vector<Rim> both = rims(model, {face});
    if (both.size() != 2 || plane_of(model, face) || round_shape(model, face)) return false;
    const double a = geometry::length(use_places(model, both[0].uses)),
                 b = geometry::length(use_places(model, both[1].uses));
    const bool first = continues_given_planes(model, both[0]);
    if (std::abs(a - b) <= kAlikeSizes * std::max(a, b) || first == continues_given_planes(model, both[1]))
        return false;
    const std::vector<Vec3> near = loop_places(model, both[first ? 0 : 1].uses),
                            far = loop_places(model, both[first ? 1 : 0].uses);
    const geometry::Plane plane = geometry::newell_plane({&near, 1});
    const double rise = std::abs(geometry::height(plane, geometry::mean_point(far)));
    const double wider = std::abs(a - b) / (2 * std::numbers::pi);
    return std::abs(rise - wider) > kAlikeSizes * wider &&
           runs_along(model, both[first ? 1 : 0], plane.normal);
}

bool is_bent_ring(const Model& model, FaceId face)
{
    return rims(model, {face}).size() == 2 && !plane_of(model, face) && !round_shape(model, face) &&
           !cone_shape(model, face) && !is_ruled_between_alike(model, model[face].loops.front());
}

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

std::vector<Rim> add_tubes(FlatFilling& filling, std::vector<Rim> loops, const RunContext& context)
{
    const Model model = filling.volume.model;
    std::vector<std::vector<RoundRim>> groups;
    std::vector<std::size_t> other; // loops that are round no axis of their own
    const auto join = [&](const auto& rim_at) {
        return std::ranges::any_of(groups, [&](std::vector<RoundRim>& group) {
            const std::optional<RoundRim> rim = rim_at(group.front());
            if (!rim || !may_join(model, group.front(), *rim)) return false;
            group.push_back(*rim);
            return true;
        });
    };
    for (std::size_t l = 0; l < loops.size(); ++l) {
        const auto rim = round_rim(model, loops[l], l);
        if (!rim)
            other.push_back(l);
        else if (!join([&](const RoundRim&) { return rim; }))
            groups.push_back({*rim});
    }
    // A rim that is not flat, such as one with a step, may run round the axis of a circle.
    std::erase_if(other, [&](std::size_t l) {
        return join([&](const RoundRim& first) {
            return round_rim(model, loops[l], l, Circle{first.base, first.radius});
        });
    });
    for (const std::size_t l : other)
        if (const auto rim = round_rim_along_arc(model, loops[l], l)) groups.push_back({*rim});
    std::vector<std::size_t> part(model.faces.size());
    const std::vector<std::vector<FaceId>> parts = connected_parts(model, all_faces(model));
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (const FaceId face : parts[p]) part[face.index()] = p;
    std::set<std::size_t> joined;
    const auto holes_between = [&](const RoundRim& from, std::vector<Vec3> places) {
        std::pair<std::vector<Loop>, std::vector<std::size_t>> holes;
        std::ranges::copy(loop_places(model, loops[from.loop].uses), std::back_inserter(places));
        for (std::size_t l = 0; l < loops.size(); ++l) {
            if (joined.contains(l) || !is_hole_between(model, loops[l], from, places)) continue;
            holes.first.push_back({loops[l].uses});
            holes.second.push_back(l);
        }
        return holes;
    };
    for (const std::vector<RoundRim>& group : groups) {
        for (const auto& [from, to] : pairs_of(group, part)) {
            check_cancelled(context);
            const auto [holes, taken] = holes_between(from, loop_places(model, loops[to.loop].uses));
            if (!add_tube(filling, from, loops[from.loop].uses, loops[to.loop].uses, holes, context))
                continue;
            joined.insert(taken.begin(), taken.end());
            joined.insert({from.loop, to.loop});
            const std::vector<FaceId> faces{*from.beside.begin(), *to.beside.begin()};
            assume(filling.closure,
                   {"closure.round_wall", "the rims of {} are joined by a straight round wall",
                    entities_of(model, faces)},
                   from.needs_wall && to.needs_wall && holes.empty() ? 0 : 1, Assumed::round_wall);
        }
    }
    std::vector<RoundRim> round;
    for (const std::vector<RoundRim>& group : groups) round.insert(round.end(), group.begin(), group.end());
    for (const ConeWall& cone : cones_between(model, loops, round, joined, part)) {
        if (joined.contains(cone.from.loop) || joined.contains(cone.to)) continue;
        const std::vector<EdgeUse>&foot = loops[cone.from.loop].uses, &top = loops[cone.to].uses;
        const auto [holes, taken] = holes_between(cone.from, loop_places(model, top));
        if (!add_tube(filling, cone.from, foot, top, holes, context)) continue;
        joined.insert(taken.begin(), taken.end());
        joined.insert({cone.from.loop, cone.to});
        assume(filling.closure,
               {"closure.round_wall", "the rims of {} are joined by a straight round wall",
                entities_of(model, std::vector{*cone.from.beside.begin(),
                                               model.uses_of_edge(top.front().edge).front().face})},
               1, Assumed::round_wall);
    }
    std::vector<Rim> images;
    for (const std::vector<RoundRim>& group : groups) {
        for (const RoundRim& rim : group) {
            const auto plane = rim.needs_wall && !joined.contains(rim.loop)
                                   ? plane_beyond(model, loops, joined, rim)
                                   : std::nullopt;
            const std::vector<Vec3> image =
                plane ? image_in(rim, loop_places(model, loops[rim.loop].uses), *plane) : std::vector<Vec3>();
            if (image.empty()) continue;
            const auto [holes, taken] = holes_between(rim, image);
            // add_straight_walls() adds the walls of flat rims, with edges from vertex to vertex.
            if (rim.flat && holes.empty()) continue;
            const Rim top = add_closed_edge(filling.volume.model, image);
            if (!add_tube(filling, rim, loops[rim.loop].uses, top.uses, holes, context)) continue;
            filling.closure.void_edges.push_back(top.uses.front().edge);
            joined.insert(taken.begin(), taken.end());
            joined.insert(rim.loop);
            images.push_back(top);
            assume(filling.closure,
                   {"closure.straight_wall",
                    "the missing wall at the rim of {} is assumed to be straight, up to the plane of the "
                    "next flat rim",
                    entity_of(model, *rim.beside.begin())},
                   1, Assumed::straight);
        }
    }
    std::vector<Rim> left = std::move(images);
    for (std::size_t l = 0; l < loops.size(); ++l)
        if (!joined.contains(l)) left.push_back(std::move(loops[l]));
    return left;
}

} // namespace lacuna::closure
