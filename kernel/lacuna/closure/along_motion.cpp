// SPDX-License-Identifier: MIT
#include <lacuna/closure/shared/along.h>

#include <lacuna/closure/detail/along_normals.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/segment.h>
#include <lacuna/geometry/shared/sweep_path.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/split_edge.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Number of intervals at which a function of the user (path, twist or scale) is sampled. With this number, a
/// path of five turns is reproduced to 1e-6 of the turns' radius.
constexpr int kSteps = 1024;

// --- twist and scale ---------------------------------------------------------------------------------------

/// A profile as a function of the height. A profile of the user is sampled at even heights and interpolated
/// by cubics.
std::function<double(double)> sampled(const Along::Profile& profile, double first, const char* name)
{
    if (!profile.at) {
        const double last = profile.last;
        return [first, last](double height) { return (1 - height) * first + height * last; };
    }
    std::vector<double> values;
    for (int k = 0; k <= kSteps; ++k) {
        const double height = static_cast<double>(k) / kSteps;
        values.push_back(profile.at(height));
        if (!std::isfinite(values.back()))
            throw InvalidInput(Message("closure.along_profile",
                                       "along: '{}' is not a finite number at the height {}", name,
                                       found(height))
                                   .remedy("let the function return a finite number at every height from 0 "
                                           "to 1"));
    }
    if (std::abs(values.front() - first) > kSamePlace)
        throw InvalidInput(Message("closure.along_profile",
                                   "along: '{}' is {} at the height 0, where the source stays as it is", name,
                                   found(values.front()))
                               .remedy("let the function return {} there", needed(first)));
    return [values = std::move(values)](double height) {
        const double at = std::clamp(height, 0.0, 1.0) * kSteps;
        const auto i = std::min(static_cast<std::size_t>(at), values.size() - 2);
        const auto slope = [&](std::size_t k) {
            const std::size_t low = k > 0 ? k - 1 : 0, high = std::min(k + 1, values.size() - 1);
            return (values[high] - values[low]) / static_cast<double>(high - low);
        };
        const double f = at - static_cast<double>(i), step = values[i + 1] - values[i];
        return values[i] + f * step + f * (1 - f) * ((1 - f) * (slope(i) - step) - f * (slope(i + 1) - step));
    };
}

geometry::Distortion distortion_of(const Along& along)
{
    geometry::Distortion by;
    if (along.twist) {
        const auto degrees = sampled(*along.twist, 0, "twist");
        by.twist = [degrees](double height) { return degrees(height) * kDegree; };
        for (int k = 0; k < kSteps; ++k)
            by.most_twist += std::abs(by.twist((k + 1.0) / kSteps) - by.twist(1.0 * k / kSteps));
        by.even = by.even && !along.twist->at;
    }
    if (along.scale) {
        by.scale = sampled(*along.scale, 1, "scale");
        by.even = by.even && !along.scale->at;
        for (int k = 0; k <= kSteps; ++k) {
            const double height = static_cast<double>(k) / kSteps;
            if (by.scale(height) > 0) continue;
            throw InvalidInput(Message("closure.along_scale", "along: 'scale' is {:.3g} at the height {:.3g}",
                                       found(by.scale(height)), height)
                                   .remedy("keep it above {}", needed(0)));
        }
    }
    return by;
}

// --- paths -------------------------------------------------------------------------------------------------

/// Points along an edge; if the edge has an exact curve, they lie on the curve.
std::vector<Vec3> line_of(const Model& model, const Edge& edge)
{
    std::vector<Vec3> points;
    if (!edge.curve) {
        for (const Index p : edge.points) points.push_back(model.at(p));
        return points;
    }
    std::vector<double> params;
    for (std::size_t i = 0; i + 1 < edge.params.size(); ++i)
        for (int k = 0; k < kChords; ++k)
            params.push_back(edge.params[i] + (edge.params[i + 1] - edge.params[i]) * k / kChords);
    params.push_back(edge.params.back());
    points.resize(params.size());
    edge.curve->evaluate(params, points);
    return points;
}

/// The parts of a line between corners: places where the line turns by the crease angle or more.
std::vector<geometry::PathPart> cut_at_corners(const std::vector<Vec3>& line)
{
    std::vector<geometry::PathPart> parts{{line.front()}};
    for (std::size_t i = 1; i < line.size(); ++i) {
        parts.back().push_back(line[i]);
        if (i + 1 == line.size()) break;
        if (geometry::angle_between(line[i] - line[i - 1], line[i + 1] - line[i]) >= kCreaseAngle * kDegree)
            parts.push_back({line[i]});
    }
    return parts;
}

/// The parts of a path along edges. Each edge must start where the previous edge ends. Of the two ends of the
/// path, the one nearer to the source is its start.
std::vector<geometry::PathPart> path_of_edges(const Model& model, const std::vector<int>& tags,
                                              const Vec3& source)
{
    std::vector<std::vector<Vec3>> lines;
    for (const int tag : tags) {
        const auto edge = std::ranges::find(model.edges, tag, &Edge::tag);
        if (edge == model.edges.end())
            throw InvalidInput(
                Message("closure.along_edge", "along: the model has no {}", NamedEntity{"edge", tag})
                    .remedy("volume:free_edges() and volume:tree() list edges"));
        lines.push_back(line_of(model, *edge));
    }
    const auto distance = [](const Vec3& a, const Vec3& b) { return (a - b).norm(); };
    if (lines.size() > 1) {
        const auto& next = lines[1];
        const auto gap = [&](const Vec3& p) {
            return std::min(distance(p, next.front()), distance(p, next.back()));
        };
        if (gap(lines[0].front()) < gap(lines[0].back())) std::ranges::reverse(lines[0]);
    }
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const Vec3 end = lines[i - 1].back();
        if (distance(end, lines[i].back()) < distance(end, lines[i].front())) std::ranges::reverse(lines[i]);
        if (distance(end, lines[i].front()) <= model.tolerance) continue;
        throw InvalidInput(Message("closure.along_edge", "along: {} does not start where {} ends",
                                   NamedEntity{"edge", tags[i]}, NamedEntity{"edge", tags[i - 1]})
                               .remedy("list the edges of the path in order"));
    }
    if (distance(source, lines.back().back()) < distance(source, lines.front().front())) {
        std::ranges::reverse(lines);
        for (std::vector<Vec3>& line : lines) std::ranges::reverse(line);
    }
    std::vector<geometry::PathPart> parts;
    for (const std::vector<Vec3>& line : lines)
        for (geometry::PathPart& part : cut_at_corners(line)) parts.push_back(std::move(part));
    return parts;
}

std::vector<geometry::PathPart> path_of_function(const std::function<Vec3(double)>& curve)
{
    geometry::PathPart part;
    for (int k = 0; k <= kSteps; ++k) {
        part.push_back(curve(static_cast<double>(k) / kSteps));
        if (!part.back().allFinite())
            throw InvalidInput(Message("closure.along_path", "along: the path has no finite point at {}",
                                       found(static_cast<double>(k) / kSteps))
                                   .remedy("let the function return x, y, z for every t from 0 to 1"));
    }
    const auto parts = cut_at_corners(part);
    if (parts.size() > 1)
        throw InvalidInput(Message("closure.along_path",
                                   "along: the path has a corner at {}; a path given as a function must be "
                                   "smooth",
                                   found(place_with_digits(parts.front().back(), 4)))
                               .remedy("give a path with corners as an array of points"));
    return parts;
}

std::vector<geometry::PathPart> parts_of(const Along::Path& path, const Model& model, const Vec3& source)
{
    if (path.curve) return path_of_function(path.curve);
    if (!path.edges.empty()) return path_of_edges(model, path.edges, source);
    if (path.points.size() < 2)
        throw InvalidInput(Message("closure.along_path", "along: a path needs at least {} points, but has {}",
                                   needed(2), found(path.points.size()))
                               .remedy("give path = {{ {{x, y, z}}, {{x, y, z}}, … }}"));
    std::vector<geometry::PathPart> parts;
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i)
        parts.push_back({path.points[i], path.points[i + 1]});
    return parts;
}

// --- axes --------------------------------------------------------------------------------------------------

/// Whether a point lies on an axis.
bool is_on(const Model& model, Index point, const Vec3& origin, const Vec3& axis)
{
    return (model.at(point) - origin).cross(axis).norm() <= model.tolerance;
}

/// An edge of a source that lies on an axis.
std::optional<EdgeId> edge_on_axis(const Model& model, const Vec3& point, const Vec3& axis)
{
    for (std::size_t e = 0; e < model.edges.size(); ++e)
        if (std::ranges::all_of(model.edges[e].points,
                                [&](Index at) { return is_on(model, at, point, axis); }))
            return EdgeId(e);
    return std::nullopt;
}

/// Refuse a source that touches its axis: cells there would have no width.
/// @param wedges  whether the volume can be swept with wedges; if so, the remedy says so.
void check_axis(const Model& model, const Vec3& point, const Vec3& axis, bool wedges = false)
{
    if (const auto edge = edge_on_axis(model, point, axis))
        throw InvalidInput(
            Message("closure.along_axis", "{} lies on the axis, where hexahedra would have no width",
                    entity_of(model, *edge))
                .remedy(
                    "{}leave a strip next to the axis out of the source, and fill the core with a volume of "
                    "its own",
                    wedges ? "sweep the volume by itself with wedges = true, or " : ""));
    for (std::size_t v = 0; v < model.vertices.size(); ++v) {
        if (!is_on(model, model.vertices[v].point, point, axis)) continue;
        throw InvalidInput(Message("closure.along_axis",
                                   "{} lies on the axis, and cells there would have no width",
                                   entity_of(model, VertexId(v)))
                               .remedy("leave a strip along the axis out of the source, and fill the core "
                                       "with a volume of its own"));
    }
}

/// Whether edges of a source lie on its axis of rotation.
/// @throw InvalidInput "closure.along_axis"  the source touches the axis, but not along an edge.
bool has_edges_on_axis(const Model& model, const Vec3& point, const Vec3& axis)
{
    if (!edge_on_axis(model, point, axis)) {
        check_axis(model, point, axis);
        return false;
    }
    std::vector<char> ends(model.points.size(), 0);
    const auto on = [&](Index at) { return is_on(model, at, point, axis); };
    for (const Edge& edge : model.edges)
        if (std::ranges::all_of(edge.points, on))
            for (const Index at : edge.points) ends[index(at)] = 1;
    for (std::size_t v = 0; v < model.vertices.size(); ++v) {
        const Index at = model.vertices[v].point;
        if (!on(at) || ends[index(at)] != 0) continue;
        throw InvalidInput(
            Message("closure.along_axis",
                    "the source also touches the axis at {}, away from its edges on the axis, so cells "
                    "there would have no width",
                    entity_of(model, VertexId(v)))
                .remedy("cut the region around this vertex out of the source"));
    }
    return true;
}

/// Unit direction in which a place moves in a rotation about an axis; the axis direction for a place on the
/// axis.
Vec3 start_of_turn(const Vec3& point, const Vec3& axis, const Vec3& place)
{
    const Vec3 way = axis.cross(place - point);
    return way.norm() > 0 ? Vec3(way.normalized()) : axis;
}

/// Visitor of `Along::course`: makes the motion for each alternative of the variant.
struct MotionMaker {
    const Model& model; ///< the model that contains the edges of `Along::Path`
    SweptSource& swept;
    geometry::Distortion by;
    Vec3 centre;
    const RunContext& context;

    geometry::Motion operator()(const Along::Vector& along) const
    {
        const Vec3 way = unit(along.way, "vector");
        return distorted(geometry::translation(along.way), centre, way, by);
    }
    geometry::Motion operator()(const Along::Axis& along)
    {
        const Vec3 axis = unit(along.direction, "axis");
        const double angle = along.angle * kDegree;
        if (!(std::abs(along.angle) > 0) || std::abs(along.angle) > kDegreesPerTurn)
            throw InvalidInput(
                "closure.along_angle",
                "along: 'angle' is {} degrees; it must be other than 0 and at most {} either way",
                found(along.angle), needed(kDegreesPerTurn));
        if (by.twist || by.scale)
            check_axis(swept.source.model, along.point, axis);
        else if (has_edges_on_axis(swept.source.model, along.point, axis))
            swept.on_axis = Along::Axis{along.point, axis, along.angle};
        swept.full_turn = std::abs(along.angle) == kDegreesPerTurn;
        if (swept.full_turn && (by.twist || by.scale))
            throw InvalidInput(Message("closure.along_full_turn",
                                       "along: a full turn must end on its source, but 'twist' or 'scale' "
                                       "changes the end")
                                   .remedy("leave them out, or use a smaller angle"));
        geometry::Motion motion = geometry::screw(along.point, axis, angle, 0);
        if (swept.full_turn) motion.levels = {0, 0.5, 1}; // the two halves are swept separately
        return distorted(std::move(motion), centre, start_of_turn(along.point, axis, centre), by);
    }
    geometry::Motion operator()(const Along::Helix& along) const
    {
        const Vec3 axis = unit(along.direction, "helix");
        if (along.turns == 0)
            throw InvalidInput("closure.along_turns", "along: a helix needs 'turns' other than {}", found(0));
        check_axis(swept.source.model, along.point, axis);
        // A negative turn means a left-handed helix: the pitch changes sign too, so that the path still
        // advances along the axis.
        const double pitch = along.turns < 0 ? -along.pitch : along.pitch;
        return distorted(geometry::screw(along.point, axis, along.turns * kFullTurn, pitch), centre,
                         start_of_turn(along.point, axis, centre), by);
    }
    geometry::Motion operator()(const Along::Path& along) const
    {
        const std::vector<geometry::PathPart> parts = parts_of(along, model, centre);
        const auto frame = along.fixed ? geometry::SectionFrame::fixed : geometry::SectionFrame::minimal;
        geometry::Motion motion = geometry::motion_along_path(parts, frame);
        return distorted(std::move(motion), parts.front().front(), geometry::start_of_path(parts), by);
    }
    geometry::Motion operator()(const Along::Normals& along) const
    {
        refuse_distortion("normals");
        return motion_along_normals(swept.source, along, context);
    }
    geometry::Motion operator()(const Along::ToFace& along) const
    {
        refuse_distortion("to");
        return motion_to_face(swept.source, along, context);
    }
    void refuse_distortion(const char* name) const
    {
        if (by.twist || by.scale)
            throw InvalidInput(
                Message("closure.along_distorted",
                        "along: '{}' moves each point of the source separately, so 'twist' and "
                        "'scale' do not apply",
                        name)
                    .remedy("leave out 'twist' and 'scale'"));
    }
};

/// Divide closed edges of the rim in two. The walls of the two halves then meet in two edges along the path,
/// which determine which points of the rims of source and target correspond. The seam of a single wall would
/// not determine that.
void divide_closed_edges(Model& model)
{
    constexpr double kMiddle = 0.5;
    for (const EdgeId edge : rim_edges(model, all_faces(model)))
        if (model[edge].from == model[edge].to) split_edge(model, edge, kMiddle);
}

void check_source(const OpenVolume& source)
{
    const Model& model = source.model;
    const auto parts = connected_parts(model, all_faces(model));
    if (parts.size() > 1)
        throw InvalidInput(Message("closure.along_parts", "{} and {} of the source do not touch",
                                   entity_of(model, parts[0].front()), entity_of(model, parts[1].front()))
                               .remedy("open a volume for each of them"));
    if (free_edges(source).empty())
        throw InvalidInput(
            Message("closure.along_closed", "the source, which contains {}, is a closed surface",
                    entity_of(model, FaceId(0)))
                .remedy("open a volume for a part of it, or name an inner and an outer surface"));
}

} // namespace

void refuse_edges_on_axis(const SweptSource& swept)
{
    if (swept.on_axis) check_axis(swept.source.model, swept.on_axis->point, swept.on_axis->direction, true);
}

SweptSource swept_source(const Model& model, OpenVolume source, const Along& along, const RunContext& context)
{
    check_cancelled(context);
    check_source(source);
    divide_closed_edges(source.model);
    SweptSource swept{std::move(source), nullptr};
    MotionMaker maker{model, swept, distortion_of(along),
                      centroid_of(swept.source.model, all_faces(swept.source.model)), context};
    swept.motion = std::make_shared<const geometry::Motion>(std::visit(maker, along.course));
    return swept;
}

} // namespace lacuna::closure
