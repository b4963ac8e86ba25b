// SPDX-License-Identifier: MIT
#include <lacuna/closure/cut_edges.h>

#include <algorithm>
#include <set>

namespace lacuna::closure {

using namespace topology;
using matching::Split;

namespace {

VertexId add_vertex(Model& model, Index point)
{
    Vertex vertex{point, 1, Origin::made_void};
    for (const Vertex& other : model.vertices) vertex.tag = std::max(vertex.tag, other.tag + 1);
    model.vertices.push_back(vertex);
    return VertexId(model.vertices.size() - 1);
}

/// Cut an edge at one of its inner points; the part behind it is a new edge.
VertexId cut(Model& model, EdgeId id, std::size_t point)
{
    const auto at = static_cast<std::ptrdiff_t>(point);
    const VertexId middle = add_vertex(model, model[id].points[point]);
    Edge behind = model[id];
    behind.from = middle;
    behind.points.erase(behind.points.begin(), behind.points.begin() + at);
    Edge& edge = model[id];
    edge.to = middle;
    edge.points.resize(point + 1);
    if (!edge.params.empty()) {
        behind.params.erase(behind.params.begin(), behind.params.begin() + at);
        edge.params.resize(point + 1);
    }
    const EdgeId more(model.edges.size());
    model.edges.push_back(std::move(behind));
    for (Face& face : model.faces) {
        for (Loop& loop : face.loops) {
            for (std::size_t i = 0; i < loop.uses.size(); ++i) {
                if (loop.uses[i].edge != id) continue;
                const bool reversed = loop.uses[i].reversed;
                loop.uses.insert(loop.uses.begin() + static_cast<std::ptrdiff_t>(reversed ? i : i + 1),
                                 {more, reversed});
                ++i;
            }
        }
    }
    return middle;
}

} // namespace

std::vector<std::pair<VertexId, VertexId>> cut_edges(OpenVolume& volume, const matching::Match& match)
{
    Model& model = volume.model;
    std::set<VertexId> on_wall, paired;
    for (const FaceId wall : volume.faces(Role::wall)) {
        for (const Loop& loop : model[wall].loops) {
            for (const EdgeUse& use : loop.uses) on_wall.insert({model[use.edge].from, model[use.edge].to});
        }
    }
    for (const auto& [source, target] : match.vertices) paired.insert({source, target});
    const auto uses = edge_uses(model);

    // From the end of each edge, so that the points in front of a cut keep their numbers.
    std::vector<Split> splits = match.splits;
    std::stable_sort(splits.begin(), splits.end(),
                     [](const Split& a, const Split& b) { return a.point > b.point; });
    std::vector<std::pair<VertexId, VertexId>> pairs;
    for (const Split& split : splits) {
        if (on_wall.contains(split.vertex) || uses[split.edge.index()].size() != 1) continue;
        const Edge& edge = model[split.edge];
        VertexId partner;
        if (split.point == 0)
            partner = edge.from;
        else if (split.point + 1 >= edge.points.size())
            partner = edge.to;
        else
            partner = cut(model, split.edge, split.point);
        // An end of the edge may be somebody's partner already; two places may be one.
        if (on_wall.contains(partner) || !paired.insert(partner).second) continue;
        paired.insert(split.vertex);
        pairs.emplace_back(split.on_target ? split.vertex : partner,
                           split.on_target ? partner : split.vertex);
    }
    return pairs;
}

} // namespace lacuna::closure
