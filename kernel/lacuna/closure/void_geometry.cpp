// SPDX-License-Identifier: MIT
#include <lacuna/closure/shared/void_geometry.h>

#include <lacuna/closure/detail/four_corners.h>
#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/detail/rim_quadrics.h>
#include <lacuna/closure/detail/round_patch.h>
#include <lacuna/closure/detail/touching_faces.h>
#include <lacuna/closure/detail/transfinite_fill.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/harmonic.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace lacuna::closure {

using namespace topology;

namespace {

// --- Algorithm 4: the Newell plane ------------------------------------------------------------------

struct NewellOutline {
    Outline outline;
    geometry::Plane plane;
    double bulge = 0; ///< largest height of the rim over the plane
};

NewellOutline newell_outline(const Model& model, const std::vector<Loop>& loops)
{
    NewellOutline result;
    std::vector<std::vector<Vec3>> rims;
    for (const Loop& loop : loops) rims.push_back(loop_places(model, loop.uses));
    result.plane = geometry::newell_plane(rims);
    for (std::size_t l = 0; l < loops.size(); ++l) {
        result.outline.add_loop(flat_places(result.plane, rims[l]), loop_points(model, loops[l].uses));
        for (const Vec3& p : rims[l])
            result.bulge = std::max(result.bulge, std::abs(geometry::height(result.plane, p)));
    }
    return result;
}

/// Heights of the triangulation's points over the Newell plane: equal to `rim` at the points of the outline,
/// which come first, and harmonic inside.
std::vector<double> harmonic_heights(const geometry::Triangulation& flat, const std::vector<double>& rim,
                                     const RunContext& context)
{
    std::vector<Vec3> points;
    for (const Vec2& p : flat.points) points.emplace_back(p.x(), p.y(), 0);
    geometry::HarmonicProblem problem;
    problem.points = points;
    problem.triangles = flat.triangles;
    problem.fixed_values.resize(static_cast<Eigen::Index>(rim.size()), 1);
    for (std::size_t i = 0; i < rim.size(); ++i) {
        problem.fixed.push_back(static_cast<Index>(i));
        problem.fixed_values(static_cast<Eigen::Index>(i), 0) = rim[i];
    }
    const Eigen::MatrixXd lifted = geometry::solve_harmonic(problem, context);
    return {lifted.data(), lifted.data() + lifted.rows()};
}

std::vector<double> rim_heights(const Model& model, const NewellOutline& newell)
{
    std::vector<double> heights;
    for (const Index p : newell.outline.model_point)
        heights.push_back(geometry::height(newell.plane, model.at(p)));
    return heights;
}

/// A face at heights over the Newell plane, by Algorithm 4.
VoidFilling filling_at(const Model& model, const NewellOutline& newell, const geometry::Triangulation& flat,
                       const std::vector<double>& heights)
{
    VoidFilling result = filling_of(model, newell.outline, flat, [&](std::size_t i) {
        return geometry::from_plane(newell.plane, flat.points[i], heights[i]);
    });
    result.algorithm = "Algorithm 4";
    return result;
}

/// The triangulated outline, with facets of about the given size.
geometry::Triangulation fine_facets(const Outline& outline, double facet_size, const RunContext& context)
{
    geometry::TriangulateOptions fine;
    fine.size = [=](const Vec2&) { return facet_size; };
    return geometry::triangulate(outline.flat, outline.loops, fine, context);
}

VoidFilling fill_on_newell_plane(const Model& model, const NewellOutline& newell, const RunContext& context)
{
    const Outline& outline = newell.outline;
    const geometry::Triangulation flat = geometry::triangulate(outline.flat, outline.loops, {}, context);
    std::vector<double> heights(flat.points.size(), 0);
    if (newell.bulge > model.tolerance && flat.points.size() > outline.flat.size()) {
        heights = harmonic_heights(flat, rim_heights(model, newell), context);
    }
    return filling_at(model, newell, flat, heights);
}

/// A void face on a sheet that its rim determines; empty if the sheet does not cover the face.
std::optional<VoidFilling> fill_on_sheet(const Model& model, const NewellOutline& newell,
                                         const QuadricSheet& sheet, const RunContext& context)
{
    const Outline& outline = newell.outline;
    Eigen::AlignedBox2d box;
    for (const Vec2& place : outline.flat) box.extend(place);
    const geometry::Triangulation flat = fine_facets(outline, box.diagonal().norm() / kFineChords, context);
    std::vector<double> heights(flat.points.size());
    for (std::size_t i = outline.flat.size(); i < heights.size(); ++i) {
        const std::optional<double> height = sheet.height(flat.points[i]);
        if (!height) return std::nullopt;
        heights[i] = *height;
    }
    return filling_at(model, newell, flat, heights);
}

/// A void face on the first sheet, of those that its rim determines, that covers the face.
std::optional<VoidFilling> fill_as_rim_tells(const Model& model, const std::vector<Loop>& loops,
                                             const NewellOutline& newell, const RunContext& context)
{
    for (const QuadricSheet& sheet : shapes_of_rim(model, loops, newell.plane).told)
        if (auto filling = fill_on_sheet(model, newell, sheet, context)) return filling;
    return std::nullopt;
}

/// Height of a surface over a place of a plane, at the intersection of the surface with the normal through
/// the place. If they do not intersect, the height of the surface's closest point. Empty if they intersect at
/// several heights.
std::optional<double> height_of(const geometry::FacetTree& shape, const geometry::Plane& plane,
                                const Vec2& place, double tolerance)
{
    const Vec3 foot = geometry::from_plane(plane, place, 0);
    std::optional<double> height;
    bool once = true;
    for (const double way : {1.0, -1.0}) {
        shape.all_along(foot, way * plane.normal, [&](const geometry::FacetTree::RayHit& hit) {
            if (height && std::abs(*height - way * hit.t) > tolerance) once = false;
            height = way * hit.t;
            return once;
        });
    }
    if (!once) return std::nullopt;
    return height ? *height : geometry::height(plane, shape.closest(foot).point);
}

/// A bent face between four corners. Empty if there are not exactly four convex corners, if the rim lies on a
/// quadric and the face would not be ruled, or if the face folds.
std::optional<VoidFilling> fill_between_corners(const Model& model, const std::vector<Loop>& loops,
                                                const Vec3& normal, bool on_quadric,
                                                const RunContext& context)
{
    if (loops.size() != 1) return std::nullopt;
    const auto sides = four_corners(model, loops.front());
    if (sides.empty()) return std::nullopt;
    // At a concave corner, such as a kink of a rough rim, the first facet would lie outside the rim.
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const std::vector<Vec3> before = use_places(model, sides[(i + 3) % 4]),
                                after = use_places(model, sides[i]);
        const Vec3 in = after[0] - before[before.size() - 2], out = after[1] - after[0];
        if (!(in.cross(out).dot(normal) > 0)) return std::nullopt;
    }
    if (on_quadric && !is_ruled(model, sides)) return std::nullopt;
    return unless_refused([&] { return fill_transfinite(model, sides, nullptr, context); }); // it may fold
}

/// The edges of two loops that cross, for messages.
std::array<Argument, 2> crossing_edges(const Model& model, const std::vector<Loop>& loops,
                                       const geometry::LoopCrossing& crossing)
{
    const auto edge_at = [&](std::size_t loop, std::size_t segment) -> Argument {
        for (const EdgeUse& use : loops[loop].uses) {
            const std::size_t segments = model[use.edge].points.size() - 1;
            if (segment < segments) return entity_of(model, use.edge);
            segment -= segments;
        }
        return "an edge";
    };
    return {edge_at(crossing.loop_a, crossing.segment_a), edge_at(crossing.loop_b, crossing.segment_b)};
}

} // namespace

std::vector<std::vector<EdgeUse>> logical_sides(const OpenVolume& volume, const Loop& loop)
{
    const auto on_rim = [&](EdgeId edge, Role end) {
        std::array<bool, 2> used{}; // whether faces of the end use the edge forward, and reversed
        for (const FaceUse& use : volume.model.uses_of_edge(edge))
            if (volume.role[use.face.index()] == end) used[use.reversed ? 1 : 0] = true;
        return used[0] != used[1];
    };
    const std::size_t n = loop.uses.size();
    const auto kind = [&](std::size_t i) {
        const EdgeId edge = loop.uses[i % n].edge;
        return on_rim(edge, Role::source) ? 0 : on_rim(edge, Role::target) ? 2 : 1;
    };
    std::size_t start = 0;
    while (start < n && !(kind(start) == 0 && kind(start + n - 1) != 0)) ++start;
    if (start == n) return {};
    std::vector<std::vector<EdgeUse>> sides;
    std::vector<int> kinds;
    for (std::size_t i = 0; i < n; ++i) {
        const int k = kind(start + i);
        if (kinds.empty() || kinds.back() != k) {
            kinds.push_back(k);
            sides.emplace_back();
        }
        sides.back().push_back(loop.uses[(start + i) % n]);
    }
    if (kinds != std::vector<int>{0, 1, 2, 1}) return {};
    return sides;
}

namespace {

VoidFilling fill_loops(const OpenVolume& volume, const std::vector<Loop>& loops, const Follower* follower,
                       bool rim_tells, const Subject& face, const RunContext& context)
{
    check_cancelled(context);
    const Model& model = volume.model;
    const NewellOutline newell = newell_outline(model, loops);
    const auto crossing = geometry::find_crossing(newell.outline.flat, newell.outline.loops);
    const bool flat = newell.bulge <= model.tolerance;
    const auto sides = loops.size() == 1 ? logical_sides(volume, loops.front())
                                         : std::vector<std::vector<EdgeUse>>{};
    // A wall without known sides that runs more than half round its axis cannot be flattened.
    if (!flat && loops.size() == 1 &&
        ((crossing && sides.empty()) || !is_ruled_between_alike(model, loops.front())))
        if (auto patch = fill_round_patch(model, loops.front(), context)) return std::move(*patch);
    const bool has_sides = !sides.empty() && (!flat || crossing);
    const bool bent = !flat && !has_sides;
    auto told = bent && !crossing && rim_tells ? fill_as_rim_tells(model, loops, newell, context)
                                               : std::nullopt;
    VoidFilling result;
    if (has_sides) {
        auto blended = attempt<InvalidInput>(
            [&] { return fill_transfinite(model, sides, follower, context); });
        if (!blended) {
            throw NotClosed(Message("closure.face_folds",
                                    "{}{}, with {}, folds if it is blended between its sides", face.words,
                                    face.entity, entity_of(model, sides.front().front().edge))
                                .attempt(*blended.why));
        }
        result = std::move(*blended);
    } else if (auto patch = flat ? std::nullopt
                                 : fill_between_corners(model, loops, newell.plane.normal, told.has_value(),
                                                        context)) {
        result = std::move(*patch);
    } else if (told) {
        result = std::move(*told);
    } else if (!crossing) {
        result = fill_on_newell_plane(model, newell, context);
    } else {
        const auto [a, b] = crossing_edges(model, loops, *crossing);
        throw NotClosed(Message("closure.outline_crosses",
                                "{}{} cannot be flattened: {} and {} cross in its plane", face.words,
                                face.entity, a, b)
                            .remedy("give a face for it, or split it by one more wall"));
    }
    result.loops = loops;
    return result;
}

} // namespace

VoidFilling fill(const OpenVolume& volume, const std::vector<Loop>& loops, const Follower* follower,
                 const Subject& face, const RunContext& context)
{
    return fill_loops(volume, loops, follower, true, face, context);
}

VoidFilling fill_cut(const OpenVolume& volume, const std::vector<Loop>& loops, const Subject& face,
                     const RunContext& context)
{
    return fill_loops(volume, loops, nullptr, false, face, context);
}

VoidFilling fill_as(const OpenVolume& volume, const std::vector<Loop>& loops,
                    const geometry::FacetTree& shape, double facet_size, const Subject& face,
                    const RunContext& context)
{
    const Model& model = volume.model;
    const NewellOutline newell = newell_outline(model, loops);
    const Outline& outline = newell.outline;
    if (const auto crossing = geometry::find_crossing(outline.flat, outline.loops)) {
        const auto [a, b] = crossing_edges(model, loops, *crossing);
        throw NotClosed(Message("closure.outline_crosses",
                                "{}{} cannot be projected to a plane, because {} and {} cross there, so it "
                                "cannot be parallel to the given end",
                                face.words, face.entity, a, b)
                            .remedy("use cap = \"flat\""));
    }
    const geometry::Triangulation flat = fine_facets(outline, facet_size, context);
    std::vector<double> heights;
    for (const Vec2& place : flat.points) {
        check_cancelled(context);
        const auto height = height_of(shape, newell.plane, place, model.tolerance);
        if (!height) {
            throw NotClosed(Message("closure.cap_folds",
                                    "{}{} cannot be parallel to the given end, which folds over the plane of "
                                    "the walls' rim",
                                    face.words, face.entity)
                                .remedy("use cap = \"flat\", or give the face"));
        }
        heights.push_back(*height);
    }
    std::vector<double> left = rim_heights(model, newell);
    for (std::size_t i = 0; i < left.size(); ++i) left[i] -= heights[i];
    const std::vector<double> moved = harmonic_heights(flat, left, context);
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] += moved[i];
    VoidFilling result = filling_at(model, newell, flat, heights);
    result.loops = loops;
    result.geometry = Geometry::parallel;
    return result;
}

EdgeId add_void_edge_through(ModelBuilder& builder, VertexId from, VertexId to,
                             const std::vector<Vec3>& between)
{
    std::vector<Index> points(between.size() + 2);
    std::iota(points.begin() + 1, points.end(), static_cast<Index>(builder.points.size()));
    points.front() = builder[from].point;
    points.back() = builder[to].point;
    builder.points.insert(builder.points.end(), between.begin(), between.end());
    return builder.add_void_edge(from, to, std::move(points));
}

EdgeId add_void_edge_through(Model& model, VertexId from, VertexId to, const std::vector<Vec3>& between)
{
    ModelBuilder builder(std::move(model));
    const EdgeId edge = add_void_edge_through(builder, from, to, between);
    model = std::move(builder).finish();
    return edge;
}

std::vector<FaceId> add_void_faces(OpenVolume& volume, std::vector<VoidFilling> fillings, Role role)
{
    std::vector<FaceId> ids;
    ModelBuilder model(std::move(volume.model));
    const auto given = static_cast<Index>(model.points.size());
    for (VoidFilling& filling : fillings) {
        const Index shift = static_cast<Index>(model.points.size()) - given;
        for (Triangle& t : filling.triangles)
            for (Index& corner : t)
                if (corner >= given) corner += shift;
        const FaceId id = ids.emplace_back(model.add_void_face(filling.geometry));
        model[id].name = std::move(filling.name);
        model[id].triangles = std::move(filling.triangles);
        model[id].loops = std::move(filling.loops);
        model.points.insert(model.points.end(), filling.points.begin(), filling.points.end());
    }
    volume.model = std::move(model).finish();
    volume.role.resize(volume.role.size() + fillings.size(), role);
    return ids;
}

FaceId add_void_face(OpenVolume& volume, VoidFilling filling, Role role)
{
    std::vector<VoidFilling> one;
    one.push_back(std::move(filling));
    return add_void_faces(volume, std::move(one), role).front();
}

} // namespace lacuna::closure
