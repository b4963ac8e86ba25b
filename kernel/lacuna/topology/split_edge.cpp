// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/split_edge.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/side_points.h>

#include <algorithm>
#include <cmath>

namespace lacuna::topology {

namespace {

/// The faces whose loops use an edge.
std::vector<FaceId> users_of(const Model& model, EdgeId edge)
{
    std::vector<FaceId> users;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        for (const Loop& loop : model.faces[f].loops) {
            const bool uses = std::any_of(loop.uses.begin(), loop.uses.end(),
                                          [&](const EdgeUse& use) { return use.edge == edge; });
            if (uses && (users.empty() || users.back() != FaceId(f))) users.emplace_back(f);
        }
    }
    return users;
}

[[noreturn]] void refuse(const Model& model, EdgeId edge, const std::string& code, const std::string& why)
{
    throw InvalidInput("topology." + code, name_of(model, edge) + " cannot be split " + why);
}

/// The inner point of a chain closest to a running length.
std::size_t nearest_inner(const std::vector<double>& arc, double at)
{
    std::size_t best = 1;
    for (std::size_t i = 2; i + 1 < arc.size(); ++i) {
        if (std::abs(arc[i] - at) < std::abs(arc[best] - at)) best = i;
    }
    return best;
}

/// Insert a point into side `segment` of an edge and into the adjacent facets.
void insert_point(Model& model, EdgeId id, const std::vector<FaceId>& users, std::size_t segment,
                  double fraction)
{
    Edge& edge = model[id];
    const Index a = edge.points[segment], b = edge.points[segment + 1];
    Vec3 place = (1 - fraction) * model.at(a) + fraction * model.at(b);
    if (!edge.params.empty()) {
        const double param = (1 - fraction) * edge.params[segment] + fraction * edge.params[segment + 1];
        if (edge.curve) edge.curve->evaluate({&param, 1}, {&place, 1});
        edge.params.insert(edge.params.begin() + static_cast<std::ptrdiff_t>(segment) + 1, param);
    }
    const auto point = static_cast<Index>(model.points.size());
    model.points.push_back(place);
    edge.points.insert(edge.points.begin() + static_cast<std::ptrdiff_t>(segment) + 1, point);

    SidePoints sides;
    sides.add(a, b, {point});
    for (const FaceId f : users) cut_at_sides(model.points, model[f], sides);
}

/// Make inner point `at` a vertex and split the edge there.
EdgeSplit divide(Model& model, EdgeId id, const std::vector<FaceId>& users, std::size_t at)
{
    Vertex vertex{model[id].points[at], 1, Origin::made_void};
    for (const Vertex& other : model.vertices) vertex.tag = std::max(vertex.tag, other.tag + 1);
    const EdgeSplit made{VertexId(model.vertices.size()), EdgeId(model.edges.size())};
    model.vertices.push_back(vertex);

    Edge behind = model[id];
    for (const Edge& other : model.edges) {
        if (other.origin == behind.origin) behind.tag = std::max(behind.tag, other.tag + 1);
    }
    const auto offset = static_cast<std::ptrdiff_t>(at);
    behind.from = made.vertex;
    behind.points.erase(behind.points.begin(), behind.points.begin() + offset);
    Edge& edge = model[id];
    edge.to = made.vertex;
    edge.points.resize(at + 1);
    if (!edge.params.empty()) {
        behind.params.erase(behind.params.begin(), behind.params.begin() + offset);
        edge.params.resize(at + 1);
    }
    model.edges.push_back(std::move(behind));

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

} // namespace

EdgeSplit split_edge(Model& model, EdgeId id, double fraction)
{
    if (!(fraction > 0 && fraction < 1)) {
        refuse(model, id, "split_at_end",
               "at " + std::to_string(fraction) + " of its length; give a fraction between 0 and 1");
    }
    const std::vector<FaceId> users = users_of(model, id);
    std::vector<Vec3> places;
    for (const Index p : model[id].points) places.push_back(model.at(p));
    const std::vector<double> arc = geometry::arc_lengths(places);
    const double wanted = fraction * arc.back();
    const bool has_inner = arc.size() > 2;

    const auto with_mesh = std::find_if(users.begin(), users.end(),
                                        [&](FaceId f) { return !model[f].given_quads.empty(); });
    if (with_mesh != users.end() && !has_inner) {
        refuse(model, id, "split_kept_mesh",
               "without changing the given mesh of " + name_of(model, *with_mesh) +
                   ", which has no node inside the edge; load with keep_mesh = false, or pair "
                   "the edge's own vertices");
    }
    const std::size_t nearest = has_inner ? nearest_inner(arc, wanted) : 0;
    if (has_inner && (with_mesh != users.end() || std::abs(arc[nearest] - wanted) <= model.tolerance))
        return divide(model, id, users, nearest);
    if (std::min(wanted, arc.back() - wanted) <= model.tolerance) {
        refuse(model, id, "split_at_end",
               "at " + std::to_string(fraction) + " of its length, which is within the tolerance of its end");
    }
    const geometry::PolylinePlace place = geometry::place_at(arc, wanted);
    insert_point(model, id, users, place.segment, place.fraction);
    return divide(model, id, users, place.segment + 1);
}

} // namespace lacuna::topology
