// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/flat_ends.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/shared/imprint.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace lacuna::surface {

using namespace topology;

namespace {

class FlatLayer {
public:
    FlatLayer(const OpenVolume& base, const EndsMap& map, std::span<const RimPair> pairs,
              std::span<const EdgeId> inner, const Reach& reach)
        : base_(base), map_(map), pairs_(pairs), inner_(inner), reach_(reach)
    {
    }

    FlatEnds run()
    {
        collect();
        snap();
        cross();
        return std::move(flat_);
    }

private:
    std::size_t add_node(const Vec2& place)
    {
        flat_.place.push_back(place);
        flat_.vertex.emplace_back();
        return flat_.place.size() - 1;
    }

    /// Collect the inner edges of both ends, with nodes at their vertices.
    void collect()
    {
        const Model& base = base_.model;
        std::map<VertexId, VertexId> partner;
        for (const RimPair& pair : pairs_) partner[pair.target] = pair.source;
        std::set<VertexId> on_rim;
        for (std::size_t e = 0; e < base.edges.size(); ++e) {
            const std::span<const FaceUse> uses = base.uses_of_edge(EdgeId(e));
            if (uses.size() != 2) continue;
            const Role a = base_.role[uses[0].face.index()], b = base_.role[uses[1].face.index()];
            if ((a == Role::source) == (b == Role::source)) continue;
            on_rim.insert({base.edges[e].from, base.edges[e].to});
            flat_.rim.emplace_back(e);
        }
        const auto source_node = [&](VertexId vertex) {
            const auto [found, fresh] = node_of_.try_emplace(vertex, flat_.place.size());
            if (fresh) {
                add_node(map_.source(base[vertex].point));
                flat_.vertex.back() = vertex;
                if (!on_rim.contains(vertex)) loose_source_.push_back(found->second);
            }
            return found->second;
        };
        for (const EdgeId edge : flat_.rim) {
            source_node(base[edge].from);
            source_node(base[edge].to);
        }
        for (const EdgeId edge : inner_edges(base_, Role::source)) {
            FlatEdge flat = flat_edge(base, map_, edge, false);
            flat.cuts = {{0, source_node(base[edge].from)}, {1, source_node(base[edge].to)}};
            flat_.source.push_back(std::move(flat));
        }
        std::map<VertexId, std::size_t> target_node;
        const auto node_at = [&](VertexId vertex) {
            const auto paired = partner.find(vertex);
            if (paired != partner.end()) return source_node(paired->second);
            const auto [found, fresh] = target_node.try_emplace(vertex, flat_.place.size());
            if (fresh) {
                add_node(map_.target(base[vertex].point));
                loose_target_.push_back(found->second);
            }
            return found->second;
        };
        for (const EdgeId edge : inner_) {
            FlatEdge flat = flat_edge(base, map_, edge, true);
            flat.cuts = {{0, node_at(base[edge].from)}, {1, node_at(base[edge].to)}};
            flat_.target.push_back(std::move(flat));
        }
    }

    /// Replace a node by another node.
    void unite(std::size_t node, std::size_t with)
    {
        for (FlatEdge& edge : flat_.target) {
            for (FlatEdge::Cut& cut : edge.cuts) cut.node = cut.node == node ? with : cut.node;
        }
    }

    static bool has_node(const FlatEdge& edge, std::size_t node)
    {
        return std::ranges::any_of(edge.cuts, [&](const FlatEdge::Cut& cut) { return cut.node == node; });
    }

    /// The edge closest to a node, among the edges that do not end in the node.
    std::optional<Closest> closest_edge(std::vector<FlatEdge>& edges, std::size_t node, FlatEdge** which)
    {
        std::optional<Closest> best;
        for (FlatEdge& edge : edges) {
            if (has_node(edge, node)) continue;
            const Closest found = closest_on(edge.line, edge.at, flat_.place[node]);
            if (found.distance > reach_(flat_.place[node]) || (best && found.distance >= best->distance))
                continue;
            best = found;
            *which = &edge;
        }
        return best;
    }

    /// Whether a node is only the start vertex of a closed edge: no other edge ends there.
    static bool closes_edge(const std::vector<FlatEdge>& edges, std::size_t node)
    {
        std::size_t ends = 0;
        bool closed = false;
        for (const FlatEdge& edge : edges) {
            for (const FlatEdge::Cut& cut : edge.cuts) ends += cut.node == node ? 1 : 0;
            closed = closed || (edge.cuts.front().node == node && edge.cuts.back().node == node);
        }
        return closed && ends == 2;
    }

    /// Merge nodes and edges that are close to each other: vertices of the target with vertices or edges of
    /// the source, and vertices of the source with edges of the target.
    void snap()
    {
        std::set<std::size_t> taken;
        for (const std::size_t node : loose_target_) {
            if (closes_edge(flat_.target, node)) continue;
            std::optional<std::size_t> near;
            double least = reach_(flat_.place[node]);
            for (const std::size_t other : loose_source_) {
                const double off = (flat_.place[node] - flat_.place[other]).norm();
                if (taken.contains(other) || off > least || closes_edge(flat_.source, other)) continue;
                least = off;
                near = other;
            }
            if (near) {
                taken.insert(*near);
                unite(node, *near);
                continue;
            }
            FlatEdge* edge = nullptr;
            if (const auto on = closest_edge(flat_.source, node, &edge)) {
                flat_.place[node] = on->place;
                edge->cuts.push_back({on->at, node});
            }
        }
        for (const std::size_t node : loose_source_) {
            if (taken.contains(node) || closes_edge(flat_.source, node)) continue;
            FlatEdge* edge = nullptr;
            if (const auto on = closest_edge(flat_.target, node, &edge)) edge->cuts.push_back({on->at, node});
        }
    }

    /// Add nodes where inner edges of the two ends cross.
    void cross()
    {
        const std::vector<FlatPiece> low = pieces_of(flat_.source, flat_.place),
                                     high = pieces_of(flat_.target, flat_.place);
        for (const FlatPiece& a : low) {
            for (const FlatPiece& b : high) {
                if (are_one(a, b, reach_)) continue;
                for (std::size_t i = 0; i + 1 < a.line.size(); ++i) {
                    for (std::size_t j = 0; j + 1 < b.line.size(); ++j) {
                        const auto at = crossing(a.line[i], a.line[i + 1], b.line[j], b.line[j + 1]);
                        if (!at) continue;
                        const Vec2 place = a.line[i] + (*at)[0] * (a.line[i + 1] - a.line[i]);
                        const bool at_node = std::ranges::any_of(flat_.place, [&](const Vec2& node) {
                            return (node - place).norm() <= kSamePlace * base_.model.diagonal;
                        });
                        if (at_node) continue;
                        const std::size_t node = add_node(place);
                        flat_.source[a.edge].cuts.push_back(
                            {a.at[i] + (*at)[0] * (a.at[i + 1] - a.at[i]), node});
                        flat_.target[b.edge].cuts.push_back(
                            {b.at[j] + (*at)[1] * (b.at[j + 1] - b.at[j]), node});
                    }
                }
            }
        }
    }

    const OpenVolume& base_;
    const EndsMap& map_;
    std::span<const RimPair> pairs_;
    std::span<const EdgeId> inner_;
    const Reach& reach_;
    FlatEnds flat_;
    std::map<VertexId, std::size_t> node_of_;
    std::vector<std::size_t> loose_source_, loose_target_; ///< nodes that are not on the rim
};

} // namespace

FlatEdge flat_edge(const Model& model, const EndsMap& map, EdgeId id, bool target)
{
    FlatEdge flat{id, {}, geometry::arc_lengths(edge_line(model, id)), {}};
    const double length = flat.at.back();
    for (double& at : flat.at) at /= length;
    for (const Index p : model[id].points) flat.line.push_back(target ? map.target(p) : map.source(p));
    return flat;
}

FlatEnds lay_flat(const OpenVolume& base, const EndsMap& map, std::span<const RimPair> pairs,
                  std::span<const EdgeId> inner, const Reach& reach)
{
    return FlatLayer(base, map, pairs, inner, reach).run();
}

std::vector<FlatPiece> pieces_of(std::span<const FlatEdge> edges, std::span<const Vec2> place)
{
    std::vector<FlatPiece> pieces;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const FlatEdge& edge = edges[e];
        std::vector<FlatEdge::Cut> cuts = edge.cuts;
        std::ranges::stable_sort(cuts, {}, &FlatEdge::Cut::at);
        for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
            const FlatEdge::Cut &a = cuts[c], &b = cuts[c + 1];
            FlatPiece piece{e, a.at, b.at, a.node, b.node, {place[a.node]}, {a.at}};
            for (std::size_t i = 0; i < edge.line.size(); ++i) {
                if (edge.at[i] <= a.at + kRoundoff || edge.at[i] >= b.at - kRoundoff) continue;
                piece.line.push_back(edge.line[i]);
                piece.at.push_back(edge.at[i]);
            }
            piece.line.push_back(place[b.node]);
            piece.at.push_back(b.at);
            pieces.push_back(std::move(piece));
        }
    }
    return pieces;
}

bool are_one(const FlatPiece& a, const FlatPiece& b, const Reach& reach)
{
    const bool along = a.from == b.from && a.to == b.to, back = a.from == b.to && a.to == b.from;
    if (!along && !back) return false;
    const auto near = [&](const FlatPiece& p, const FlatPiece& q) {
        for (std::size_t i = 0; i + 1 < p.line.size(); ++i) {
            const Vec2 middle = (p.line[i] + p.line[i + 1]) / 2;
            for (const Vec2& x : {p.line[i], middle}) {
                if (closest_on(q.line, q.at, x).distance > reach(x)) return false;
            }
        }
        return true;
    };
    return near(a, b) && near(b, a);
}

} // namespace lacuna::surface
