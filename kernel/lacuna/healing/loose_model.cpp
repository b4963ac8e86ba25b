// SPDX-License-Identifier: MIT
#include <lacuna/healing/detail/loose_model.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/renumbered.h>
#include <lacuna/core/shared/same_corners.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/split_edge.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace lacuna::healing {

namespace {

/// Remove pairs of facets that lie back to back. Such pairs arise when a facet that is no wider than the
/// tolerance collapses.
/// @return whether any were removed
bool drop_folds(topology::Face& face)
{
    std::map<Triangle, std::vector<std::size_t>> alike;
    for (std::size_t t = 0; t < face.triangles.size(); ++t) alike[rising(face.triangles[t])].push_back(t);
    std::vector<bool> gone(face.triangles.size(), false);
    const auto runs_up = [&](std::size_t t) {
        Triangle f = face.triangles[t];
        std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
        return f[1] < f[2];
    };
    for (const auto& [key, facets] : alike) {
        if (facets.size() != 2 || runs_up(facets[0]) == runs_up(facets[1])) continue;
        gone[facets[0]] = gone[facets[1]] = true;
    }
    return topology::erase_facets(face, [&](std::size_t t) { return gone[t]; });
}

} // namespace

LooseModel::LooseModel(const topology::Model& model)
    : model_(model),
      edge_gone_(model_.edges.size(), false),
      face_gone_(model_.faces.size(), false),
      users_(model_.edges.size()),
      vertex_joined_(model_.vertices.size()),
      joined_(model_.points.size()),
      kept_(model_.points.size(), false),
      touched_(model_.points.size(), false),
      inside_(model_.points.size(), false)
{
    for (std::size_t v = 0; v < vertex_joined_.size(); ++v) vertex_joined_[v] = VertexId(v);
    for (const topology::Edge& edge : model_.edges) next_edge_tag_ = std::max(next_edge_tag_, edge.tag + 1);
    for (std::size_t e = 0; e < users_.size(); ++e)
        for (const topology::FaceUse& use : model.uses_of_edge(EdgeId(e))) users_[e].push_back(use.face);
    for (const topology::Face& face : model_.faces)
        for (const Quad& q : face.given_quads)
            for (const Index p : q) kept_[index(p)] = true;
}

bool LooseModel::keeps_mesh(EdgeId e) const
{
    return std::any_of(users(e).begin(), users(e).end(),
                       [&](FaceId f) { return !model_[f].given_quads.empty(); });
}

std::vector<std::vector<EdgeId>> LooseModel::edges_of_faces() const
{
    std::vector<std::vector<EdgeId>> edges(model_.faces.size());
    for (std::size_t e = 0; e < users_.size(); ++e) {
        if (edge_gone_[e]) continue;
        for (const FaceId f : users_[e]) edges[f.index()].emplace_back(e);
    }
    return edges;
}

Index LooseModel::stays_as(Index p) { return static_cast<Index>(joined_.find(p)); }

void LooseModel::join(Index gone, Index stays)
{
    gone = stays_as(gone);
    stays = stays_as(stays);
    if (gone == stays) return;
    if (kept_[index(gone)] && !kept_[index(stays)]) {
        model_.points[index(stays)] = model_.points[index(gone)];
        kept_[index(stays)] = true;
    }
    joined_.unite(stays, gone);
    touched_[index(stays)] = true;
}

void LooseModel::join(VertexId gone, VertexId stays)
{
    join(model_[gone].point, model_[stays].point);
    vertex_joined_[gone.index()] = stays;
}

/// Remove the collapsed facets of a face. @return whether any facet is left
bool LooseModel::shrink(FaceId f)
{
    topology::Face& face = model_[f];
    const bool shrank = topology::erase_facets(
        face, [&](std::size_t t) { return topology::repeats(face.triangles[t]); });
    if (shrank && drop_folds(face)) folded_ = true;
    return !face.triangles.empty();
}

LooseModel::Shrunk LooseModel::settle_points()
{
    Shrunk shrunk;
    for (topology::Vertex& vertex : model_.vertices) vertex.point = stays_as(vertex.point);
    for (std::size_t e = 0; e < model_.edges.size(); ++e) {
        topology::Edge& edge = model_.edges[e];
        if (edge_gone_[e]) continue;
        edge.from = vertex_joined_[edge.from.index()];
        edge.to = vertex_joined_[edge.to.index()];
        std::size_t kept = 0;
        for (std::size_t i = 0; i < edge.points.size(); ++i) {
            const Index p = stays_as(edge.points[i]);
            if (kept > 0 && edge.points[kept - 1] == p) continue;
            if (!edge.params.empty()) edge.params[kept] = edge.params[i];
            edge.points[kept++] = p;
        }
        edge.points.resize(kept);
        if (!edge.params.empty()) edge.params.resize(kept);
        edge_gone_[e] = kept < 2;
        shrunk.edges += kept < 2 ? 1 : 0;
    }
    for (std::size_t f = 0; f < model_.faces.size(); ++f) {
        topology::Face& face = model_.faces[f];
        if (face_gone_[f]) continue;
        for (Triangle& t : face.triangles)
            for (Index& p : t) p = stays_as(p);
        for (Quad& q : face.given_quads)
            for (Index& p : q) p = stays_as(p);
        if (std::any_of(face.given_quads.begin(), face.given_quads.end(),
                        [](const Quad& q) { return topology::repeats(q); })) {
            face.given_quads.clear();
            shrunk.meshes.emplace_back(f);
        }
        if (shrink(FaceId(f))) continue;
        remove(FaceId(f));
        shrunk.faces.emplace_back(f);
    }
    return shrunk;
}

void LooseModel::cut(const topology::SidePoints& sides, const std::vector<EdgeId>& edges)
{
    if (sides.empty()) return;
    std::vector<bool> concerned(model_.faces.size(), false);
    for (const EdgeId e : edges)
        for (const FaceId f : users(e)) concerned[f.index()] = true;
    for (std::size_t f = 0; f < concerned.size(); ++f) {
        if (!concerned[f] || face_gone_[f]) continue;
        topology::Face& face = model_.faces[f];
        for (const Triangle& t : face.triangles)
            for (std::size_t k = 0; k < 3; ++k)
                for (const Index p : sides.on(t[k], t[(k + 1) % 3])) touched_[index(p)] = true;
        topology::cut_at_sides(model_.points, face, sides);
        shrink(FaceId(f));
        if (drop_folds(face)) folded_ = true;
    }
}

void LooseModel::divide(EdgeId e, const std::vector<std::pair<std::size_t, VertexId>>& at)
{
    std::vector<topology::Edge> parts = topology::divided(model_[e], at);
    model_[e] = std::move(parts.front());
    for (std::size_t k = 1; k < parts.size(); ++k) {
        parts[k].tag = next_edge_tag_++;
        model_.edges.push_back(std::move(parts[k]));
        edge_gone_.push_back(false);
        users_.push_back(std::vector<FaceId>(users_[e.index()]));
    }
}

void LooseModel::merge(EdgeId gone, EdgeId stays)
{
    edge_gone_[gone.index()] = true;
    std::vector<FaceId>& to = users_[stays.index()];
    to.insert(to.end(), users(gone).begin(), users(gone).end());
    std::sort(to.begin(), to.end());
}

void LooseModel::remove(FaceId f)
{
    face_gone_[f.index()] = true;
    for (std::vector<FaceId>& users : users_) std::erase(users, f);
}

/// A facet side inside a face may have the same two ends as an edge of another face with a single segment.
/// Split such a side; otherwise it would be taken for this edge.
void LooseModel::part_shortcuts()
{
    std::map<std::pair<Index, Index>, std::vector<FaceId>> single;
    for (std::size_t e = 0; e < model_.edges.size(); ++e) {
        const topology::Edge& edge = model_.edges[e];
        if (edge_gone_[e] || edge.points.size() != 2) continue;
        auto& users = single[std::minmax(edge.points[0], edge.points[1])];
        users.insert(users.end(), users_[e].begin(), users_[e].end());
    }
    if (single.empty()) return;
    for (std::size_t f = 0; f < model_.faces.size(); ++f) {
        if (face_gone_[f]) continue;
        topology::Face& face = model_.faces[f];
        std::map<std::pair<Index, Index>, int> met;
        for (const Triangle& t : face.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::pair<Index, Index> side = std::minmax(t[k], t[(k + 1) % 3]);
                const auto found = single.find(side);
                if (found != single.end() &&
                    std::count(found->second.begin(), found->second.end(), FaceId(f)) == 0)
                    ++met[side];
            }
        }
        topology::SidePoints middles;
        for (const auto& [side, count] : met) {
            if (count < 2) continue;
            middles.add(side.first, side.second, {static_cast<Index>(model_.points.size())});
            model_.points.push_back((model_.at(side.first) + model_.at(side.second)) / 2);
            joined_.add();
            kept_.push_back(false);
            touched_.push_back(true);
            inside_.push_back(true);
        }
        if (middles.empty()) continue;
        topology::cut_at_sides(model_.points, face, middles);
    }
}

/// Recompute surface parameters at corners whose points are new or were moved.
void LooseModel::renew_parameters(const RunContext& context)
{
    for (std::size_t f = 0; f < model_.faces.size(); ++f) {
        topology::Face& face = model_.faces[f];
        if (face_gone_[f] || !face.surface || face.uv.size() != face.triangles.size()) continue;
        std::vector<std::pair<std::size_t, std::size_t>> corners;
        std::vector<Vec3> at;
        std::vector<Vec2> uv;
        for (std::size_t t = 0; t < face.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Index p = face.triangles[t][k];
                if (!touched_[index(p)]) continue;
                corners.emplace_back(t, k);
                at.push_back(model_.at(p));
                uv.push_back(face.uv[t][k]);
            }
        }
        if (corners.empty()) continue;
        if (!attempt<BackendError>([&] { face.surface->project(at, uv, context); }))
            continue; // keep the interpolated parameters
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto [t, k] = corners[i];
            // At a seam, the projection may return parameters of the other side of the seam. Such a change is
            // larger than half a facet and is ignored.
            for (int axis = 0; axis < 2; ++axis) {
                const auto [low, high] = std::minmax(
                    {face.uv[t][0][axis], face.uv[t][1][axis], face.uv[t][2][axis]});
                const double moved = std::abs(uv[i][axis] - face.uv[t][k][axis]);
                if (moved <= (high - low) / 2) face.uv[t][k][axis] = uv[i][axis];
            }
            const Index p = face.triangles[t][k];
            if (inside_[index(p)]) model_.points[index(p)] = at[i];
        }
    }
}

/// Remove edges that no facet has any more.
void LooseModel::drop_bare_edges()
{
    std::set<std::pair<Index, Index>> sides;
    for (std::size_t f = 0; f < model_.faces.size(); ++f) {
        if (face_gone_[f]) continue;
        for (const Triangle& t : model_.faces[f].triangles)
            for (std::size_t k = 0; k < 3; ++k) sides.insert(std::minmax(t[k], t[(k + 1) % 3]));
    }
    for (std::size_t e = 0; e < model_.edges.size(); ++e) {
        const std::vector<Index>& points = model_.edges[e].points;
        if (!edge_gone_[e] && !sides.contains(std::minmax(points[0], points[1]))) edge_gone_[e] = true;
    }
}

topology::Model LooseModel::settled(const RunContext& context)
{
    if (folded_) drop_bare_edges();
    part_shortcuts();
    renew_parameters(context);
    compact();
    for (topology::Face& face : model_.faces) face.loops.clear();
    model_.build_loops();
    return std::move(model_).finish();
}

void LooseModel::compact()
{
    keep_if(model_.faces, [&](std::size_t f) { return !face_gone_[f]; });
    keep_if(model_.edges, [&](std::size_t e) { return !edge_gone_[e] && !users_[e].empty(); });
    std::vector<bool> vertex_used(model_.vertices.size(), false);
    for (const topology::Edge& edge : model_.edges)
        vertex_used[edge.from.index()] = vertex_used[edge.to.index()] = true;
    const auto vertex = keep_if(model_.vertices, [&](std::size_t v) { return vertex_used[v]; });

    std::vector<bool> used(model_.points.size(), false);
    const auto use = [&](Index p) { used[index(p)] = true; };
    for (const topology::Vertex& v : model_.vertices) use(v.point);
    for (const topology::Edge& edge : model_.edges)
        std::for_each(edge.points.begin(), edge.points.end(), use);
    for (const topology::Face& face : model_.faces) {
        for (const Triangle& t : face.triangles) std::for_each(t.begin(), t.end(), use);
        for (const Quad& q : face.given_quads) std::for_each(q.begin(), q.end(), use);
    }
    const std::vector<Index> place = keep_if(model_.points, [&](std::size_t p) { return used[p]; });
    const auto renumber = [&](Index& p) { p = place[index(p)]; };
    for (topology::Vertex& v : model_.vertices) renumber(v.point);
    for (topology::Edge& edge : model_.edges) {
        edge.from = VertexId(index(vertex[edge.from.index()]));
        edge.to = VertexId(index(vertex[edge.to.index()]));
        std::for_each(edge.points.begin(), edge.points.end(), renumber);
    }
    for (topology::Face& face : model_.faces) {
        for (Triangle& t : face.triangles) std::for_each(t.begin(), t.end(), renumber);
        for (Quad& q : face.given_quads) std::for_each(q.begin(), q.end(), renumber);
    }
}

} // namespace lacuna::healing
