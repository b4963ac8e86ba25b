// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/round_walls.h>

#include <lacuna/closure/detail/axis_rims.h>
#include <lacuna/closure/detail/guesses.h>
#include <lacuna/closure/detail/touching_faces.h>
#include <lacuna/closure/detail/transfinite_fill.h>
#include <lacuna/closure/detail/unrolled_wall.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/closure/detail/void_faces.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>
#include <span>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

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

} // namespace

void add_wall(FlatFilling& filling, const std::vector<std::vector<EdgeUse>>& sides, const RunContext& context)
{
    VoidFilling wall = fill_transfinite(filling.volume.model, sides, nullptr, context);
    Loop& loop = wall.loops.emplace_back();
    for (const std::vector<EdgeUse>& side : sides)
        loop.uses.insert(loop.uses.end(), side.begin(), side.end());
    filling.closure.void_faces.push_back(add_void_face(filling.volume, std::move(wall), Role::wall));
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
