// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/strip_grid.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/harmonic.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/detail/chain_nodes.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>

namespace lacuna::surface {

using namespace topology;

namespace {

class StripLayer : StripTask {
public:
    StripLayer(const StripTask& task, const LinkingMap* map, const WallNet& net, const RunContext& context)
        : StripTask(task),
          map_(map),
          net_(net),
          context_(context),
          count_(task.nodes.source_at.size()),
          layers_(task.heights.size() - 1)
    {
    }

    StripGrid run()
    {
        if (!net_.levels.empty()) plan_levels();
        lay_grid();
        return std::move(laid_);
    }

private:
    /// Assign a layer boundary to each level: the nearest one that leaves enough layers for all levels above
    /// and below.
    void plan_levels()
    {
        const auto layers = static_cast<int>(layers_);
        const std::size_t count = net_.levels.size();
        const std::vector<std::vector<std::size_t>> below = net_.levels_below(*map_);
        std::vector<int> above(count, 0);
        const int most = most_levels(below);
        for (std::size_t b = count; b-- > 0;) {
            for (const std::size_t a : below[b]) above[a] = std::max(above[a], above[b] + 1);
        }
        if (most >= layers) {
            throw NotSweepable(
                Message(
                    "surface.too_few_layers",
                    "the edges around the walls, such as {}, need {} boundaries of layers between source and "
                    "target, but {} layers have fewer",
                    entity_of(model, net_.levels.front().edge), most, found(layers))
                    .remedy("use layers = {} or more", needed(most + 1)));
        }
        for (std::size_t r = 0; r < count; ++r) {
            int nearest = 1, lowest = 1;
            for (int k = 1; k < layers; ++k) {
                const double height = map_->to_even(net_.levels[r].height);
                if (std::abs(heights[static_cast<std::size_t>(k)] - height) <
                    std::abs(heights[static_cast<std::size_t>(nearest)] - height))
                    nearest = k;
            }
            for (const std::size_t a : below[r]) lowest = std::max(lowest, level_layer_[a] + 1);
            level_layer_.push_back(std::min(std::max(nearest, lowest), layers - 1 - above[r]));
        }
    }

    /// The t of a column's nodes: that of the layers, but with the given t at some layers, and linear
    /// interpolation between these.
    /// @param at_layer  for each layer whose ring crosses the column: the t of the crossing.
    [[nodiscard]] std::vector<double> column_heights(const std::map<int, double>& at_layer) const
    {
        const auto t_of = [&](double height) { return map_ != nullptr ? map_->from_even(height) : height; };
        std::vector<std::pair<double, double>> knots{{0, 0}};
        for (const auto& [layer, t] : at_layer) {
            if (t > knots.back().second && t < 1)
                knots.emplace_back(t_of(heights[static_cast<std::size_t>(layer)]), t);
        }
        knots.emplace_back(1, 1);
        std::vector<double> result;
        std::size_t k = 0;
        for (const double height : heights) {
            const double h = t_of(height);
            while (k + 2 < knots.size() && h > knots[k + 1].first) ++k;
            const auto& [h0, t0] = knots[k];
            const auto& [h1, t1] = knots[k + 1];
            result.push_back(t0 + (h - h0) / (h1 - h0) * (t1 - t0));
        }
        return result;
    }

    /// The crossings of a column with plain rings, by the layer of each ring.
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

    /// The t of the nodes of a side line. If its edges are kept, these are those of their nodes. Otherwise
    /// they are those of the layers, shifted to the plain rings that meet the line.
    [[nodiscard]] std::vector<double> line_heights(std::size_t line) const
    {
        const Chain chain(model, link.lines[line].line.uses);
        const auto on_line = [&](double share) {
            return map_ != nullptr ? map_->on_line(line, share) : share;
        };
        if (chain.uses().size() > 1 && std::ranges::all_of(chain.uses(), [&](const EdgeUse& use) {
                return model[use.edge].keeps_nodes;
            })) {
            std::vector<double> kept = geometry::arc_lengths(use_places(model, chain.uses()));
            for (double& at : kept) at = on_line(at / kept.back());
            if (kept.size() == layers_ + 1) return kept;
        }
        std::map<int, double> at_layer;
        for (std::size_t u = 1; u < chain.uses().size(); ++u) {
            const VertexId v = use_from(model, chain.uses()[u]);
            for (std::size_t r = 0; r < level_layer_.size(); ++r) {
                if (!net_.levels[r].plain) continue;
                const auto& vertices = map_->rings()[*net_.levels[r].ring].vertices;
                if (std::ranges::find(vertices, v) != vertices.end())
                    at_layer[level_layer_[r]] = on_line(chain.start(u) / chain.length());
            }
        }
        return column_heights(at_layer);
    }

    /// Place each node in the strip. Columns are vertical, and layers follow the plain rings.
    void lay_grid()
    {
        laid_.place.assign(count_ * (layers_ + 1), Vec2::Zero());
        for (std::size_t i = 0; i < count_; ++i) {
            std::vector<double> at(heights.begin(), heights.end());
            const double s = nodes.source_at[i] / link.source.length();
            if (line_of[i] >= 0) {
                at = line_heights(static_cast<std::size_t>(line_of[i]));
            } else if (map_ != nullptr) {
                std::map<int, double> at_layer;
                for (const auto& [layer, crossing] : crossings_at(s)) {
                    at_layer[layer] = crossing.t;
                    laid_.on_edge[static_cast<std::size_t>(layer) * count_ + i] = {crossing.edge, crossing.at,
                                                                                   Vec2(s, crossing.t)};
                }
                at = column_heights(at_layer);
            }
            for (std::size_t k = 0; k <= layers_; ++k) laid_.place[k * count_ + i] = Vec2(s, at[k]);
        }
        if (map_ != nullptr && (begun.given.has_sides() || !net_.stops.empty())) follow_net();
    }

    // --- the net -------------------------------------------------------------------------------------

    /// Assign a node to each column of the net.
    [[nodiscard]] std::vector<std::size_t> nodes_of_columns() const
    {
        std::vector<std::size_t> node;
        for (const WallNet::Column& column : net_.columns) {
            std::size_t nearest = 0;
            double least = kInfinity;
            for (std::size_t i = 0; i < count_; ++i) {
                const double to = column.target_at
                                      ? link.target.wrapped(nodes.target_at[i]) - *column.target_at
                                      : 0;
                const double off = column.target_at && !column.source_at
                                       ? std::abs(std::remainder(to / link.target.length(), 1.0))
                                       : std::abs(std::remainder(
                                             nodes.source_at[i] / link.source.length() - column.at, 1.0));
                if (off >= least) continue;
                least = off;
                nearest = i;
            }
            node.push_back(column.line ? nodes.line[*column.line] : nearest);
        }
        for (std::size_t a = 0; a < node.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                const WallNet::Column &p = net_.columns[a], &q = net_.columns[b];
                if (node[a] != node[b] || p.high < q.low || q.high < p.low) continue;
                throw NotSweepable(Message("surface.wall_edge", "{} and {} require the same column of nodes",
                                           entity_of(model, q.line ? p.edge : q.edge),
                                           entity_of(model, q.line ? q.edge : p.edge))
                                       .remedy("use a smaller 'size'"));
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

    /// Fix the position of a node on an edge.
    void pin(std::size_t node, std::size_t layer, EdgeId edge, double share, const Vec2& place)
    {
        if (layer == 0 || layer == layers_) return;
        laid_.on_edge[layer * count_ + node % count_] = {edge, share, place};
    }

    void pin_long_edges(const std::vector<std::size_t>& column_node)
    {
        for (const WallNet::LongEdge& edge : net_.long_edges) {
            const WallNet::Stop &low = net_.stops[edge.low], &high = net_.stops[edge.high];
            const std::size_t from = layer_of(low), to = layer_of(high);
            if (from >= to) {
                refuse_wall_edge(model, edge.upright->edge,
                                 "runs up the walls past edges whose layers have another order",
                                 "use more layers");
            }
            for (std::size_t k = from; k <= to; ++k) {
                double f = (heights[k] - heights[from]) / (heights[to] - heights[from]);
                if (edge.reversed) f = 1 - f;
                pin(column_node[low.column], k, edge.upright->edge, f,
                    place_on(edge.upright->pieces, edge.upright->edge, f));
            }
        }
    }

    /// The position in the strip of a point of an edge, given as a fraction of the edge's length.
    static Vec2 place_on(const std::vector<LinkingMap::Piece>& pieces, EdgeId edge, double share)
    {
        for (const LinkingMap::Piece& piece : pieces) {
            const double low = std::min(piece.from, piece.to), high = std::max(piece.from, piece.to);
            if (piece.edge != edge || share < low - kSamePlace || share > high + kSamePlace) continue;
            const double f = high > low ? (share - piece.from) / (piece.to - piece.from) : 0;
            return piece.a + f * (piece.b - piece.a);
        }
        return pieces.front().a;
    }

    /// Fix the nodes of a level between its stops: on the level's edges, at even steps of the columns.
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
            anchors.push_back({column_node[net_.stops[stop].column], s - std::floor(s + kSamePlace)});
        }
        std::ranges::sort(anchors, {}, &Anchor::node);
        for (std::size_t a = 0; a < anchors.size(); ++a) {
            const Anchor& from = anchors[a];
            Anchor to = anchors[(a + 1) % anchors.size()];
            if (a + 1 == anchors.size()) to.node += count_;
            while (to.s <= from.s + kSamePlace) to.s += 1;
            const double start = at_node(from.node), whole = at_node(to.node) - start;
            for (std::size_t i = from.node + 1; i < to.node; ++i) {
                const double s = from.s + (at_node(i) - start) / whole * (to.s - from.s);
                const std::vector<LinkingMap::Crossing> found = LinkingMap::crossings(ring, s);
                if (!found.empty())
                    pin(i, layer, found.front().edge, found.front().at, Vec2(s, found.front().t));
            }
        }
    }

    /// Coordinate s of a node; each turn around the strip adds 1.
    [[nodiscard]] double at_node(std::size_t node) const
    {
        return nodes.source_at[node % count_] / link.source.length() +
               static_cast<double>(node / count_); // NOLINT(bugprone-integer-division): whole turns
    }

    /// Fix nodes on the net, and move the other nodes by a harmonic field over the grid.
    void follow_net()
    {
        const std::vector<std::size_t> column_node = nodes_of_columns();
        pin_long_edges(column_node);
        for (std::size_t r = 0; r < net_.levels.size(); ++r) pin_level(r, column_node);
        for (const WallNet::Stop& stop : net_.stops) {
            const std::size_t node = column_node[stop.column], layer = layer_of(stop);
            laid_.stops.push_back(layer * count_ + node);
            for (const Edge& edge : model.edges) {
                if (edge.from != stop.vertex && edge.to != stop.vertex) continue;
                const EdgeId id(static_cast<std::size_t>(&edge - model.edges.data()));
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

    /// Whether the heights of a column's nodes increase from layer to layer. Intervals between two given
    /// nodes are not checked.
    [[nodiscard]] bool rises(std::size_t node) const
    {
        for (std::size_t k = 0; k < layers_; ++k) {
            if (laid_.place[(k + 1) * count_ + node].y() > laid_.place[k * count_ + node].y()) continue;
            if (!begun.given.has_node(k, node) || !begun.given.has_node(k + 1, node)) return false;
        }
        return true;
    }

    /// Distribute the free nodes of a column between its given nodes and its nodes on edges. The distances
    /// are proportional to those of the layers' heights.
    void spread_evenly(std::size_t node)
    {
        const auto is_free = [&](std::size_t k) {
            return k > 0 && k < layers_ && !begun.given.has_node(k, node) &&
                   !laid_.on_edge.contains(k * count_ + node);
        };
        std::size_t low = 0;
        for (std::size_t k = 1; k <= layers_; ++k) {
            if (is_free(k)) continue;
            const double from = laid_.place[low * count_ + node].y(), to = laid_.place[k * count_ + node].y();
            for (std::size_t j = low + 1; j < k; ++j) {
                const double f = (heights[j] - heights[low]) / (heights[k] - heights[low]);
                laid_.place[j * count_ + node].y() = from + f * (to - from);
            }
            low = k;
        }
    }

    [[noreturn]] void refuse_overlap() const
    {
        for (const EdgeId edge : {net_.levels.empty() ? EdgeId() : net_.levels.front().edge,
                                  net_.columns.empty() ? EdgeId() : net_.columns.front().edge}) {
            if (edge.valid()) refuse_wall_edge(model, edge, "makes layers overlap", "use more layers");
        }
        const auto given = std::ranges::find(begun.given.side, 1) - begun.given.side.begin();
        throw NotSweepable(Message("surface.wall_rows", "the given mesh of {} makes layers overlap",
                                   entity_of(model, begun.mesh.face[static_cast<std::size_t>(given)]))
                               .remedy("use more layers"));
    }

    /// Displacement that moves a node to a position in the strip, along one axis.
    [[nodiscard]] double off_place(const Vec2& to, std::size_t node, Eigen::Index axis) const
    {
        const double off = to[axis] - laid_.place[node][axis];
        return axis == 0 ? off - std::round(off) : off;
    }

    void move_grid()
    {
        // Solve on a cylinder, because the grid is closed around the strip.
        std::vector<Vec3> points;
        for (std::size_t k = 0; k <= layers_; ++k) {
            for (std::size_t i = 0; i < count_; ++i) {
                const double angle = kFullTurn * at_node(i), radius = map_->width() / kFullTurn;
                points.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                    heights[k] * map_->height());
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
                    const bool still = k == 0 || k == layers_ || (axis == 0 && line_of[i] >= 0);
                    const Index point = begun.given.node[k * count_ + i];
                    if (still)
                        fixed[at(k, i)] = 0;
                    else if (point >= 0)
                        fixed[at(k, i)] = off_place(map_->place_of(point), k * count_ + i, axis);
                }
            }
            for (const auto& [node, pinned] : laid_.on_edge) {
                fixed.try_emplace(static_cast<Index>(node), off_place(pinned.place, node, axis));
            }
            geometry::HarmonicProblem problem;
            problem.points = points;
            problem.triangles = triangles;
            problem.fix(fixed);
            const Eigen::MatrixXd moves = geometry::solve_harmonic(problem, context_);
            for (std::size_t n = 0; n < laid_.place.size(); ++n)
                laid_.place[n][axis] += moves(static_cast<Eigen::Index>(n), 0);
        }
    }

    const LinkingMap* map_;
    const WallNet& net_;
    const RunContext& context_;
    std::size_t count_, layers_;
    std::vector<int> level_layer_; ///< layer of each level of the net
    StripGrid laid_;
};

} // namespace

StripGrid lay_strip(const StripTask& task, const LinkingMap* map, const WallNet& net,
                    const RunContext& context)
{
    return StripLayer(task, map, net, context).run();
}

} // namespace lacuna::surface
