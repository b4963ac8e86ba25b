// SPDX-License-Identifier: MIT
//
// stitch() merges vertices, collapses short edges, splits T-junctions, merges coincident edges with all their
// points, and removes duplicates. Each step collects all changes before it makes them. Therefore the order of
// the entities only determines which tags are kept.
#include <lacuna/healing/shared/stitch.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/healing/detail/stitcher.h>
#include <lacuna/healing/detail/surplus_faces.h>
#include <lacuna/topology/open_volume.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>

namespace lacuna::healing {

StitchReport Stitcher::run()
{
    join_vertices();
    split_at_vertices();
    merge_edges();
    leave_out_thin_faces(loose_, tolerance_, report_);
    leave_out_repeated_faces(loose_, tolerance_, report_, context_);
    note_gaps(loose_, tolerance_, report_, context_);
    return std::move(report_);
}

// --- vertices and short edges ------------------------------------------------------------------------------

void Stitcher::join_vertices()
{
    std::vector<Vec3> at;
    std::vector<std::array<Vec3, 2>> dots;
    for (const topology::Vertex& vertex : model().vertices) {
        at.push_back(model().at(vertex.point));
        dots.push_back({at.back(), at.back()});
    }
    geometry::UnionFind near(at.size());
    for (const topology::NearSegment& pair : topology::near_segments(at, dots, tolerance_, context_)) {
        if ((at[index(pair.point)] - at[index(pair.segment)]).norm() > tolerance_) continue;
        near.unite_least(index(pair.point), index(pair.segment));
    }
    double furthest = 0;
    std::size_t far = 0;
    for (std::size_t v = 0; v < at.size(); ++v) {
        const std::size_t stays = near.find(v);
        if (stays == v) continue;
        loose_.join(VertexId(v), VertexId(stays));
        ++report_.vertices_merged;
        const double moved = (at[v] - at[stays]).norm();
        if (moved <= furthest) continue;
        furthest = moved;
        far = v;
    }
    if (furthest > 2 * tolerance_) {
        report_.notes.push_back(Message("healing.vertex_chain",
                                        "a chain of vertices, each within the tolerance of {:.3g} of the "
                                        "next, became one vertex, and {} moved by {:.3g}",
                                        tolerance_, entity_of(model(), VertexId(far)), furthest)
                                    .remedy("give a smaller tolerance to keep them apart"));
    }
    settle_points();
    collapse_short_edges();
}

void Stitcher::collapse_short_edges()
{
    for (std::size_t e = 0; e < model().edges.size(); ++e) {
        const topology::Edge& edge = model().edges[e];
        if (edge.from != edge.to || loose_.is_gone(EdgeId(e))) continue;
        const Vec3& at = model().at(edge.points.front());
        const bool is_short = std::all_of(edge.points.begin(), edge.points.end(),
                                          [&](Index p) { return (model().at(p) - at).norm() <= tolerance_; });
        if (!is_short) continue;
        for (const Index p : edge.points) loose_.join(p, edge.points.front());
        loose_.remove(EdgeId(e));
        ++report_.edges_collapsed;
    }
    if (report_.edges_collapsed > 0) settle_points();
}

void Stitcher::settle_points()
{
    const LooseModel::Shrunk shrunk = loose_.settle_points();
    report_.edges_collapsed += shrunk.edges;
    for (const FaceId f : shrunk.faces) {
        ++report_.faces_left_out;
        report_.notes.push_back(thin_face_note(model(), f, tolerance_));
    }
    for (const FaceId f : shrunk.meshes) {
        report_.notes.push_back(Message("healing.mesh_not_kept",
                                        "the mesh of {} cannot be kept: sides of its quads are no longer "
                                        "than the tolerance of {:.3g}",
                                        entity_of(model(), f), tolerance_)
                                    .remedy("give a smaller tolerance"));
    }
    tracks_.clear();
    check_cancelled(context_);
}

// --- T-junctions -------------------------------------------------------------------------------------------

void Stitcher::split_at_vertices()
{
    std::map<EdgeId, std::vector<Stop>> stops = find_stops();
    for (auto& [e, on_edge] : stops) place_stops(e, on_edge);
    const std::map<EdgeId, VertexId> begins = begin_elsewhere(stops);
    std::erase_if(stops, [](const auto& entry) { return entry.second.empty(); });
    if (stops.empty()) return;

    topology::SidePoints sides;
    std::vector<EdgeId> edges;
    for (const auto& [e, on_edge] : stops) {
        edges.push_back(e);
        for (const Stop& stop : on_edge) {
            if (stop.node == 0) continue;
            loose_.join(model()[e].points[stop.node], model()[stop.vertex].point);
            if (!model()[e].params.empty()) loose_.edge(e).params[stop.node] = stop.place.param;
        }
    }
    settle_points();
    for (const EdgeId e : edges) {
        const std::vector<Index>& points = model()[e].points;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            std::vector<Index> between;
            for (const Stop& stop : stops[e]) {
                if (stop.node == 0 && static_cast<std::size_t>(stop.place.s) == i)
                    between.push_back(model()[stop.vertex].point);
            }
            sides.add(points[i], points[i + 1], std::move(between));
        }
    }
    loose_.cut(sides, edges);
    for (const auto& [e, on_edge] : stops) {
        const auto begin = begins.find(e);
        insert_stops(e, on_edge, begin == begins.end() ? std::nullopt : std::optional(begin->second));
    }
    tracks_.clear();
}

/// Find vertices in the interior of edges, where the edge or an edge at the vertex is free.
std::map<EdgeId, std::vector<Stitcher::Stop>> Stitcher::find_stops()
{
    std::vector<bool> at_free(model().vertices.size(), false);
    std::vector<bool> in_use(model().vertices.size(), false);
    bool any_free = false;
    for (std::size_t e = 0; e < model().edges.size(); ++e) {
        if (loose_.is_gone(EdgeId(e))) continue;
        for (const VertexId v : {model().edges[e].from, model().edges[e].to}) {
            in_use[v.index()] = true;
            if (loose_.is_free(EdgeId(e))) any_free = at_free[v.index()] = true;
        }
    }
    if (!any_free) return {};
    std::vector<VertexId> vertices;
    std::vector<Vec3> at;
    for (std::size_t v = 0; v < in_use.size(); ++v) {
        if (!in_use[v]) continue;
        vertices.emplace_back(v);
        at.push_back(model().at(model().vertices[v].point));
    }
    std::vector<std::array<Vec3, 2>> segments;
    std::vector<EdgeId> edge_of;
    double sagitta = 0;
    for (std::size_t e = 0; e < model().edges.size(); ++e) {
        if (loose_.is_gone(EdgeId(e))) continue;
        // A seam is not split: both its sides belong to the same face.
        if (loose_.is_seam(EdgeId(e))) continue;
        const EdgeTrack& on = track(EdgeId(e));
        sagitta = std::max(sagitta, on.sagitta());
        for (std::size_t i = 0; i + 1 < on.samples().size(); ++i) {
            segments.push_back({on.samples()[i], on.samples()[i + 1]});
            edge_of.emplace_back(e);
        }
    }
    std::map<EdgeId, std::set<VertexId>> close;
    for (const topology::NearSegment& pair :
         topology::near_segments(at, segments, tolerance_ + sagitta, context_)) {
        const EdgeId e = edge_of[index(pair.segment)];
        const VertexId v = vertices[index(pair.point)];
        if (v == model()[e].from || v == model()[e].to || !(loose_.is_free(e) || at_free[v.index()]))
            continue;
        const auto& [a, b] = segments[index(pair.segment)];
        const Vec3& p = at[index(pair.point)];
        if ((a + topology::fraction_along(p, a, b) * (b - a) - p).norm() > tolerance_ + track(e).sagitta())
            continue;
        close[e].insert(v);
    }
    std::map<EdgeId, std::vector<Stop>> stops;
    for (const auto& [e, on_edge] : close) {
        std::vector<Vec3> points;
        for (const VertexId v : on_edge) points.push_back(model().at(model()[v].point));
        const std::vector<EdgeTrack::EdgePosition> places = track(e).locate(points, tolerance_, context_);
        std::size_t i = 0;
        for (const VertexId v : on_edge) {
            if (places[i].distance <= tolerance_) stops[e].push_back({v, places[i]});
            ++i;
        }
    }
    return stops;
}

/// Assign each stop to a point of the edge if one is near. Drop stops between two nodes of a kept mesh.
void Stitcher::place_stops(EdgeId e, std::vector<Stop>& stops)
{
    const topology::Edge& edge = model()[e];
    std::stable_sort(stops.begin(), stops.end(),
                     [](const Stop& a, const Stop& b) { return a.place.s < b.place.s; });
    const bool keeps_mesh = loose_.keeps_mesh(e);
    const auto at = [&](std::size_t i) -> const Vec3& { return model().at(edge.points[i]); };
    std::size_t taken = 0;
    std::vector<Stop> placed;
    for (Stop& stop : stops) {
        const auto near = static_cast<std::size_t>(stop.place.s + 0.5);
        if (near > taken && near + 1 < edge.points.size()) {
            double radius = tolerance_;
            if (track(e).exact() && !keeps_mesh) {
                radius = std::max(radius, kOnePoint * std::min((at(near) - at(near - 1)).norm(),
                                                               (at(near + 1) - at(near)).norm()));
            }
            if ((at(near) - model().at(model()[stop.vertex].point)).norm() <= radius)
                stop.node = taken = near;
        }
        if (stop.node == 0 && keeps_mesh) {
            report_.notes.push_back(
                Message("healing.kept_meshes_differ",
                        "{} lies on {} between two nodes of a kept mesh, so the faces stay unconnected there",
                        entity_of(model(), stop.vertex), named(e))
                    .remedy("load with keep_mesh = false, or make the meshes match"));
            continue;
        }
        // The stop must not lie before a point that an earlier stop uses: the edge would fold back.
        if (stop.node == 0) stop.place.s = std::max(stop.place.s, static_cast<double>(taken));
        placed.push_back(stop);
    }
    stops = std::move(placed);
}

/// Choose a new start for each closed polyline whose own vertex belongs to no other edge: a vertex that was
/// found on the polyline.
/// @return  by edge: its new start
std::map<EdgeId, VertexId> Stitcher::begin_elsewhere(std::map<EdgeId, std::vector<Stop>>& stops)
{
    std::vector<int> edges_at(model().vertices.size(), 0);
    for (std::size_t e = 0; e < model().edges.size(); ++e) {
        if (loose_.is_gone(EdgeId(e))) continue;
        const topology::Edge& edge = model().edges[e];
        ++edges_at[edge.from.index()];
        if (edge.to != edge.from) ++edges_at[edge.to.index()];
    }
    std::map<EdgeId, VertexId> begins;
    std::set<VertexId> unused;
    for (auto& [e, on_edge] : stops) {
        std::erase_if(on_edge, [&](const Stop& stop) { return unused.contains(stop.vertex); });
        const topology::Edge& edge = model()[e];
        if (edge.from != edge.to || edges_at[edge.from.index()] != 1 || edge.curve || on_edge.empty())
            continue;
        const auto better = std::max_element(
            on_edge.begin(), on_edge.end(), [&](const Stop& a, const Stop& b) {
                return edges_at[a.vertex.index()] < edges_at[b.vertex.index()];
            });
        begins[e] = better->vertex;
        unused.insert(edge.from);
        ++edges_at[better->vertex.index()];
    }
    for (auto& [e, on_edge] : stops)
        std::erase_if(on_edge, [&](const Stop& stop) { return unused.contains(stop.vertex); });
    return begins;
}

/// Insert the stops into an edge, rotate a closed edge to its new start, and split the edge at the stops.
void Stitcher::insert_stops(EdgeId e, const std::vector<Stop>& stops, std::optional<VertexId> begin)
{
    topology::Edge edge = model()[e];
    std::map<Index, VertexId> vertex_at;
    for (const Stop& stop : stops) vertex_at[model()[stop.vertex].point] = stop.vertex;
    for (auto stop = stops.rbegin(); stop != stops.rend(); ++stop) {
        if (stop->node != 0) continue;
        const auto after = static_cast<std::ptrdiff_t>(stop->place.s) + 1;
        edge.points.insert(edge.points.begin() + after, model()[stop->vertex].point);
        if (!edge.params.empty()) edge.params.insert(edge.params.begin() + after, stop->place.param);
    }
    if (begin) {
        edge.points.pop_back();
        std::rotate(edge.points.begin(),
                    std::find(edge.points.begin(), edge.points.end(), model()[*begin].point),
                    edge.points.end());
        edge.points.push_back(edge.points.front());
        edge.from = edge.to = *begin;
    }
    std::vector<std::pair<std::size_t, VertexId>> cuts;
    for (std::size_t i = 1; i + 1 < edge.points.size(); ++i) {
        const auto found = vertex_at.find(edge.points[i]);
        if (found != vertex_at.end()) cuts.emplace_back(i, found->second);
    }
    loose_.edge(e) = std::move(edge);
    if (cuts.empty()) return;
    loose_.divide(e, cuts);
    ++report_.edges_split;
}

std::string StitchReport::summary() const
{
    std::string text;
    const auto add = [&](int count, const char* one, const char* many) {
        if (count == 0) return;
        text += formatted("{}{} {}", text.empty() ? "stitched: " : ", ", count, count == 1 ? one : many);
    };
    add(vertices_merged, "vertex joined", "vertices joined");
    add(edges_merged, "edge merged", "edges merged");
    add(edges_split, "edge split", "edges split");
    add(edges_collapsed, "short edge collapsed", "short edges collapsed");
    add(faces_left_out, "face left out", "faces left out");
    return text;
}

void append(topology::ModelBuilder& model, topology::Model more)
{
    topology::ModelBuilder added(std::move(more));
    const auto moved = [first = static_cast<Index>(model.points.size())](Index& p) { p += first; };
    const std::size_t first_vertex = model.vertices.size(), first_edge = model.edges.size();
    for (topology::Vertex& vertex : added.vertices) moved(vertex.point);
    for (topology::Edge& edge : added.edges) {
        edge.from = VertexId(edge.from.index() + first_vertex);
        edge.to = VertexId(edge.to.index() + first_vertex);
        std::ranges::for_each(edge.points, moved);
    }
    for (topology::Face& face : added.faces) {
        for (topology::Loop& loop : face.loops)
            for (topology::EdgeUse& use : loop.uses) use.edge = EdgeId(use.edge.index() + first_edge);
        for (Triangle& t : face.triangles) std::ranges::for_each(t, moved);
        for (Quad& q : face.given_quads) std::ranges::for_each(q, moved);
    }
    std::ranges::move(added.points, std::back_inserter(model.points));
    std::ranges::move(added.vertices, std::back_inserter(model.vertices));
    std::ranges::move(added.edges, std::back_inserter(model.edges));
    std::ranges::move(added.faces, std::back_inserter(model.faces));
}

StitchReport stitch(topology::Model& model, double tolerance, const RunContext& context, double share)
{
    if (!(tolerance > 0)) {
        throw InvalidInput("topology.bad_tolerance", "the stitching tolerance is {:.3g}; it must be above {}",
                           found(tolerance), needed(0));
    }
    const bool has_loops = std::any_of(model.faces.begin(), model.faces.end(),
                                       [](const topology::Face& face) { return !face.loops.empty(); });
    if (!has_loops && !model.edges.empty()) model = topology::with_loops(model);
    check_cancelled(context);
    Stitcher stitcher(model, tolerance, context, share);
    StitchReport report = stitcher.run();
    if (!report.changed()) return report;
    auto stitched = attempt<InvalidInput>([&] { return stitcher.result(); });
    if (!stitched) {
        StitchReport failed;
        failed.notes.push_back(stitched.why->about("faces that meet could not be joined"));
        return failed;
    }
    model = std::move(*stitched);
    return report;
}

} // namespace lacuna::healing
