// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/give_mesh.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/shared/side_points.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace lacuna::topology {

namespace {

/// A node on a loop of the face.
struct RimNode {
    Index point = -1; ///< index of a point of the model
    double at = 0;    ///< running length on the loop
};

/// A loop as one closed chain of model points.
struct LoopChain {
    std::vector<EdgeUse> uses;
    std::vector<double> start; ///< running length at the start of each use, then the total
    std::vector<Index> points; ///< the first is repeated at the end
    std::vector<double> at;    ///< running length of each point, then the total
};

LoopChain chain_of(const Model& model, const Loop& loop)
{
    LoopChain chain{loop.uses, {}, use_points(model, loop.uses), {}};
    chain.at = geometry::arc_lengths(places_at(model, chain.points));
    std::size_t first = 0;
    for (const EdgeUse& use : loop.uses) {
        chain.start.push_back(chain.at[first]);
        first += model[use.edge].points.size() - 1;
    }
    chain.start.push_back(chain.at.back());
    return chain;
}

/// A triangle repeats its last corner.
bool is_triangle(const Quad& quad) { return quad[2] == quad[3]; }

/// The boundary cycles of the quads, with the quads on the left.
std::vector<std::vector<Index>> cycles_of(std::span<const Quad> quads)
{
    std::unordered_map<std::uint64_t, int> uses;
    for (const Quad& q : quads) {
        for (std::size_t k = 0; k < 4; ++k)
            if (q[k] != q[(k + 1) % 4]) ++uses[edge_key(q[k], q[(k + 1) % 4])];
    }
    std::map<Index, Index> next;
    for (const Quad& q : quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            const Index a = q[k], b = q[(k + 1) % 4];
            if (a == b) continue;
            if (uses.at(edge_key(a, b)) == 1 && !next.emplace(a, b).second) return {};
        }
    }
    std::vector<std::vector<Index>> cycles;
    while (!next.empty()) {
        std::vector<Index>& cycle = cycles.emplace_back();
        for (Index n = next.begin()->first; !next.empty();) {
            const auto found = next.find(n);
            if (found == next.end()) break;
            cycle.push_back(n);
            n = found->second;
            next.erase(found);
        }
    }
    return cycles;
}

/// The closest position on a chain to a point.
struct Nearest {
    double at = 0, distance = kInfinity;
};
Nearest nearest_on(const Model& model, std::span<const Index> points, std::span<const double> at,
                   const Vec3& p, double from = 0)
{
    Nearest best;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        if (at[i + 1] < from) continue;
        const Vec3 &a = model.at(points[i]), &b = model.at(points[i + 1]);
        const double f = fraction_along(p, a, b);
        const double distance = (p - ((1 - f) * a + f * b)).norm();
        if (distance < best.distance) best = {at[i] + f * (at[i + 1] - at[i]), distance};
    }
    return best;
}

/// Replaces the points of edges by given nodes: facets are split at the nodes, and the edges' old inner
/// points move to the nearest node.
class EdgeRemesher {
public:
    /// @param given  the model before any change.
    EdgeRemesher(const Model& given, ModelBuilder& model) : given_(given), model_(model) {}

    /// @param at     running lengths of the edge's points.
    /// @param nodes  nodes on the edge, in ascending order of their running lengths, both ends included. On a
    ///               closed edge they may start anywhere.
    void add(EdgeId id, const std::vector<double>& at, const std::vector<RimNode>& nodes)
    {
        const std::vector<Index>& old = model_[id].points;
        // Inner nodes go between the old points; the end nodes replace the vertices.
        move_.insert_or_assign(old.front(), nodes.front().point);
        move_.insert_or_assign(old.back(), nodes.back().point);
        Chain made{id, {old.front()}, {}};
        std::size_t node = 1;
        for (std::size_t i = 0; i + 1 < old.size(); ++i) {
            std::vector<Index> between;
            const bool last = i + 2 == old.size();
            while (node + 1 < nodes.size() && (nodes[node].at < at[i + 1] || last))
                between.push_back(nodes[node++].point);
            made.points.insert(made.points.end(), between.begin(), between.end());
            made.points.push_back(old[i + 1]);
            if (!between.empty()) sides_.add(old[i], old[i + 1], std::move(between));
        }
        for (std::size_t i = 1; i + 1 < old.size(); ++i) {
            const auto nearest = std::ranges::min_element(
                nodes, {}, [&](const RimNode& n) { return std::abs(n.at - at[i]); });
            move_.insert_or_assign(old[i], nearest->point);
        }
        for (const RimNode& n : nodes) made.kept.push_back(n.point);
        chains_.push_back(std::move(made));
    }

    [[nodiscard]] std::span<const FaceUse> users(EdgeId edge) const { return given_.uses_of_edge(edge); }

    /// Whether an edge is used twice by one face, or by no face.
    [[nodiscard]] bool is_seam(EdgeId edge) const
    {
        const std::span<const FaceUse> uses = users(edge);
        return uses.empty() || (uses.size() == 2 && uses[0].face == uses[1].face);
    }

    /// @param replaced  a face whose facets the caller replaces; invalid for none.
    /// @return  the new model.
    Model apply(FaceId replaced)
    {
        std::vector<FaceId> collapsed; // faces that lost facets
        for (const FaceId f : all_faces(model_)) {
            if (f == replaced) continue;
            Face& face = model_[f];
            if (face.given_quads.empty() && !sides_.empty()) cut_at_sides(model_.points, face, sides_);
            if (move(face)) collapsed.push_back(f);
        }
        for (const Chain& chain : chains_) {
            Edge& edge = model_[chain.edge];
            edge.points = chain.kept;
            edge.params.clear();
            edge.curve = nullptr;
            edge.keeps_nodes = true;
        }
        for (Edge& edge : model_.edges) {
            edge.points.front() = moved(edge.points.front());
            edge.points.back() = moved(edge.points.back());
        }
        for (Vertex& vertex : model_.vertices) vertex.point = moved(vertex.point);
        for (std::size_t e = 0; e < model_.edges.size(); ++e) drop_folded(EdgeId(e));
        for (const FaceId f : collapsed) drop_bubbles(model_[f]);
        for (std::size_t f = 0; f < model_.faces.size(); ++f)
            if (FaceId(f) != replaced && model_.faces[f].triangles.empty())
                throw InvalidInput(Message("topology.face_vanishes",
                                           "{} has no area left between the nodes on its edges",
                                           entity_of(given_, FaceId(f)))
                                       .remedy("use a smaller 'size'"));
        // Drop points that are no longer used, and removed seams.
        ModelBuilder whole(extract(model_, all_faces(model_)));
        whole.notes = given_.notes;
        return std::move(whole).finish();
    }

private:
    /// An edge before and after the change.
    struct Chain {
        EdgeId edge;
        std::vector<Index> points; ///< old points and nodes, in the edge's direction
        std::vector<Index> kept;   ///< nodes, including the vertices'
    };

    [[nodiscard]] Index moved(Index point) const
    {
        const auto found = move_.find(point);
        return found == move_.end() ? point : found->second;
    }

    /// Remove facets that have collapsed onto an edge: their corners are three successive points of the edge.
    /// The middle point is removed with them. This is done only if there is one such facet for each use of
    /// the edge.
    void drop_folded(EdgeId id)
    {
        std::vector<Index>& points = model_[id].points;
        for (std::size_t i = 1; i + 1 < points.size();) {
            const auto is_folded = [&](const Triangle& t) {
                const auto has = [&](Index p) { return std::find(t.begin(), t.end(), p) != t.end(); };
                return has(points[i - 1]) && has(points[i]) && has(points[i + 1]);
            };
            std::size_t folded = 0;
            std::set<FaceId> faces;
            for (const FaceUse& use : users(id)) faces.insert(use.face);
            for (const FaceId face : faces)
                folded += static_cast<std::size_t>(std::ranges::count_if(model_[face].triangles, is_folded));
            if (folded == 0 || folded != users(id).size()) {
                ++i;
                continue;
            }
            for (const FaceId face : faces)
                erase_facets(model_[face],
                             [&](std::size_t t) { return is_folded(model_[face].triangles[t]); });
            points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
            std::vector<double>& params = model_[id].params;
            if (!params.empty()) params.erase(params.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }

    /// For each facet side of a face: the difference of the surface parameters, from the point with the lower
    /// number to the point with the higher number.
    static std::unordered_map<std::uint64_t, Vec2> steps_of(const Face& face)
    {
        std::unordered_map<std::uint64_t, Vec2> steps;
        for (std::size_t t = 0; t < face.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Index a = face.triangles[t][k], b = face.triangles[t][(k + 1) % 3];
                const Vec2 step = face.uv[t][(k + 1) % 3] - face.uv[t][k];
                steps.insert_or_assign(edge_key(a, b), a < b ? step : Vec2(-step));
            }
        }
        return steps;
    }

    /// Change of the surface parameters at each point of an edge that moves to a node.
    [[nodiscard]] std::unordered_map<Index, Vec2> shifts_of(const Face& face) const
    {
        std::unordered_map<Index, Vec2> shifts;
        const auto steps = steps_of(face);
        for (const Chain& chain : chains_) {
            std::unordered_map<Index, Vec2> param{{chain.points.front(), Vec2::Zero()}};
            Vec2 last = Vec2::Zero();
            bool known = true;
            for (std::size_t i = 0; known && i + 1 < chain.points.size(); ++i) {
                const Index a = chain.points[i], b = chain.points[i + 1];
                const auto found = steps.find(edge_key(a, b));
                known = found != steps.end();
                if (known) last += a < b ? found->second : Vec2(-found->second);
                param.emplace(b, last);
            }
            if (!known) continue; // an edge of other faces
            for (const Index point : chain.points) {
                const auto to = param.find(moved(point));
                if (to == param.end()) continue;
                const Vec2 own = param.at(point), shift = to->second - own;
                // The vertex of a closed edge has two positions along the edge: its start and its end. Their
                // surface parameters may differ by a period. Use the position that is nearer to the point.
                const bool closing = to->first == chain.points.back() && (last - own).norm() < shift.norm();
                shifts.insert_or_assign(point, closing ? Vec2(last - own) : shift);
            }
        }
        return shifts;
    }

    /// @return  whether facets were erased, because their corners became one
    bool move(Face& face) const
    {
        std::unordered_map<Index, Vec2> shifts;
        if (!face.uv.empty()) shifts = shifts_of(face);
        for (std::size_t t = 0; t < face.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                Index& corner = face.triangles[t][k];
                if (const auto found = shifts.find(corner); found != shifts.end())
                    face.uv[t][k] += found->second;
                corner = moved(corner);
            }
        }
        for (Quad& quad : face.given_quads) {
            for (Index& n : quad) n = moved(n);
        }
        return erase_facets(face, [&](std::size_t t) { return repeats(face.triangles[t]); });
    }

    /// Remove bubbles: facets between two sides that became one, because their points became one. A bubble
    /// is connected to other facets over sides with more than two facets only.
    static void drop_bubbles(Face& face)
    {
        std::map<std::uint64_t, std::vector<std::size_t>> on;
        for (std::size_t t = 0; t < face.triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                on[edge_key(face.triangles[t][k], face.triangles[t][(k + 1) % 3])].push_back(t);
        const auto is_pinched = [](const auto& side) { return side.second.size() > 2; };
        if (std::ranges::none_of(on, is_pinched)) return;
        geometry::UnionFind parts(face.triangles.size());
        for (const auto& side : on)
            if (side.second.size() == 2) parts.unite_least(side.second[0], side.second[1]);
        std::set<std::size_t> with_border;
        for (const auto& side : on)
            if (side.second.size() == 1) with_border.insert(parts.find(side.second.front()));
        if (with_border.empty()) return; // a closed face
        erase_facets(face, [&](std::size_t t) { return !with_border.contains(parts.find(t)); });
    }

    const Model& given_;
    ModelBuilder& model_;
    SidePoints sides_;
    std::unordered_map<Index, Index> move_; ///< old edge points to nodes
    std::vector<Chain> chains_;
};

class MeshGiver {
public:
    MeshGiver(const Model& model, FaceId face, std::span<const Vec3> nodes, std::span<const Quad> quads)
        : model_(model), remesher_(model, model_), face_(face), quads_(quads.begin(), quads.end())
    {
        const auto first = static_cast<Index>(model_.points.size());
        model_.points.insert(model_.points.end(), nodes.begin(), nodes.end());
        for (Quad& quad : quads_) {
            for (Index& n : quad) n += first;
        }
    }

    Model run()
    {
        const std::vector<Loop> loops = border_loops(model_, face_);
        for (const Loop& loop : loops) chains_.push_back(chain_of(model_, loop));
        place_rims();
        count_ends();
        for (std::size_t l = 0; l < chains_.size(); ++l) take_rim(chains_[l], rims_[l]);
        set_face(loops);
        return remesher_.apply(face_);
    }

private:
    template <class... Arguments>
    [[noreturn]] static void refuse(Format<sizeof...(Arguments)> format, const Arguments&... arguments)
    {
        throw InvalidInput("topology.mesh_unlike_face", format, arguments...);
    }

    /// Place the rim's nodes on each loop, in the loop's direction.
    void place_rims()
    {
        std::vector<std::vector<Index>> cycles = cycles_of(quads_);
        if (cycles.size() != chains_.size()) {
            refuse("the mesh for {} has {} rims and the face has {} loops", entity_of(model_, face_),
                   found(cycles.size()), needed(chains_.size()));
        }
        rims_.resize(chains_.size());
        int turned = 0;
        for (const std::vector<Index>& cycle : cycles) {
            std::size_t best = 0;
            double least = kInfinity;
            for (std::size_t l = 0; l < chains_.size(); ++l) {
                double off = 0;
                for (const Index n : cycle)
                    off += nearest_on(model_, chains_[l].points, chains_[l].at, model_.at(n)).distance;
                if (off < least) {
                    least = off;
                    best = l;
                }
            }
            if (!rims_[best].empty())
                refuse("two rims of the mesh for {} lie on the same loop of the face",
                       entity_of(model_, face_));
            rims_[best] = place_rim(cycle, chains_[best]);
            turned += is_turned(rims_[best], chains_[best].start.back()) ? 1 : 0;
        }
        if (turned != 0 && turned != static_cast<int>(cycles.size()))
            throw InvalidInput(Message("topology.mesh_unlike_face",
                                       "some rims of the mesh for {} run with the loops of the face, and "
                                       "others against them",
                                       entity_of(model_, face_))
                                   .remedy("orient all quads alike"));
        if (turned == 0) return;
        for (Quad& quad : quads_) std::swap(quad[is_triangle(quad) ? 0 : 3], quad[1]);
        for (std::vector<RimNode>& rim : rims_) std::reverse(rim.begin(), rim.end());
    }

    [[nodiscard]] std::vector<RimNode> place_rim(const std::vector<Index>& cycle,
                                                 const LoopChain& chain) const
    {
        std::vector<RimNode> rim;
        for (std::size_t i = 0; i < cycle.size(); ++i) {
            const Vec3& p = model_.at(cycle[i]);
            const double side = std::max(
                (model_.at(cycle[(i + 1) % cycle.size()]) - p).norm(),
                (model_.at(cycle[(i + cycle.size() - 1) % cycle.size()]) - p).norm());
            const Nearest place = nearest_on(model_, chain.points, chain.at, p);
            if (place.distance > std::max(model_.tolerance, kOnePoint * side)) {
                refuse("a node of the mesh for {} is {:.3g} away from the face's loops",
                       entity_of(model_, face_), found(place.distance));
            }
            rim.push_back({cycle[i], place.at});
        }
        return rim;
    }

    /// Whether most nodes follow each other against the direction of their loop.
    static bool is_turned(const std::vector<RimNode>& rim, double length)
    {
        int steps = 0;
        for (std::size_t i = 0; i < rim.size(); ++i) {
            const double step = std::remainder(rim[(i + 1) % rim.size()].at - rim[i].at, length);
            steps += step > 0 ? 1 : -1;
        }
        return steps < 0;
    }

    /// Number of edge ends at each vertex, without seams.
    void count_ends()
    {
        ends_.assign(model_.vertices.size(), 0);
        for (std::size_t e = 0; e < model_.edges.size(); ++e) {
            if (remesher_.is_seam(EdgeId(e))) continue;
            ++ends_[model_.edges[e].from.index()];
            ++ends_[model_.edges[e].to.index()];
        }
    }

    /// The rim node to which a vertex moves: the nearest one.
    /// @throw InvalidInput  the vertex would have to move, but edges of other faces end at it.
    std::size_t node_at(VertexId vertex, double at, const std::vector<RimNode>& rim, double length)
    {
        const Vec3& place = model_.at(model_[vertex].point);
        std::size_t best = 0;
        for (std::size_t i = 1; i < rim.size(); ++i) {
            if (std::abs(std::remainder(rim[i].at - at, length)) <
                std::abs(std::remainder(rim[best].at - at, length)))
                best = i;
        }
        const double off = (model_.at(rim[best].point) - place).norm();
        // Two edge ends at a vertex belong to the loop, or to a closed edge. Further ones are edges of other
        // faces.
        if (off > model_.tolerance && ends_[vertex.index()] > 2) {
            throw InvalidInput("topology.mesh_misses_vertex",
                               "the mesh for {} has no node at {}, where edges of other faces end; its "
                               "nearest node is {:.3g} away",
                               entity_of(model_, face_), entity_of(model_, vertex), found(off));
        }
        return best;
    }

    /// Put the rim's nodes on the edges of a loop. The old points of these edges move to the nodes.
    void take_rim(const LoopChain& chain, std::vector<RimNode>& rim)
    {
        const double length = chain.start.back();
        std::vector<std::size_t> corner;
        for (std::size_t u = 0; u < chain.uses.size(); ++u) {
            const VertexId vertex = use_from(model_, chain.uses[u]);
            corner.push_back(node_at(vertex, chain.start[u], rim, length));
        }
        for (std::size_t u = 0; u < corner.size(); ++u) {
            const std::size_t next = corner[(u + 1) % corner.size()];
            if (corner.size() > 1 && corner[u] == next) {
                refuse("the mesh for {} has no side on {}", entity_of(model_, face_),
                       entity_of(model_, chain.uses[u].edge));
            }
        }
        for (std::size_t u = 0; u < corner.size(); ++u) {
            // Nodes of the use, both ends included, with running lengths ascending from its start.
            std::vector<RimNode> nodes;
            const std::size_t last = corner[(u + 1) % corner.size()];
            std::size_t i = corner[u];
            double at = chain.start[u] + std::remainder(rim[i].at - chain.start[u], length);
            nodes.push_back({rim[i].point, at});
            do {
                const std::size_t next = (i + 1) % rim.size();
                at += std::remainder(rim[next].at - rim[i].at, length);
                nodes.push_back({rim[next].point, at});
                i = next;
            } while (i != last);
            for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
                if (nodes[k + 1].at > nodes[k].at) continue;
                refuse("the nodes of the mesh for {} on {} are not in the order of the edge",
                       entity_of(model_, face_), entity_of(model_, chain.uses[u].edge));
            }
            put_on_edge(chain, u, nodes);
        }
    }

    /// @param nodes  on use `u` of the chain, ends included.
    void put_on_edge(const LoopChain& chain, std::size_t u, std::vector<RimNode> nodes)
    {
        const EdgeUse use = chain.uses[u];
        const std::vector<Index>& old = model_[use.edge].points;
        check_other_meshes(use.edge, nodes);
        const std::vector<double> at = geometry::arc_lengths(places_at(model_, old));
        for (RimNode& n : nodes)
            n.at = use.reversed ? chain.start[u] + at.back() - n.at : n.at - chain.start[u];
        if (use.reversed) std::reverse(nodes.begin(), nodes.end());
        remesher_.add(use.edge, at, nodes);
    }

    /// Check that given meshes of other faces at the edge have the same nodes on it.
    void check_other_meshes(EdgeId edge, const std::vector<RimNode>& nodes) const
    {
        const std::vector<Index>& old = model_[edge].points;
        for (const FaceUse& user : remesher_.users(edge)) {
            const Face& other = model_[user.face];
            if (user.face == face_ || !other.keeps_nodes) continue;
            if (!other.given_quads.empty() && old.size() == nodes.size()) check_same_places(edge, nodes);
            if (old.size() == nodes.size()) continue;
            throw InvalidInput(Message("topology.meshes_differ",
                                       "the mesh for {} has {} nodes on {}, but the mesh of {} has {}",
                                       entity_of(model_, face_), found(nodes.size()), entity_of(model_, edge),
                                       entity_of(model_, user.face), needed(old.size()))
                                   .remedy("give both meshes the same nodes on the edge"));
        }
    }

    /// Check that no given node of an edge would move.
    void check_same_places(EdgeId edge, const std::vector<RimNode>& nodes) const
    {
        for (const Index point : model_[edge].points) {
            const auto off = [&](const RimNode& n) { return (model_.at(n.point) - model_.at(point)).norm(); };
            const double least = off(*std::ranges::min_element(nodes, {}, off));
            if (least > model_.tolerance)
                throw InvalidInput(Message("topology.meshes_differ",
                                           "the mesh for {} has no node at {} on {}, where a given quad has "
                                           "one; its nearest node is {:.3g} away",
                                           entity_of(model_, face_), place_with_digits(model_.at(point), 4),
                                           entity_of(model_, edge), found(least))
                                       .remedy("give both meshes the same nodes on the edge"));
        }
    }

    void set_face(const std::vector<Loop>& loops)
    {
        Face& face = model_[face_];
        face.triangles.clear();
        face.uv.clear();
        face.surface = nullptr;
        face.given_quads.clear();
        face.keeps_nodes = true;
        for (const Quad& q : quads_) {
            face.triangles.push_back({q[0], q[1], q[2]});
            if (is_triangle(q)) continue;
            face.given_quads.push_back(q);
            face.triangles.push_back({q[0], q[2], q[3]});
        }
        face.loops = loops;
    }

    ModelBuilder model_;
    EdgeRemesher remesher_;
    FaceId face_;
    std::vector<Quad> quads_;
    std::vector<LoopChain> chains_;
    std::vector<std::vector<RimNode>> rims_; ///< rim nodes on each loop
    std::vector<int> ends_;                  ///< edge ends at each vertex, without seams
};

} // namespace

std::set<EdgeId> kept_edges(const Model& model)
{
    std::vector<FaceId> faces = all_faces(model);
    std::erase_if(faces, [&](FaceId face) { return !model[face].keeps_nodes; });
    std::set<EdgeId> edges = edges_of(model, faces);
    for (std::size_t e = 0; e < model.edges.size(); ++e)
        if (model.edges[e].keeps_nodes) edges.emplace(e);
    return edges;
}

void give_edge_nodes(OpenVolume& volume, std::span<const EdgeNodes> edges)
{
    ModelBuilder model(volume.model);
    EdgeRemesher remesher(volume.model, model);
    for (const EdgeNodes& given : edges) {
        const std::vector<Index>& old = model[given.edge].points;
        const std::vector<double> at = geometry::arc_lengths(places_at(model, old));
        const bool closed = old.front() == old.back();
        const NamedEntity edge = entity_of(model, given.edge);
        const std::size_t least = closed ? 4 : 2;
        if (given.nodes.size() < least)
            throw InvalidInput(Message("topology.nodes_off_edge",
                                       "there are too few nodes for {}: {}, but {} are needed", edge,
                                       found(given.nodes.size()), needed(least))
                                   .remedy("use a smaller 'size', or give this edge 'intervals'"));
        std::vector<RimNode> nodes;
        double last = 0;
        for (std::size_t i = 0; i < given.nodes.size(); ++i) {
            const bool end = i + 1 == given.nodes.size();
            Nearest place{end ? at.back() : 0.0, 0};
            if (i > 0 && !end) place = nearest_on(model, old, at, given.nodes[i], last);
            if (i > 0 && place.at <= last)
                throw InvalidInput(Message("topology.nodes_off_edge",
                                           "the nodes for {} are not in order along the edge", edge)
                                       .remedy("use a smaller 'size', or give this edge other 'intervals'"));
            last = place.at;
            // The end nodes use the points of the vertices, and these points move to the nodes' positions.
            const Index point = i == 0 ? old.front()
                                : end  ? old.back()
                                       : static_cast<Index>(model.points.size());
            if (i == 0 || end)
                model.points[index(point)] = given.nodes[i];
            else
                model.points.push_back(given.nodes[i]);
            nodes.push_back({point, place.at});
        }
        remesher.add(given.edge, at, nodes);
    }
    volume.model = remesher.apply(FaceId());
}

void give_mesh(OpenVolume& volume, FaceId face, std::span<const Vec3> nodes, std::span<const Quad> quads)
{
    volume.model = MeshGiver(volume.model, face, nodes, quads).run();
}

} // namespace lacuna::topology
