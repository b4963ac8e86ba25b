// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/unrolled_wall.h>

#include <lacuna/closure/detail/void_faces.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/topology/shared/use_places.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

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

} // namespace

geometry::Triangulation triangulate_unrolled(const Outline& outline, double step, const RunContext& context)
{
    Eigen::AlignedBox2d box;
    for (const Vec2& place : outline.flat) box.extend(place);
    geometry::TriangulateOptions fine;
    fine.size = [size = std::max(step, box.diagonal().norm() / kFineChords)](const Vec2&) { return size; };
    return geometry::triangulate(outline.flat, outline.loops, fine, context);
}

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

} // namespace lacuna::closure
