// SPDX-License-Identifier: MIT
#include <lacuna/surface/walls.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/facet_tree.h>
#include <lacuna/geometry/harmonic.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/polyline.h>
#include <lacuna/geometry/swept_patch.h>
#include <lacuna/geometry/transfinite.h>
#include <lacuna/surface/detail/chain_nodes.h>
#include <lacuna/surface/detail/follow_rows.h>
#include <lacuna/surface/detail/wall_net.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>

namespace lacuna::surface {

using namespace topology;

namespace {

/// A patch this far from its face, as a share of the shorter rim, is no guide to where nodes belong on it. A
/// choice, not a measurement.
constexpr double kFarFromPatch = 0.05;

/// The faces of the segment of walls after each side line.
std::vector<std::vector<FaceId>> panel_faces(const Model& model, const LinkingSurface& link)
{
    std::set<EdgeId> borders;
    for (const LinkingLine& line : link.lines) {
        for (const EdgeUse& use : line.line.uses) borders.insert(use.edge);
    }
    const auto uses = edge_uses(model);
    const std::set<FaceId> walls(link.walls.begin(), link.walls.end());
    std::vector<std::vector<FaceId>> panels;
    for (const LinkingLine& line : link.lines) {
        const EdgeUse foot =
            link.source.uses()[link.source.position(line.source_at + 1e-9 * link.source.length()).use];
        std::vector<FaceId> faces;
        for (const FaceUse& use : uses[foot.edge.index()]) {
            if (walls.contains(use.face)) faces.push_back(use.face);
        }
        for (std::size_t i = 0; i < faces.size(); ++i) {
            for (const Loop& loop : model[faces[i]].loops) {
                for (const EdgeUse& use : loop.uses) {
                    if (borders.contains(use.edge)) continue;
                    for (const FaceUse& other : uses[use.edge.index()]) {
                        const bool known = std::find(faces.begin(), faces.end(), other.face) != faces.end();
                        if (!known && walls.contains(other.face)) faces.push_back(other.face);
                    }
                }
            }
        }
        panels.push_back(std::move(faces));
    }
    return panels;
}

/// One linking surface being meshed.
class WallMesher {
public:
    WallMesher(const OpenVolume& volume, const LinkingSurface& link, const LinkingNodes& nodes,
               const GivenColumns& columns, std::span<const double> heights, bool exact,
               const RunContext& context)
        : volume_(volume),
          model_(volume.model),
          link_(link),
          nodes_(nodes),
          heights_(heights.begin(), heights.end()),
          exact_(exact),
          context_(context),
          count_(nodes.source_at.size()),
          layers_(heights.size() - 1),
          given_node_(count_ * (layers_ + 1), kNotGiven),
          given_side_(count_ * layers_, 0),
          line_of_(count_, -1)
    {
        mesh_.points.resize(count_ * (layers_ + 1));
        mesh_.face.resize(count_ * layers_);
        for (std::size_t i = 0; i < nodes.line.size(); ++i) line_of_[nodes.line[i]] = static_cast<int>(i);
        take_columns(columns);
    }

    WallMesh run()
    {
        const bool has_given = std::any_of(given_side_.begin(), given_side_.end(),
                                           [](char given) { return given != 0; });
        if (!has_given) return mesh(true);
        const WallMesh before = mesh_;
        try {
            return mesh(true);
        } catch (const NotSweepable& error) {
            if (error.code() != "surface.wall_edge") throw;
        }
        // Given nodes leave no column for an edge between void faces: these are not followed.
        mesh_ = before;
        map_.reset();
        followed_.clear();
        net_ = {};
        level_layer_.clear();
        on_edge_.clear();
        WallMesh result = mesh(false);
        result.notes.emplace_back("edges between void faces are no columns and layers of the mesh, because "
                                  "the nodes that the walls came with leave none for them");
        return result;
    }

    [[nodiscard]] const std::vector<FollowedPanel>& followed() const { return followed_; }

private:
    WallMesh mesh(bool void_edges)
    {
        set_row(0, link_.source.points(nodes_.source_at));
        set_row(layers_, link_.target.points(wrapped(nodes_.target_at, link_.target.length())));
        if (std::all_of(given_side_.begin(), given_side_.end(), [](char given) { return given != 0; }))
            return std::move(mesh_);
        const auto panels = panel_faces(model_, link_);
        const bool simple = !panels.empty() &&
                            std::all_of(panels.begin(), panels.end(),
                                        [&](const auto& faces) { return is_simple(faces); });
        if (!simple) {
            map_ = std::make_unique<LinkingMap>(volume_, link_, void_edges, context_);
            net_ = wall_net(model_, link_, *map_);
            plan_levels();
        }
        lay_grid();
        mesh_lines();
        if (panels.empty()) mesh_by_map(0, count_);
        for (std::size_t i = 0; i < panels.size(); ++i) {
            const std::size_t first = nodes_.line[i];
            const std::size_t last = i + 1 < panels.size() ? nodes_.line[i + 1] : count_;
            if (are_given(first, last)) continue;
            if (follows(panels[i])) {
                followed_.push_back({0, first, last, panels[i].front()});
                set_faces(panels[i].front(), first, last);
                continue;
            }
            if (is_simple(panels[i]) && mesh_transfinite(panels[i].front(), first, last)) continue;
            if (map_ == nullptr) {
                map_ = std::make_unique<LinkingMap>(volume_, link_, true, context_);
                lay_grid();
            }
            mesh_by_map(first, last);
        }
        check_stops();
        return std::move(mesh_);
    }

    static std::vector<double> wrapped(std::vector<double> at, double length)
    {
        for (double& x : at) x = x >= length ? x - length : x;
        return at;
    }

    /// Given nodes that start at one node of the rim and lead away from it.
    struct GivenWay {
        std::size_t node;
        const std::vector<Index>* points;
        const std::vector<FaceId>* faces;
    };

    /// Take the nodes of columns and stubs as they are.
    void take_columns(const GivenColumns& columns)
    {
        std::vector<GivenWay> up, from_source, from_target;
        if (columns.rows == static_cast<int>(layers_)) {
            for (std::size_t c = 0; c < columns.source_at.size(); ++c)
                add_way(columns.source_at[c], false, columns.points[c], columns.faces[c], up);
        }
        for (const GivenStub& stub : columns.stubs) {
            std::vector<GivenWay>& ways = stub.from_target ? from_target : from_source;
            const bool beside = !ways.empty() && !ways.back().faces->empty();
            const std::size_t before = ways.empty() ? 0 : ways.back().node;
            if (!add_way(stub.at, stub.from_target, stub.points, stub.faces, ways)) refuse_stub(stub);
            // An odd rim has one node more on a side. Others are the opposite end's.
            if (beside && (ways.back().node + count_ - before) % count_ > 2) refuse_stub(stub);
        }
        take_ways(up, false);
        take_ways(from_source, false);
        take_ways(from_target, true);
    }

    /// @return  false where the rim has no node there.
    bool add_way(double at, bool from_target, const std::vector<Index>& points,
                 const std::vector<FaceId>& faces, std::vector<GivenWay>& ways) const
    {
        const double length = from_target ? link_.target.length() : link_.source.length();
        const std::vector<double>& nodes = from_target ? nodes_.target_at : nodes_.source_at;
        const double slack = kSamePlace * length;
        const auto off = [&](double node) { return std::abs(std::remainder(node - at, length)); };
        // Nodes rise from the first; the target's may run past its end.
        const double start = nodes.front(), from = at + (at < start - slack ? length : 0);
        auto found = std::lower_bound(nodes.begin(), nodes.end(), from - slack);
        if (found == nodes.end()) found = nodes.begin();
        if (off(*found) > slack) return false;
        ways.push_back({static_cast<std::size_t>(found - nodes.begin()), &points, &faces});
        return true;
    }

    [[noreturn]] void refuse_stub(const GivenStub& stub) const
    {
        const std::string rim = stub.from_target ? "target" : "source";
        throw NotSweepable("surface.wall_rows",
                           name_of(model_, stub.wall) + " came with quads on the " + rim +
                               "'s rim, and the other rim came with other nodes between the same corners; "
                               "mesh both alike, or load one with keep_mesh = false");
    }

    void take_ways(const std::vector<GivenWay>& ways, bool from_target)
    {
        const auto layer = [&](std::size_t k) { return from_target ? layers_ - k : k; };
        for (std::size_t w = 0; w < ways.size(); ++w) {
            const GivenWay &way = ways[w], &next = ways[(w + 1) % ways.size()];
            for (std::size_t k = 0; k < way.points->size(); ++k) {
                given_node_[layer(k) * count_ + way.node] = (*way.points)[k];
                point(layer(k), way.node) = model_.at((*way.points)[k]);
            }
            const std::size_t end = next.node > way.node ? next.node : next.node + count_;
            for (std::size_t i = way.node; i < end && !way.faces->empty(); ++i) {
                // Nodes between divide the quads: an odd rim was given one more.
                const double share = static_cast<double>(i - way.node) / static_cast<double>(end - way.node);
                for (std::size_t k = 0; k < way.faces->size(); ++k) {
                    const std::size_t low = std::min(layer(k), layer(k + 1));
                    mesh_.face[low * count_ + i % count_] = (*way.faces)[k];
                    given_side_[low * count_ + i % count_] = 1;
                }
                for (std::size_t k = 0; k <= way.faces->size() && i > way.node; ++k) {
                    given_node_[layer(k) * count_ + i % count_] = kBetweenGiven;
                    point(layer(k), i) = (1 - share) * model_.at((*way.points)[k]) +
                                         share * model_.at((*next.points)[k]);
                }
            }
        }
    }

    [[nodiscard]] bool is_given(std::size_t layer, std::size_t node) const
    {
        return given_node_[layer * count_ + node % count_] != kNotGiven;
    }

    /// Whether all quads between two nodes of the rim are given.
    [[nodiscard]] bool are_given(std::size_t first, std::size_t last) const
    {
        for (std::size_t k = 0; k < layers_; ++k) {
            const auto row = given_side_.begin() + static_cast<std::ptrdiff_t>(k * count_);
            if (!std::all_of(row + static_cast<std::ptrdiff_t>(first),
                             row + static_cast<std::ptrdiff_t>(last), [](char given) { return given != 0; }))
                return false;
        }
        return true;
    }

    [[nodiscard]] Vec3& point(std::size_t layer, std::size_t node)
    {
        return mesh_.points[layer * count_ + node % count_];
    }

    void set_row(std::size_t layer, const std::vector<Vec3>& points)
    {
        for (std::size_t i = 0; i < count_; ++i) point(layer, i) = points[i];
    }

    [[nodiscard]] bool follows(const std::vector<FaceId>& faces) const
    {
        return is_simple(faces) && model_[faces.front()].geometry == Geometry::followed;
    }

    void set_faces(FaceId face, std::size_t first, std::size_t last)
    {
        for (std::size_t k = 0; k < layers_; ++k) {
            for (std::size_t i = first; i < last; ++i) mesh_.face[k * count_ + i] = face;
        }
    }

    [[nodiscard]] bool is_simple(const std::vector<FaceId>& faces) const
    {
        return faces.size() == 1 && model_[faces.front()].loops.size() == 1;
    }

    /// Give each level the layer nearest to it that leaves one for all others above and below it.
    void plan_levels()
    {
        const auto layers = static_cast<int>(layers_);
        const std::size_t count = net_.levels.size();
        std::vector<std::vector<std::size_t>> below(count);
        std::vector<int> above(count, 0), depth(count, 0);
        for (std::size_t a = 0; a < count; ++a) {
            for (std::size_t b = a + 1; b < count; ++b) {
                if (net_.over_each_other(*map_, a, b)) below[b].push_back(a);
            }
        }
        int most = 0;
        for (std::size_t b = 0; b < count; ++b) {
            for (const std::size_t a : below[b]) depth[b] = std::max(depth[b], depth[a] + 1);
            most = std::max(most, depth[b] + 1);
        }
        for (std::size_t b = count; b-- > 0;) {
            for (const std::size_t a : below[b]) above[a] = std::max(above[a], above[b] + 1);
        }
        if (most >= layers) {
            throw NotSweepable("surface.too_few_layers",
                               name_of(model_, net_.levels.front().edge) +
                                   " runs round the walls between source and target, as do edges at " +
                                   std::to_string(most) + " heights in all; each needs a layer to lie on, " +
                                   "which takes layers = " + std::to_string(most + 1) + " or more, and " +
                                   std::to_string(layers) + " are asked for");
        }
        for (std::size_t r = 0; r < count; ++r) {
            int nearest = 1, lowest = 1;
            for (int k = 1; k < layers; ++k) {
                if (std::abs(heights_[static_cast<std::size_t>(k)] - net_.levels[r].height) <
                    std::abs(heights_[static_cast<std::size_t>(nearest)] - net_.levels[r].height))
                    nearest = k;
            }
            for (const std::size_t a : below[r]) lowest = std::max(lowest, level_layer_[a] + 1);
            level_layer_.push_back(std::min(std::max(nearest, lowest), layers - 1 - above[r]));
        }
    }

    /// Columns of given nodes do not move: what turns or ends between them is refused.
    void check_stops()
    {
        if (net_.stops.empty()) return;
        const std::vector<std::size_t> node = nodes_of_columns();
        for (const WallNet::Stop& stop : net_.stops) {
            const Vec3& at = model_.at(model_[stop.vertex].point);
            if ((point(layer_of(stop), node[stop.column]) - at).norm() <= model_.tolerance) continue;
            refuse_wall_edge(model_, net_.columns[stop.column].edge,
                             "turns or ends at " + name_of(model_, stop.vertex) +
                                 ", where the nodes that the walls or ends came with leave no column; load "
                                 "with keep_mesh = false, or join the two faces to one");
        }
    }

    /// Heights of a column's nodes: the layers', drawn to the rings it crosses.
    [[nodiscard]] std::vector<double> column_heights(const std::map<int, double>& at_layer) const
    {
        std::vector<std::pair<double, double>> knots{{0, 0}};
        for (const auto& [layer, t] : at_layer) {
            if (t > knots.back().second && t < 1)
                knots.emplace_back(heights_[static_cast<std::size_t>(layer)], t);
        }
        knots.emplace_back(1, 1);
        std::vector<double> result;
        std::size_t k = 0;
        for (const double h : heights_) {
            while (k + 2 < knots.size() && h > knots[k + 1].first) ++k;
            const auto& [h0, t0] = knots[k];
            const auto& [h1, t1] = knots[k + 1];
            result.push_back(t0 + (h - h0) / (h1 - h0) * (t1 - t0));
        }
        return result;
    }

    /// The same in the map's own t: without rings to meet, evenly up the walls.
    [[nodiscard]] std::vector<double> map_heights(const std::map<int, double>& at_layer) const
    {
        std::vector<double> at = column_heights(at_layer);
        if (!at_layer.empty()) return at;
        for (double& t : at) t = map_->from_even(t);
        return at;
    }

    /// Where plain rings cross a column, by their layers.
    [[nodiscard]] std::map<int, LinkingMap::Crossing> crossings_at(double s) const
    {
        std::map<int, LinkingMap::Crossing> at_layer;
        for (std::size_t r = 0; r < level_layer_.size(); ++r) {
            if (!net_.levels[r].plain) continue;
            const LinkingMap::Ring& ring = map_->rings()[*net_.levels[r].ring];
            for (const LinkingMap::Crossing& crossing : LinkingMap::crossings(ring, s)) {
                const auto [found, fresh] = at_layer.try_emplace(level_layer_[r], crossing);
                if (!fresh && std::abs(crossing.t - ring.height) < std::abs(found->second.t - ring.height))
                    found->second = crossing;
            }
        }
        return at_layer;
    }

    /// Heights of a side line's nodes, drawn to where plain rings meet it.
    [[nodiscard]] std::vector<double> line_heights(const Chain& chain) const
    {
        std::map<int, double> at_layer;
        for (std::size_t u = 1; u < chain.uses().size(); ++u) {
            const VertexId v = use_from(model_, chain.uses()[u]);
            for (std::size_t r = 0; r < level_layer_.size(); ++r) {
                if (!net_.levels[r].plain) continue;
                const auto& vertices = map_->rings()[*net_.levels[r].ring].vertices;
                if (std::find(vertices.begin(), vertices.end(), v) != vertices.end())
                    at_layer[level_layer_[r]] = chain.start(u) / chain.length();
            }
        }
        return column_heights(at_layer);
    }

    /// Where each node lies in the strip: columns upright and layers as the plain rings draw them, then moved
    /// so that the net's nodes lie on it.
    void lay_grid()
    {
        place_.assign(count_ * (layers_ + 1), Vec2::Zero());
        for (std::size_t i = 0; i < count_; ++i) {
            std::vector<double> at = heights_;
            const double s = nodes_.source_at[i] / link_.source.length();
            if (line_of_[i] >= 0) {
                const LinkingLine& line = link_.lines[static_cast<std::size_t>(line_of_[i])];
                at = line_heights(Chain(model_, line.line.uses));
            } else if (map_ != nullptr) {
                std::map<int, double> at_layer;
                for (const auto& [layer, crossing] : crossings_at(s)) {
                    at_layer[layer] = crossing.t;
                    on_edge_[static_cast<std::size_t>(layer) * count_ + i] = {crossing.edge, crossing.at,
                                                                              Vec2(s, crossing.t)};
                }
                at = map_heights(at_layer);
            }
            for (std::size_t k = 0; k <= layers_; ++k) place_[k * count_ + i] = Vec2(s, at[k]);
        }
        const bool given = std::any_of(given_side_.begin(), given_side_.end(),
                                       [](char side) { return side != 0; });
        if (map_ != nullptr && (given || !net_.stops.empty())) follow_net();
    }

    // --- the net -------------------------------------------------------------------------------------

    /// The node of each column of the net.
    [[nodiscard]] std::vector<std::size_t> nodes_of_columns() const
    {
        std::vector<std::size_t> node;
        for (const WallNet::Column& column : net_.columns) {
            std::size_t nearest = 0;
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < count_; ++i) {
                const double to = column.target_at
                                      ? wrapped({nodes_.target_at[i]}, link_.target.length())[0] -
                                            *column.target_at
                                      : 0;
                const double off = column.target_at && !column.source_at
                                       ? std::abs(std::remainder(to / link_.target.length(), 1.0))
                                       : std::abs(std::remainder(
                                             nodes_.source_at[i] / link_.source.length() - column.at, 1.0));
                if (off >= least) continue;
                least = off;
                nearest = i;
            }
            node.push_back(column.line ? nodes_.line[*column.line] : nearest);
        }
        for (std::size_t a = 0; a < node.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                const WallNet::Column &p = net_.columns[a], &q = net_.columns[b];
                if (node[a] != node[b] || p.high < q.low || q.high < p.low) continue;
                refuse_wall_edge(model_, q.line ? p.edge : q.edge,
                                 "and " + name_of(model_, q.line ? q.edge : p.edge) +
                                     " want the same column of nodes; ask for a smaller size");
            }
        }
        return node;
    }

    [[nodiscard]] std::size_t layer_of(const WallNet::Stop& stop) const
    {
        if (stop.level == WallNet::kSource) return 0;
        if (stop.level == WallNet::kTarget) return layers_;
        return static_cast<std::size_t>(level_layer_[static_cast<std::size_t>(stop.level)]);
    }

    /// Put a node on an edge.
    void pin(std::size_t node, std::size_t layer, EdgeId edge, double share, const Vec2& place)
    {
        if (layer == 0 || layer == layers_) return;
        on_edge_[layer * count_ + node % count_] = {edge, share, place};
    }

    void pin_long_edges(const std::vector<std::size_t>& column_node)
    {
        for (const WallNet::LongEdge& edge : net_.long_edges) {
            const WallNet::Stop &low = net_.stops[edge.low], &high = net_.stops[edge.high];
            const std::size_t from = layer_of(low), to = layer_of(high);
            if (from >= to) {
                refuse_wall_edge(model_, edge.upright->edge,
                                 "runs up the walls past other edges in another order than the layers; ask "
                                 "for more layers");
            }
            for (std::size_t k = from; k <= to; ++k) {
                double f = (heights_[k] - heights_[from]) / (heights_[to] - heights_[from]);
                if (edge.reversed) f = 1 - f;
                pin(column_node[low.column], k, edge.upright->edge, f,
                    place_on(edge.upright->pieces, edge.upright->edge, f));
            }
        }
    }

    /// The place in the strip of a share of an edge.
    static Vec2 place_on(const std::vector<LinkingMap::Piece>& pieces, EdgeId edge, double share)
    {
        constexpr double kSlack = 1e-9; ///< of the edge: rounding
        for (const LinkingMap::Piece& piece : pieces) {
            const double low = std::min(piece.from, piece.to), high = std::max(piece.from, piece.to);
            if (piece.edge != edge || share < low - kSlack || share > high + kSlack) continue;
            const double f = high > low ? (share - piece.from) / (piece.to - piece.from) : 0;
            return piece.a + f * (piece.b - piece.a);
        }
        return pieces.front().a;
    }

    /// Nodes between the stops of a level lie on its edges, at even steps of the columns.
    void pin_level(std::size_t number, const std::vector<std::size_t>& column_node)
    {
        const WallNet::Level& level = net_.levels[number];
        const auto layer = static_cast<std::size_t>(level_layer_[number]);
        if (!level.ring || level.plain) return;
        const LinkingMap::Ring& ring = map_->rings()[*level.ring];
        struct Anchor {
            std::size_t node;
            double s;
        };
        std::vector<Anchor> anchors;
        for (const std::size_t stop : level.stops) {
            const double s = net_.stops[stop].place.x();
            anchors.push_back({column_node[net_.stops[stop].column], s - std::floor(s + 1e-9)});
        }
        std::sort(anchors.begin(), anchors.end(),
                  [](const Anchor& a, const Anchor& b) { return a.node < b.node; });
        for (std::size_t a = 0; a < anchors.size(); ++a) {
            const Anchor& from = anchors[a];
            Anchor to = anchors[(a + 1) % anchors.size()];
            if (a + 1 == anchors.size()) to.node += count_;
            while (to.s <= from.s + 1e-9) to.s += 1;
            const double start = at_node(from.node), whole = at_node(to.node) - start;
            for (std::size_t i = from.node + 1; i < to.node; ++i) {
                const double s = from.s + (at_node(i) - start) / whole * (to.s - from.s);
                const std::vector<LinkingMap::Crossing> found = LinkingMap::crossings(ring, s);
                if (!found.empty())
                    pin(i, layer, found.front().edge, found.front().at, Vec2(s, found.front().t));
            }
        }
    }

    /// s of a node, growing past whole turns.
    [[nodiscard]] double at_node(std::size_t node) const
    {
        return nodes_.source_at[node % count_] / link_.source.length() +
               static_cast<double>(node / count_); // NOLINT(bugprone-integer-division): whole turns
    }

    /// Pin nodes to the net, and move the others as the grid's harmonic field says.
    void follow_net()
    {
        const std::vector<std::size_t> column_node = nodes_of_columns();
        pin_long_edges(column_node);
        for (std::size_t r = 0; r < net_.levels.size(); ++r) pin_level(r, column_node);
        for (const WallNet::Stop& stop : net_.stops) {
            const std::size_t node = column_node[stop.column], layer = layer_of(stop);
            for (const Edge& edge : model_.edges) {
                if (edge.from != stop.vertex && edge.to != stop.vertex) continue;
                const EdgeId id(static_cast<std::size_t>(&edge - model_.edges.data()));
                pin(node, layer, id, edge.from == stop.vertex ? 0.0 : 1.0, stop.place);
                break;
            }
        }
        move_grid();
        for (std::size_t i = 0; i < count_; ++i) {
            if (!rises(i)) spread_evenly(i);
            if (!rises(i)) refuse_overlap();
        }
    }

    /// Whether the nodes of a column lie one above the other in the strip, but for those that are given.
    [[nodiscard]] bool rises(std::size_t node) const
    {
        for (std::size_t k = 0; k < layers_; ++k) {
            if (place_[(k + 1) * count_ + node].y() > place_[k * count_ + node].y()) continue;
            if (!is_given(k, node) || !is_given(k + 1, node)) return false;
        }
        return true;
    }

    /// Put the free nodes of a column between those that are given or on an edge, as the heights are.
    void spread_evenly(std::size_t node)
    {
        const auto is_free = [&](std::size_t k) {
            return k > 0 && k < layers_ && !is_given(k, node) && !on_edge_.contains(k * count_ + node);
        };
        std::size_t low = 0;
        for (std::size_t k = 1; k <= layers_; ++k) {
            if (is_free(k)) continue;
            const double from = place_[low * count_ + node].y(), to = place_[k * count_ + node].y();
            for (std::size_t j = low + 1; j < k; ++j) {
                const double f = (heights_[j] - heights_[low]) / (heights_[k] - heights_[low]);
                place_[j * count_ + node].y() = from + f * (to - from);
            }
            low = k;
        }
    }

    [[noreturn]] void refuse_overlap() const
    {
        const std::string why = "draws the layers over each other; ask for more layers";
        if (!net_.levels.empty()) refuse_wall_edge(model_, net_.levels.front().edge, why);
        if (!net_.columns.empty()) refuse_wall_edge(model_, net_.columns.front().edge, why);
        const auto given = std::find(given_side_.begin(), given_side_.end(), 1) - given_side_.begin();
        throw NotSweepable("surface.wall_rows",
                           "the mesh that " + name_of(model_, mesh_.face[static_cast<std::size_t>(given)]) +
                               " came with " + why);
    }

    /// How far a node is from where it belongs in the strip.
    [[nodiscard]] double off_place(const Vec2& to, std::size_t node, Eigen::Index axis) const
    {
        const double off = to[axis] - place_[node][axis];
        return axis == 0 ? off - std::round(off) : off;
    }

    void move_grid()
    {
        // On a cylinder, where the grid closes on itself as the strip does.
        constexpr double kTurn = 2 * std::numbers::pi;
        std::vector<Vec3> points;
        for (std::size_t k = 0; k <= layers_; ++k) {
            for (std::size_t i = 0; i < count_; ++i) {
                const double angle = kTurn * at_node(i), radius = map_->width() / kTurn;
                points.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                    heights_[k] * map_->height());
            }
        }
        std::vector<Triangle> triangles;
        const auto at = [&](std::size_t k, std::size_t i) {
            return static_cast<Index>(k * count_ + i % count_);
        };
        for (std::size_t k = 0; k < layers_; ++k) {
            for (std::size_t i = 0; i < count_; ++i) {
                triangles.push_back({at(k, i), at(k, i + 1), at(k + 1, i + 1)});
                triangles.push_back({at(k, i), at(k + 1, i + 1), at(k + 1, i)});
            }
        }
        for (const Eigen::Index axis : {0, 1}) {
            std::map<Index, double> fixed;
            for (std::size_t i = 0; i < count_; ++i) {
                for (std::size_t k = 0; k <= layers_; ++k) {
                    const bool still = k == 0 || k == layers_ || (axis == 0 && line_of_[i] >= 0);
                    const Index point = given_node_[k * count_ + i];
                    if (still)
                        fixed[at(k, i)] = 0;
                    else if (point >= 0)
                        fixed[at(k, i)] = off_place(map_->place_of(point), k * count_ + i, axis);
                }
            }
            for (const auto& [node, pinned] : on_edge_) {
                fixed.try_emplace(static_cast<Index>(node), off_place(pinned.place, node, axis));
            }
            geometry::HarmonicProblem problem;
            problem.points = points;
            problem.triangles = triangles;
            problem.fixed_values.resize(static_cast<Eigen::Index>(fixed.size()), 1);
            for (const auto& [node, off] : fixed) {
                problem.fixed_values(static_cast<Eigen::Index>(problem.fixed.size()), 0) = off;
                problem.fixed.push_back(node);
            }
            const Eigen::MatrixXd moves = geometry::solve_harmonic(problem, context_);
            for (std::size_t n = 0; n < place_.size(); ++n)
                place_[n][axis] += moves(static_cast<Eigen::Index>(n), 0);
        }
    }

    // -------------------------------------------------------------------------------------------------

    /// The point of a node that lies on an edge.
    [[nodiscard]] std::optional<Vec3> pinned_point(std::size_t layer, std::size_t node) const
    {
        const auto found = on_edge_.find(layer * count_ + node);
        if (found == on_edge_.end()) return std::nullopt;
        const double at[] = {found->second.share};
        return edge_points(model_, found->second.edge, at).front();
    }

    void mesh_lines()
    {
        for (std::size_t i = 0; i < link_.lines.size(); ++i) {
            const std::size_t node = nodes_.line[i];
            const Chain chain(model_, link_.lines[i].line.uses);
            std::vector<double> at;
            for (std::size_t k = 0; k <= layers_; ++k)
                at.push_back(place_[k * count_ + node].y() * chain.length());
            const std::vector<Vec3> points = chain.points(at);
            for (std::size_t k = 1; k < layers_; ++k) {
                if (!is_given(k, node)) point(k, node) = pinned_point(k, node).value_or(points[k]);
            }
        }
    }

    bool mesh_transfinite(FaceId face, std::size_t first, std::size_t last)
    {
        const std::size_t n = last - first;
        std::vector<Vec3> bottom, top, left, right;
        for (std::size_t i = first; i <= last; ++i) {
            bottom.push_back(point(0, i));
            top.push_back(point(layers_, i));
        }
        for (std::size_t k = 0; k <= layers_; ++k) {
            left.push_back(point(k, first));
            right.push_back(point(k, last));
        }
        // Flat panels stay with the plain patch, which keeps an affine block affine to rounding.
        const bool flat = model_[face].kind == "plane" || model_[face].geometry == Geometry::newell;
        const std::vector<Vec3> grid = flat ? geometry::transfinite(bottom, right, top, left)
                                            : geometry::swept_grid(bottom, right, top, left);
        std::vector<Vec3> inside;
        for (std::size_t k = 1; k < layers_; ++k) {
            for (std::size_t i = 1; i < n; ++i) inside.push_back(grid[k * (n + 1) + i]);
        }
        const Face& f = model_[face];
        if (f.kind != "plane" && !inside.empty()) {
            const std::vector<Vec3> patch = inside;
            if (exact_)
                Projector(model_, {face}).project(inside, context_);
            else
                put_on_facets(face, inside);
            double moved = 0;
            for (std::size_t i = 0; i < inside.size(); ++i)
                moved = std::max(moved, (inside[i] - patch[i]).norm());
            // Round a seam the patch has no chord to turn with; far from the face it would spread the nodes
            // by chance.
            const bool round_a_seam = n == count_;
            if (round_a_seam &&
                moved > kFarFromPatch * std::min(geometry::length(bottom), geometry::length(top)))
                return false;
        }
        std::size_t next = 0;
        for (std::size_t k = 1; k < layers_; ++k) {
            for (std::size_t i = 1; i < n; ++i) point(k, first + i) = inside[next++];
        }
        set_faces(face, first, last);
        return f.origin != Origin::given || !folds(first, last);
    }

    void put_on_facets(FaceId face, std::span<Vec3> points) const
    {
        const geometry::FacetTree tree(model_.points, model_[face].triangles);
        for (Vec3& p : points) p = tree.closest(p).point;
    }

    /// True when a quad between two columns has a corner turned over against the quad's own normal.
    [[nodiscard]] bool folds(std::size_t first, std::size_t last)
    {
        for (std::size_t k = 0; k < layers_; ++k) {
            for (std::size_t i = first; i < last; ++i) {
                const std::array<Vec3, 4> c{point(k, i), point(k, i + 1), point(k + 1, i + 1),
                                            point(k + 1, i)};
                const Vec3 normal = (c[2] - c[0]).cross(c[3] - c[1]);
                for (std::size_t j = 0; j < 4; ++j) {
                    if ((c[(j + 1) % 4] - c[j]).cross(c[(j + 3) % 4] - c[j]).dot(normal) <= 0) return true;
                }
            }
        }
        return false;
    }

    void mesh_by_map(std::size_t first, std::size_t last)
    {
        std::map<FaceId, std::pair<std::vector<FacetPosition>, std::vector<std::size_t>>> on_face;
        for (std::size_t i = first; i < last; ++i) {
            for (std::size_t k = 1; k < layers_ && line_of_[i] < 0; ++k) {
                if (is_given(k, i)) continue;
                if (const std::optional<Vec3> pinned = pinned_point(k, i)) {
                    point(k, i) = *pinned;
                    continue;
                }
                const Vec2& at = place_[k * count_ + i];
                const WallPosition place = map_->locate(at.x(), at.y());
                on_face[place.face].first.push_back(place.at);
                on_face[place.face].second.push_back(k * count_ + i);
            }
            for (std::size_t k = 0; k < layers_; ++k) {
                if (given_side_[k * count_ + i] != 0) continue;
                Vec2 next = place_[k * count_ + (i + 1) % count_] +
                            place_[(k + 1) * count_ + (i + 1) % count_];
                if (i + 1 == count_) next.x() += 2;
                const Vec2 at = (place_[k * count_ + i] + place_[(k + 1) * count_ + i] + next) / 4;
                mesh_.face[k * count_ + i] = map_->locate(at.x(), at.y()).face;
            }
        }
        for (const auto& [face, work] : on_face) {
            const Face& f = model_[face];
            const std::vector<Vec3> points =
                points_at({model_.points, f.triangles, f.uv, exact_ ? f.surface.get() : nullptr}, work.first);
            for (std::size_t j = 0; j < points.size(); ++j) mesh_.points[work.second[j]] = points[j];
        }
    }

    const OpenVolume& volume_;
    const Model& model_;
    const LinkingSurface& link_;
    const LinkingNodes& nodes_;
    std::vector<double> heights_;
    bool exact_; ///< nodes on exact faces; else on the facets
    const RunContext& context_;
    std::size_t count_, layers_;
    WallMesh mesh_;
    std::unique_ptr<LinkingMap> map_;
    std::vector<FollowedPanel> followed_;
    WallNet net_;
    std::vector<int> level_layer_; ///< of each level of the net
    struct Pinned {
        EdgeId edge;
        double share; ///< of the edge's length
        Vec2 place;   ///< in the strip
    };
    std::map<std::size_t, Pinned> on_edge_; ///< nodes that lie on an edge, by layer · nodes + node
    std::vector<Vec2> place_;               ///< of each node in the strip
    static constexpr Index kNotGiven = -1, kBetweenGiven = -2;
    std::vector<Index>
        given_node_; ///< model point that a node is, by layer · nodes + node, or one of the two
    std::vector<char> given_side_; ///< given quads, by layer · nodes + node
    std::vector<int> line_of_;     ///< side line of each node of the rim; -1: none
};

} // namespace

LinkingNodes linking_nodes(const LinkingSurface& link, std::span<const int> counts)
{
    std::vector<std::vector<double>> shares;
    for (const int count : counts) {
        shares.emplace_back();
        for (int k = 0; k < count; ++k) shares.back().push_back(static_cast<double>(k) / count);
    }
    return linking_nodes(link, shares);
}

LinkingNodes linking_nodes(const LinkingSurface& link, std::span<const std::vector<double>> shares)
{
    return linking_nodes(link, shares, shares);
}

LinkingNodes linking_nodes(const LinkingSurface& link, std::span<const std::vector<double>> source,
                           std::span<const std::vector<double>> target)
{
    LinkingNodes nodes;
    std::size_t line = 0;
    for (std::size_t i = 0; i < link.segments.size(); ++i) {
        const RimSegment& segment = link.segments[i];
        while (line < link.lines.size() &&
               link.lines[line].source_at <= segment.source_from + 1e-12 * link.source.length()) {
            nodes.line.push_back(nodes.source_at.size());
            ++line;
        }
        for (const double f : source[i])
            nodes.source_at.push_back(segment.source_from + f * (segment.source_to - segment.source_from));
        for (const double f : target[i])
            nodes.target_at.push_back(segment.target_from + f * (segment.target_to - segment.target_from));
    }
    return nodes;
}

namespace {

std::vector<WallMesh> walls_of(const OpenVolume& volume, std::span<const LinkingSurface> links,
                               std::span<const LinkingNodes> nodes, std::span<const double> heights,
                               std::span<const GivenColumns> columns, bool exact, const RunContext& context)
{
    const GivenColumns none;
    std::vector<WallMesh> meshes;
    std::vector<FollowedPanel> followed;
    for (std::size_t b = 0; b < links.size(); ++b) {
        WallMesher mesher(volume, links[b], nodes[b], columns.empty() ? none : columns[b], heights, exact,
                          context);
        meshes.push_back(mesher.run());
        for (FollowedPanel panel : mesher.followed()) {
            panel.link = b;
            followed.push_back(panel);
        }
    }
    if (!followed.empty())
        follow_rows(meshes, volume.model, nodes, followed, heights.size() - 1, exact, context);
    return meshes;
}

} // namespace

std::vector<WallMesh> mesh_walls(const OpenVolume& volume, std::span<const LinkingSurface> links,
                                 std::span<const LinkingNodes> nodes, std::span<const double> heights,
                                 std::span<const GivenColumns> columns, const RunContext& context)
{
    return walls_of(volume, links, nodes, heights, columns, true, context);
}

std::vector<WallMesh> mesh_walls_on_facets(const OpenVolume& volume, std::span<const LinkingSurface> links,
                                           std::span<const LinkingNodes> nodes,
                                           std::span<const double> heights, const RunContext& context)
{
    return walls_of(volume, links, nodes, heights, {}, false, context);
}

} // namespace lacuna::surface
