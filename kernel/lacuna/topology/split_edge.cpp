// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/split_edge.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/curve_place.h>
#include <lacuna/topology/shared/side_points.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace lacuna::topology {

namespace {

/// The faces whose loops use an edge.
std::vector<FaceId> users_of(const Model& model, EdgeId edge)
{
    std::vector<FaceId> users;
    for (const FaceUse& use : model.uses_of_edge(edge))
        if (users.empty() || users.back() != use.face) users.push_back(use.face);
    return users;
}

/// Where an edge is split: at its point number `at` or, if `made` is set, at a new point after this one.
struct SplitPlace {
    std::size_t at = 0;
    std::optional<Vec3> made{}; ///< the new point
    double param = 0;           ///< its parameter on the curve
};

/// Insert a point into a side of an edge and into the adjacent facets.
void insert_point(ModelBuilder& model, EdgeId id, const std::vector<FaceId>& users, const SplitPlace& split)
{
    Edge& edge = model[id];
    const Index a = edge.points[split.at], b = edge.points[split.at + 1];
    const auto behind = static_cast<std::ptrdiff_t>(split.at) + 1;
    if (!edge.params.empty()) edge.params.insert(edge.params.begin() + behind, split.param);
    const auto point = static_cast<Index>(model.points.size());
    model.points.push_back(*split.made);
    edge.points.insert(edge.points.begin() + behind, point);

    SidePoints sides;
    sides.add(a, b, {point});
    for (const FaceId f : users) cut_at_sides(model.points, model[f], sides);
}

/// Make inner point `at` a vertex and split the edge there.
EdgeSplit divide(ModelBuilder& model, EdgeId id, const std::vector<FaceId>& users, std::size_t at)
{
    const EdgeSplit made{model.add_void_vertex(model[id].points[at]), EdgeId(model.edges.size())};
    std::vector<Edge> parts = divided(model[id], {{at, made.vertex}});
    parts[1].tag = next_tag(model.edges, parts[1].origin);
    model[id] = std::move(parts[0]);
    model.edges.push_back(std::move(parts[1]));

    for (const FaceId f : users) {
        for (Loop& loop : model[f].loops) {
            std::vector<EdgeUse> uses;
            for (const EdgeUse& use : loop.uses) {
                if (use.edge == id && use.reversed) uses.push_back({made.behind, true});
                uses.push_back(use);
                if (use.edge == id && !use.reversed) uses.push_back({made.behind, false});
            }
            loop.uses = std::move(uses);
        }
    }
    return made;
}

/// @throw InvalidInput  the errors of `split_edge()`.
SplitPlace place_of_split(const Model& model, EdgeId id, const std::vector<FaceId>& users, double fraction)
{
    if (!(fraction > 0 && fraction < 1)) {
        throw InvalidInput(Message("topology.split_at_end", "{} cannot be split at {:.6g} of its length",
                                   entity_of(model, id), found(fraction))
                               .remedy("give a fraction between 0 and 1"));
    }
    const std::vector<double> arc = geometry::arc_lengths(places_at(model, model[id].points));
    const double wanted = fraction * arc.back();
    const bool has_inner = arc.size() > 2;

    const auto with_mesh = std::find_if(users.begin(), users.end(),
                                        [&](FaceId f) { return !model[f].given_quads.empty(); });
    if (with_mesh != users.end() && !has_inner) {
        throw InvalidInput(Message("topology.split_kept_mesh",
                                   "{} needs a vertex between its ends, but the given mesh of {} has no node "
                                   "there",
                                   entity_of(model, id), entity_of(model, *with_mesh))
                               .remedy("load with keep_mesh = false"));
    }
    std::size_t nearest = 0; // the inner point closest to the place
    if (has_inner)
        nearest = static_cast<std::size_t>(
            std::ranges::min_element(arc.begin() + 1, arc.end() - 1, {},
                                     [&](double at) { return std::abs(at - wanted); }) -
            arc.begin());
    if (has_inner && (with_mesh != users.end() || std::abs(arc[nearest] - wanted) <= model.tolerance))
        return {.at = nearest};
    if (std::min(wanted, arc.back() - wanted) <= model.tolerance) {
        throw InvalidInput("topology.split_at_end",
                           "{} cannot be split at {:.6g} of its length, which is within the tolerance of its "
                           "end",
                           entity_of(model, id), found(fraction));
    }
    const geometry::PolylinePlace on = geometry::place_at(arc, wanted);
    const Edge& edge = model[id];
    const std::size_t i = on.segment;
    const Vec3 made = (1 - on.fraction) * model.at(edge.points[i]) +
                      on.fraction * model.at(edge.points[i + 1]);
    if (edge.params.empty()) return {i, made};
    if (!edge.curve) return {i, made, (1 - on.fraction) * edge.params[i] + on.fraction * edge.params[i + 1]};
    const CurvePlace beside = curve_beside(model, edge, i, on.fraction);
    return {i, beside.place, beside.param};
}

} // namespace

CurvePlace curve_beside(const Model& model, const Edge& edge, std::size_t segment, double fraction)
{
    const Vec3 &a = model.at(edge.points[segment]), &b = model.at(edge.points[segment + 1]);
    const Vec3 chord = (1 - fraction) * a + fraction * b;
    const double low = edge.params[segment], high = edge.params[segment + 1];
    CurvePlace on{(1 - fraction) * low + fraction * high, chord};
    for (int step = 0; step < kMostSteps; ++step) {
        edge.curve->evaluate({&on.param, 1}, {&on.place, 1});
        const double off = (chord - on.place).dot(b - a) / (b - a).squaredNorm();
        if (std::abs(off) * (b - a).norm() <= kVisible * model.tolerance) break;
        on.param = std::clamp(on.param + off * (high - low), std::min(low, high), std::max(low, high));
    }
    return on;
}

std::vector<Edge> divided(Edge whole, const std::vector<std::pair<std::size_t, VertexId>>& at)
{
    const std::vector<Index> points = std::exchange(whole.points, {});
    const std::vector<double> params = std::exchange(whole.params, {});
    std::vector<Edge> parts(at.size() + 1, whole);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const std::size_t first = k == 0 ? 0 : at[k - 1].first;
        const std::size_t last = k < at.size() ? at[k].first : points.size() - 1;
        if (k > 0) parts[k].from = at[k - 1].second;
        if (k < at.size()) parts[k].to = at[k].second;
        const auto cut = [&](auto& list, const auto& all) {
            list = {all.begin() + std::ptrdiff_t(first), all.begin() + std::ptrdiff_t(last) + 1};
        };
        cut(parts[k].points, points);
        if (!params.empty()) cut(parts[k].params, params);
    }
    return parts;
}

EdgeSplit split_edge(Model& model, EdgeId id, double fraction)
{
    const std::vector<FaceId> users = users_of(model, id);
    const SplitPlace split = place_of_split(model, id, users, fraction);
    ModelBuilder builder(std::move(model));
    if (split.made) insert_point(builder, id, users, split);
    const EdgeSplit made = divide(builder, id, users, split.made ? split.at + 1 : split.at);
    model = std::move(builder).finish();
    return made;
}

} // namespace lacuna::topology
