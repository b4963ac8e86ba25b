// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/divide.h>

#include <lacuna/closure/detail/midpoint.h>
#include <lacuna/closure/detail/pieces.h>
#include <lacuna/closure/detail/turning_heights.h>
#include <lacuna/closure/detail/void_sweeps.h>
#include <lacuna/closure/shared/branches.h>
#include <lacuna/closure/shared/cut.h>
#include <lacuna/closure/shared/piece_ends.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/geometry/shared/spread.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

namespace lacuna::closure {

using namespace topology;

bool find_ends(StepPiece& piece, const CanSweep& can_sweep, const RunContext& context)
{
    std::vector<StepPiece> one;
    one.push_back(piece);
    one = read_ends(std::move(one), context).pieces;
    if (walls_run_between_ends(one.front().volume) && can_sweep(one.front().volume)) {
        piece = std::move(one.front());
        return true;
    }
    const auto sweeps = unless_refused([&] { return best_sweeps(piece.volume.model, context); });
    if (!sweeps) return false;
    for (const RoleCandidate& sweep : *sweeps) {
        OpenVolume volume = piece.volume;
        set_ends(volume, sweep.roles);
        if (has_pieces(volume, context) || !can_sweep(volume)) continue;
        piece.volume = std::move(volume);
        return true;
    }
    return false;
}

std::vector<StepPiece> divided_at_middle(const OpenVolume& volume, std::size_t most,
                                         const CanSweep& can_sweep, const RunContext& context)
{
    // midpoint_blocks() refuses an edge that is too short to be split.
    auto blocks = unless_refused([&] { return midpoint_blocks(volume, most, context); });
    std::vector<StepPiece> made;
    if (!blocks) return made;
    for (OpenVolume& block : *blocks) {
        made.push_back({std::move(block)});
        if (!find_ends(made.back(), can_sweep, context)) return {};
    }
    return made;
}

namespace {

/// Find ends of each part, or divide the part at its middle. Empty if both fail for a part, or if there would
/// be more than `most` pieces.
std::vector<StepPiece> finished(std::vector<StepPiece> parts, std::size_t most, const CanSweep& can_sweep,
                                const RunContext& context)
{
    std::vector<StepPiece> made;
    for (StepPiece& part : parts) {
        std::vector<StepPiece> own{std::move(part)};
        if (!find_ends(own.front(), can_sweep, context))
            own = divided_at_middle(own.front().volume, most, can_sweep, context);
        if (own.empty()) return {};
        std::ranges::move(own, std::back_inserter(made));
    }
    if (made.size() > most) return {};
    return made;
}

/// Cut a volume by planes, one after the other, and finish its parts (`finished()`). Empty also if a plane
/// passes closely beside an edge, or does not cut a part in two.
std::vector<StepPiece> divided_by_planes(const OpenVolume& volume, std::span<const geometry::Plane> planes,
                                         std::size_t most, const CanSweep& can_sweep,
                                         const RunContext& context)
{
    auto parts = unless_refused([&] {
        std::vector<StepPiece> made{{volume}};
        for (const geometry::Plane& plane : planes)
            made = cut_each(std::move(made), plane, [&](const OpenVolume& part) {
                return cut_at_edges(part, plane, {}, 0, context);
            });
        return made;
    });
    if (!parts || parts->size() < 2) return {};
    return finished(std::move(*parts), most, can_sweep, context);
}

} // namespace

std::vector<StepPiece> divided_at_flat_edge(const OpenVolume& volume, std::size_t most,
                                            const CanSweep& can_sweep, const RunContext& context)
{
    const Model& model = volume.model;
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
        const auto plane = uses.size() == 2 ? plane_of(model, uses[0].face) : std::nullopt;
        if (!plane || !lies_in_plane(model, uses[1].face, *plane)) continue;
        const Vec3 from = model.at(model[model[EdgeId(e)].from].point),
                   to = model.at(model[model[EdgeId(e)].to].point);
        const geometry::Plane across = geometry::plane_across(from,
                                                              plane->normal.cross(to - from).normalized());
        // The cut is refused if the edge is bent or the volume stays in one piece.
        auto parts = unless_refused([&] { return cut_at_edges(volume, across, {EdgeId(e)}, 0, context); });
        if (!parts || parts->size() < 2) continue;
        std::vector<StepPiece> made = finished(std::move(*parts), most, can_sweep, context);
        if (!made.empty()) return made;
    }
    return {};
}

namespace {

/// Largest number of edges at a vertex through which a volume is cut. The parts of a pyramid with nine sides
/// could not be meshed together.
constexpr std::size_t kMostAtVertex = 6;

/// Planes that hold two edges which meet at a vertex with four to six edges and bound no common face. Planes
/// that hold more edges come first.
std::vector<geometry::Plane> planes_at_vertices(const Model& model)
{
    std::vector<std::vector<EdgeId>> at(model.vertices.size());
    for (std::size_t e = 0; e < model.edges.size(); ++e)
        for (const VertexId vertex : {model.edges[e].from, model.edges[e].to})
            if (model.edges[e].from != model.edges[e].to) at[vertex.index()].emplace_back(e);
    const auto holds = [&](const geometry::Plane& plane, const Edge& edge) {
        return std::ranges::all_of(edge.points, [&](Index p) {
            return std::abs(geometry::height(plane, model.at(p))) <= model.tolerance;
        });
    };
    const auto share_face = [&](EdgeId a, EdgeId b) {
        const std::span<const FaceUse> uses = model.uses_of_edge(a);
        return std::ranges::any_of(model.uses_of_edge(b), [&](const FaceUse& use) {
            return std::ranges::find(uses, use.face, &FaceUse::face) != uses.end();
        });
    };
    std::vector<std::pair<std::ptrdiff_t, geometry::Plane>> found;
    for (const std::vector<EdgeId>& edges : at) {
        if (edges.size() < 4 || edges.size() > kMostAtVertex) continue;
        for (std::size_t a = 0; a < edges.size(); ++a)
            for (std::size_t b = 0; b < a; ++b) {
                if (share_face(edges[a], edges[b])) continue;
                std::vector<Vec3> places = places_at(model, model[edges[a]].points);
                std::ranges::copy(places_at(model, model[edges[b]].points), std::back_inserter(places));
                const geometry::Spread spread = geometry::spread_of(places);
                const geometry::Plane plane = geometry::plane_across(spread.centre, spread.axis.col(0));
                if (!holds(plane, model[edges[a]]) || !holds(plane, model[edges[b]])) continue;
                found.emplace_back(
                    std::ranges::count_if(model.edges, [&](const Edge& edge) { return holds(plane, edge); }),
                    plane);
            }
    }
    std::ranges::stable_sort(found, std::greater{}, &std::pair<std::ptrdiff_t, geometry::Plane>::first);
    std::vector<geometry::Plane> planes;
    for (const auto& [count, plane] : found) planes.push_back(plane);
    return planes;
}

} // namespace

std::vector<StepPiece> divided_at_vertices(const OpenVolume& volume, std::size_t most,
                                           const CanSweep& can_sweep, const RunContext& context)
{
    for (const geometry::Plane& plane : planes_at_vertices(volume.model)) {
        check_cancelled(context);
        auto parts = unless_refused([&] { return cut_at_edges(volume, plane, {}, 0, context); });
        if (!parts || parts->size() < 2) continue;
        std::vector<StepPiece> made;
        for (std::size_t left = parts->size(); StepPiece & part : *parts) {
            if (made.size() + --left >= most) return {};
            const std::size_t here = most - made.size() - left;
            std::vector<StepPiece> own{std::move(part)};
            if (!find_ends(own.front(), can_sweep, context)) {
                const OpenVolume whole = std::move(own.front().volume);
                own = divided_at_vertices(whole, here, can_sweep, context);
                if (own.empty()) own = divided_at_middle(whole, here, can_sweep, context);
            }
            if (own.empty()) return {};
            std::ranges::move(own, std::back_inserter(made));
        }
        return made;
    }
    return {};
}

std::vector<Vec3> axes_of(const OpenVolume& volume, bool both)
{
    struct Axis {
        Vec3 way;
        double ahead = 0, behind = 0; ///< area of flat faces [model length²]
    };
    std::vector<Axis> axes;
    for (const FaceId face : all_faces(volume.model)) {
        if (!plane_of(volume.model, face)) continue;
        const Vec3 area = face_area_vector(volume.model, face);
        const Vec3 way = area.stableNormalized();
        const auto known = std::ranges::find_if(
            axes, [&](const Axis& axis) { return std::abs(axis.way.dot(way)) > 1 - kFlatShare; });
        Axis& axis = known != axes.end() ? *known : axes.emplace_back(way);
        (axis.way.dot(way) > 0 ? axis.ahead : axis.behind) += area.norm();
    }
    if (both) std::erase_if(axes, [](const Axis& axis) { return !(axis.ahead > 0 && axis.behind > 0); });
    std::ranges::stable_sort(axes, std::greater{}, [](const Axis& axis) { return axis.ahead + axis.behind; });
    std::vector<Vec3> ways;
    for (const Axis& axis : axes) ways.push_back(axis.way);
    return ways;
}

std::vector<StepPiece> divided_where_turning(const OpenVolume& volume, std::size_t most,
                                             const CanSweep& can_sweep, const RunContext& context)
{
    std::vector<Vec3> axes = axes_of(volume, true);
    if (axes.size() > kMostTrials) axes.resize(kMostTrials);
    for (const Vec3& axis : axes) {
        check_cancelled(context);
        std::vector<geometry::Plane> planes;
        for (const double height : turning_heights(volume.model, axis))
            planes.push_back(geometry::plane_across(height * axis, axis));
        std::vector<StepPiece> made = divided_by_planes(volume, planes, most, can_sweep, context);
        if (!made.empty()) return made;
    }
    return {};
}

namespace {

/// Centres of the spheres and apexes of the cones of a skin, without repetition. If there are none, and the
/// skin is connected: the mean of the vertices, such as the centre between the poles of an ellipsoid.
std::vector<Vec3> centres_of(const Model& model)
{
    std::vector<Vec3> centres;
    const auto add = [&](const Vec3& centre) {
        if (std::ranges::none_of(centres, [&](const Vec3& own) {
                return (own - centre).norm() <= kSamePlace * model.diagonal;
            }))
            centres.push_back(centre);
    };
    for (const FaceId face : all_faces(model)) {
        if (const auto round = round_shape(model, face); round && round->is_sphere())
            add(round->centre);
        else if (const auto cone = cone_shape(model, face))
            add(cone->apex);
    }
    if (!centres.empty() || model.vertices.empty() || connected_parts(model, all_faces(model)).size() > 1)
        return centres;
    Vec3 sum = Vec3::Zero();
    for (const Vertex& vertex : model.vertices) sum += model.at(vertex.point);
    return {sum / static_cast<double>(model.vertices.size())};
}

/// Three perpendicular planes through a centre. Their normals are preferably normals of flat faces, then
/// directions to other centres. If these do not suffice, a normal points towards a vertex or a point of an
/// edge. Another plane then passes through that point; if it passed closely beside an edge, the cut would be
/// refused.
std::array<geometry::Plane, 3> planes_at(const Vec3& centre, const std::vector<Vec3>& centres,
                                         const OpenVolume& volume)
{
    const Model& model = volume.model;
    std::vector<Vec3> axes = axes_of(volume, false);
    for (const Vec3& other : centres)
        if (other != centre) axes.push_back((other - centre).normalized());
    std::vector<Vec3> out; // vectors from the centre to vertices, then to points of edges
    for (const Vertex& vertex : model.vertices) out.push_back(model.at(vertex.point) - centre);
    for (const Edge& edge : model.edges)
        for (const Index p : edge.points) out.push_back(model.at(p) - centre);
    const auto way_beside = [&](const Vec3& axis) {
        for (const Vec3& way : out) {
            const Vec3 beside = way - axis.dot(way) * axis;
            if (beside.norm() > kVisible * model.diagonal) return Vec3(beside.normalized());
        }
        return axis.isZero() ? Vec3(Vec3::UnitZ()) : Vec3(axis.unitOrthogonal());
    };
    const Vec3 first = axes.empty() ? way_beside(Vec3::Zero()) : axes.front();
    const auto across = std::ranges::find_if(
        axes, [&](const Vec3& axis) { return std::abs(axis.dot(first)) < kParallel; });
    const Vec3 second = across == axes.end() ? way_beside(first)
                                             : Vec3((*across - first.dot(*across) * first).normalized());
    return {geometry::plane_across(centre, first), geometry::plane_across(centre, second),
            geometry::plane_across(centre, first.cross(second))};
}

} // namespace

std::vector<StepPiece> divided_at_centre(const OpenVolume& volume, std::size_t most,
                                         const CanSweep& can_sweep, const RunContext& context)
{
    const std::vector<Vec3> centres = centres_of(volume.model);
    for (const Vec3& centre : centres) {
        check_cancelled(context);
        std::vector<StepPiece> made = divided_by_planes(volume, planes_at(centre, centres, volume), most,
                                                        can_sweep, context);
        if (!made.empty()) return made;
    }
    return {};
}

namespace {

/// Whether every edge of a skin is a circle around an axis or a seam, and no face meets the axis.
bool is_ring_around(const Model& model, const Vec3& centre, const Vec3& axis)
{
    const auto height_and_radius = [&](Index p) {
        const Vec3 out = model.at(p) - centre;
        return Vec2(out.dot(axis), out.cross(axis).norm());
    };
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
        if (uses.size() == 2 && uses[0].face == uses[1].face) continue;
        const std::vector<Index>& points = model.edges[e].points;
        if (std::ranges::any_of(points, [&](Index p) {
                return (height_and_radius(p) - height_and_radius(points.front())).norm() > model.tolerance;
            }))
            return false;
    }
    const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
    const auto meets_axis = [&](const Triangle& t) {
        std::vector<Vec2> flat;
        for (const Index p : t)
            flat.emplace_back((model.at(p) - centre).dot(u), (model.at(p) - centre).dot(v));
        return geometry::lies_inside(flat, Vec2::Zero());
    };
    return std::ranges::none_of(all_faces(model), [&](FaceId face) {
        return std::ranges::any_of(model[face].triangles, meets_axis);
    });
}

} // namespace

std::vector<StepPiece> divided_through_axis(const OpenVolume& volume, const CanSweep& can_sweep,
                                            const RunContext& context)
{
    const Model& model = volume.model;
    for (const FaceId face : all_faces(model)) {
        const auto round = round_shape(model, face);
        if (!round || !round->axis || !is_ring_around(model, round->centre, *round->axis)) continue;
        const geometry::Plane plane = geometry::plane_across(round->centre, round->axis->unitOrthogonal());
        auto halves = unless_refused([&] { return cut_at_edges(volume, plane, {}, 0, context); });
        if (!halves || halves->size() != 2) return {};
        const bool suit = std::ranges::all_of(
            *halves, [&](StepPiece& half) { return find_ends(half, can_sweep, context); });
        return suit ? std::move(*halves) : std::vector<StepPiece>{};
    }
    return {};
}

} // namespace lacuna::closure
