// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/keep_thickness.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/surface/shared/projector.h>
#include <lacuna/sweep/detail/harmonic_spread.h>
#include <lacuna/sweep/detail/thickness_report.h>
#include <lacuna/topology/shared/give_mesh.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// The height that a node must have over one wall. A node where rows cross has two of these.
struct Hold {
    std::size_t column;
    double height;
};

class ThicknessKeeper {
public:
    ThicknessKeeper(const SweptParts& parts, const surface::LayerTables& tables, std::vector<Vec3>& nodes,
                    const RunContext& context)
        : parts_(parts), tables_(tables), nodes_(nodes), context_(context)
    {
        for (std::size_t b = 0; b < parts.links.size(); ++b) rim_ += parts.size_of(b);
        for (const auto& [edge, chain] : parts.source.on_edge) {
            std::ranges::copy_if(chain, std::inserter(inner_, inner_.end()),
                                 [&](Index node) { return index(node) >= rim_; });
        }
        columns_ = row_columns(parts, tables);
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            const std::vector<double>& heights = heights_of(columns_[c].table);
            for (std::size_t j = 0; j < heights.size(); ++j)
                row_nodes_[columns_[c].nodes[j]].push_back({c, heights[j]});
        }
        find_ends();
        find_still();
        find_given();
    }

    KeptThickness run()
    {
        KeptThickness kept;
        if (columns_.empty() && end_table_[0] < 0 && end_table_[1] < 0) return kept;
        kept.held.assign(nodes_.size(), 0);
        quads_at_ = mesh::quads_at_nodes(quads(), count_);
        // Each round corrects errors that the previous round left where cells bend.
        for (int round = 0; round < kMostRounds && furthest_off() > kVisible; ++round) {
            check_cancelled(context_);
            move_layers();
            move_rows();
        }
        for (std::size_t t = 0; t < tables_.heights.size(); ++t) {
            const auto table = static_cast<int>(t);
            report_thickness(model_, tables_, table, reached(table), reached(table, true), kept.report);
        }
        for (const auto& [node, row] : row_nodes_) {
            for (std::size_t k = 0; k <= layers_; ++k) kept.held[k * count_ + index(node)] = 1;
        }
        for (std::size_t end = 0; end < 2; ++end) {
            if (end_table_[end] < 0) continue;
            const std::size_t rows = heights_of(end_table_[end]).size();
            for (std::size_t k = 0; k <= rows; ++k) {
                const std::size_t layer = end == 0 ? k : layers_ - k;
                std::fill_n(kept.held.begin() + static_cast<std::ptrdiff_t>(layer * count_), count_, char{1});
            }
        }
        return kept;
    }

private:
    [[nodiscard]] const std::vector<Quad>& quads() const { return parts_.source.quads.quads; }
    [[nodiscard]] Vec3& at(std::size_t layer, std::size_t node) { return nodes_[layer * count_ + node]; }
    [[nodiscard]] const Vec3& at(std::size_t layer, std::size_t node) const
    {
        return nodes_[layer * count_ + node];
    }
    [[nodiscard]] const std::vector<double>& heights_of(int table) const
    {
        return tables_.heights[index(table)];
    }

    // --- inputs -------------------------------------------------------------------------------------

    void find_ends()
    {
        for (const auto& [face, table] : tables_.of) {
            const Role role = parts_.volume.role[face.index()];
            if (role == Role::wall) continue;
            int& own = end_table_[role == Role::source ? 0 : 1];
            if (own >= 0 && own != table)
                throw NotSweepable(
                    Message("surface.layers_meet",
                            "the boundary layers of {} and of another face of the same end differ",
                            entity_of(model_, face))
                        .remedy("give both the same table"));
            own = table;
        }
    }

    /// Find the columns and rows that must not move: those at corners, on edges between walls, and on given
    /// meshes.
    void find_still()
    {
        for (std::size_t b = 0; b < parts_.links.size(); ++b) {
            const std::size_t n = parts_.size_of(b);
            std::vector<char>& still = still_column_.emplace_back(n, 0);
            const auto& nodes = parts_.source.links[b];
            for (const surface::RimSegment& segment : parts_.links[b].segments) {
                // Given nodes of one end stay there, but their columns may move in other layers.
                if (segment.given && !is_vertex(parts_.links[b].source, segment.source_from) &&
                    !is_vertex(parts_.links[b].target, segment.target_from))
                    continue;
                const auto found = std::ranges::lower_bound(nodes.source_at, segment.source_from);
                if (found != nodes.source_at.end())
                    still[static_cast<std::size_t>(found - nodes.source_at.begin())] = 1;
            }
            for (const std::size_t i : nodes.line) still[i] = 1;
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t k = 0; k < layers_; ++k) {
                    const FaceId left = parts_.wall_at(b, k, i + n - 1), right = parts_.wall_at(b, k, i);
                    if (left != right || has_mesh(left)) still[i] = 1;
                    if (has_mesh(left) || has_mesh(right)) on_given_wall_.insert(parts_.rim_node(b, i));
                    if (k > 0 && parts_.wall_at(b, k - 1, i) != right) still_layers_.insert(k);
                    if (has_mesh(right)) still_layers_.insert({k, k + 1});
                }
            }
        }
    }

    [[nodiscard]] bool has_mesh(FaceId face) const
    {
        return model_[face].keeps_nodes && !model_[face].given_quads.empty();
    }

    /// Find the nodes of both ends that are given: those of kept quads, and of edges with given nodes.
    void find_given()
    {
        const std::set<EdgeId> edges = kept_edges(model_);
        given_[0].assign(count_, 0);
        given_[1].assign(count_, parts_.target_stays ? 1 : 0);
        for (std::size_t q = 0; q < quads().size(); ++q) {
            if (!parts_.kept.contains(FaceId(index(parts_.source.quads.face[q])))) continue;
            for (const Index node : quads()[q]) given_[0][index(node)] = 1;
        }
        for (const auto& [edge, chain] : parts_.source.on_edge) {
            const auto image = parts_.target_edges.find(edge);
            for (const Index node : chain) {
                if (edges.contains(edge)) given_[0][index(node)] = 1;
                if (image != parts_.target_edges.end() && edges.contains(image->second))
                    given_[1][index(node)] = 1;
            }
        }
        for (std::size_t b = 0; b < parts_.links.size(); ++b) {
            const surface::Chain& target = parts_.links[b].target;
            for (std::size_t i = 0; i < parts_.size_of(b); ++i) {
                const std::size_t use = target.position(parts_.source.links[b].target_at[i]).use;
                if (edges.contains(target.uses()[use].edge)) given_[1][parts_.rim_node(b, i)] = 1;
            }
        }
    }

    [[nodiscard]] bool is_given(std::size_t layer, std::size_t node) const
    {
        return (layer == 0 && given_[0][node] != 0) || (layer == layers_ && given_[1][node] != 0);
    }

    [[nodiscard]] bool stays(std::size_t layer) const
    {
        return (layer == 0 || layer == layers_) &&
               std::ranges::all_of(given_[layer == 0 ? 0 : 1], [](char given) { return given != 0; });
    }

    /// Put given nodes back.
    void restore_given(const std::vector<Vec3>& before)
    {
        for (const std::size_t layer : {std::size_t{0}, layers_})
            for (std::size_t node = 0; node < count_; ++node)
                if (is_given(layer, node)) at(layer, node) = before[layer * count_ + node];
    }

    // --- normals ------------------------------------------------------------------------------------

    /// Inward normal of the wall over a side of the rim, at one of the side's ends.
    [[nodiscard]] Vec3 side_normal(std::size_t b, std::size_t side, std::size_t node, std::size_t layer) const
    {
        const Vec3 along = at(layer, parts_.rim_node(b, side + 1)) - at(layer, parts_.rim_node(b, side));
        const std::size_t foot = parts_.rim_node(b, node);
        Vec3 normal = Vec3::Zero();
        if (layer < layers_) normal += along.cross(at(layer + 1, foot) - at(layer, foot)).stableNormalized();
        if (layer > 0) normal += along.cross(at(layer, foot) - at(layer - 1, foot)).stableNormalized();
        return normal.stableNormalized();
    }

    /// Mean of the inward unit normals of the walls at the base of a column. The height along this mean
    /// normal is the mean of the heights over both walls.
    [[nodiscard]] Vec3 normal_of(const RowColumn& column, std::size_t layer) const
    {
        const std::size_t n = parts_.size_of(column.link);
        Vec3 normal = Vec3::Zero();
        if (column.before) normal += side_normal(column.link, (column.node + n - 1) % n, column.node, layer);
        if (column.after) normal += side_normal(column.link, column.node, column.node, layer);
        return column.before && column.after ? Vec3(normal / 2) : normal;
    }

    /// Normal of a layer's quads at a node.
    [[nodiscard]] Vec3 layer_normal(std::size_t node, std::size_t layer) const
    {
        Vec3 normal = Vec3::Zero();
        for (const Index q : quads_at_.of(node)) {
            const Quad& quad = quads()[index(q)];
            normal += (at(layer, index(quad[2])) - at(layer, index(quad[0])))
                          .cross(at(layer, index(quad[3])) - at(layer, index(quad[1])));
        }
        return normal.stableNormalized();
    }

    // --- errors of thickness ------------------------------------------------------------------------

    /// Thickness of row j over a column.
    [[nodiscard]] double thickness(const RowColumn& column, std::size_t j, std::size_t layer) const
    {
        const std::size_t below = j > 0 ? index(column.nodes[j - 1])
                                        : parts_.rim_node(column.link, column.node);
        return (at(layer, index(column.nodes[j])) - at(layer, below)).dot(normal_of(column, layer));
    }

    [[nodiscard]] double end_thickness(std::size_t end, std::size_t j, std::size_t node) const
    {
        const std::size_t foot = end == 0 ? 0 : layers_, from = end == 0 ? j : layers_ - j,
                          to = end == 0 ? j + 1 : layers_ - j - 1;
        const Vec3 normal = layer_normal(node, foot) * (end == 0 ? 1 : -1);
        return (at(to, node) - at(from, node)).dot(normal);
    }

    /// @param of_shared  whether to measure only at nodes shared with neighbours, or only elsewhere
    [[nodiscard]] ReachedThickness reached(int table, bool of_shared = false) const
    {
        ReachedThickness reached;
        const std::vector<double>& heights = heights_of(table);
        const auto wanted = [&](std::size_t j) { return heights[j] - (j > 0 ? heights[j - 1] : 0); };
        for (const RowColumn& column : columns_) {
            if (column.table != table) continue;
            const std::size_t n = parts_.size_of(column.link);
            const std::size_t side = column.after ? column.node : (column.node + n - 1) % n;
            for (std::size_t k = 0; k <= layers_; ++k) {
                for (std::size_t j = 0; j < heights.size(); ++j) {
                    const auto node = index(column.nodes[j]);
                    const bool shared = parts_.shared_rows &&
                                        (is_given(k, node) || on_given_wall_.contains(node));
                    if (shared != of_shared) continue;
                    reached.add(wanted(j), thickness(column, j, k),
                                at(k, parts_.rim_node(column.link, column.node)),
                                parts_.wall_at(column.link, std::min(k, layers_ - 1), side), j == 0);
                }
            }
        }
        if (of_shared) return reached;
        for (std::size_t end = 0; end < 2; ++end) {
            if (end_table_[end] != table) continue;
            const FaceId face = (end == 0 ? parts_.ends.source : parts_.ends.target).front();
            for (std::size_t node = 0; node < count_; ++node) {
                for (std::size_t j = 0; j < heights.size(); ++j)
                    reached.add(wanted(j), end_thickness(end, j, node), at(end == 0 ? 0 : layers_, node),
                                face, j == 0);
            }
        }
        return reached;
    }

    [[nodiscard]] double furthest_off() const
    {
        double off = 0;
        for (std::size_t t = 0; t < tables_.heights.size(); ++t)
            off = std::max(off, reached(static_cast<int>(t)).off);
        return off;
    }

    // --- moving rows along walls --------------------------------------------------------------------

    void move_rows()
    {
        if (columns_.empty()) return;
        std::vector<Vec3> before = nodes_;
        slide_on_walls();
        slide_on_inner_edges();
        for (std::size_t k = 0; k <= layers_; ++k) {
            if (stays(k)) continue;
            for (const auto& [node, row] : row_nodes_) {
                if (index(node) >= rim_ && !(has_edges(k) && inner_.contains(node)))
                    move_inside(index(node), row, k);
            }
        }
        restore_given(before);
        spread_moves(before, false);
        spread_moves(before, true);
        put_on_ends();
        restore_given(before);
    }

    /// Whether edges between faces of an end are also edges of the mesh in this layer.
    [[nodiscard]] bool has_edges(std::size_t layer) const
    {
        return layer == 0 || (layer == layers_ && !parts_.target_edges.empty());
    }

    /// Spread the moves of rims and rows over the inside of some layers: those with mesh edges between faces,
    /// or those without.
    void spread_moves(const std::vector<Vec3>& before, bool with_edges)
    {
        std::vector<std::size_t> layers;
        for (std::size_t k = 0; k <= layers_; ++k) {
            if (has_edges(k) == with_edges && !stays(k)) layers.push_back(k);
        }
        if (layers.empty()) return;
        std::vector<Index> fixed;
        for (std::size_t i = 0; i < count_; ++i) {
            const auto node = static_cast<Index>(i);
            if (i < rim_ || row_nodes_.contains(node) || (with_edges && inner_.contains(node)))
                fixed.push_back(node);
        }
        std::optional<HarmonicSpread>& spread = spread_[with_edges ? 1 : 0];
        if (!spread) {
            const NodeGraph graph = node_graph(quads(), count_);
            spread.emplace(graph, side_weights(graph, quads(), parts_.source.quads.nodes), fixed);
        }
        std::vector<Vec3> moves, out(layers.size() * count_, Vec3::Zero());
        for (const std::size_t k : layers) {
            for (const Index node : fixed)
                moves.push_back(at(k, index(node)) - before[k * count_ + index(node)]);
        }
        spread->add(moves, layers.size(), out.data(), count_, context_);
        for (std::size_t l = 0; l < layers.size(); ++l) {
            for (std::size_t i = 0; i < count_; ++i) at(layers[l], i) += out[l * count_ + i];
        }
    }

    /// Where rows end on edges between faces of an end, move their nodes along these edges.
    void slide_on_inner_edges()
    {
        for (const auto& [edge, chain] : parts_.source.on_edge) {
            if (chain.size() < 3 || index(chain[1]) < rim_) continue;
            const RowColumn* low = column_along(chain.front(), chain[1]);
            const RowColumn* high = column_along(chain.back(), chain[chain.size() - 2]);
            if (low == nullptr && high == nullptr) continue;
            for (const std::size_t layer : {std::size_t{0}, layers_}) {
                if (!has_edges(layer) || stays(layer)) continue;
                const auto image = parts_.target_edges.find(edge);
                if (layer != 0 && image == parts_.target_edges.end()) continue;
                std::vector<Vec3> line;
                for (const Index node : chain) line.push_back(at(layer, index(node)));
                const auto place = row_places(line, layer, low, high);
                if (!place) continue;
                const surface::Chain exact(model_, {{layer == 0 ? edge : image->second, false}});
                for (const auto& [i, x] : places_along(line, *place))
                    at(layer, index(chain[i])) = nearest_on(model_, exact, point_at(line, x));
            }
        }
    }

    /// Move a node within its layer to its required heights. Its distance from the layer's plane stays the
    /// same. Its offset along the rim becomes equal to its offset on the source.
    void move_inside(std::size_t node, const std::vector<Hold>& holders, std::size_t layer)
    {
        const std::size_t holds = std::min<std::size_t>(holders.size(), 2);
        const RowColumn& own = columns_[holders[0].column];
        const Vec3& foot = at(layer, parts_.rim_node(own.link, own.node));
        // Take the layer's normal at the last row, where quads are larger than in thin rows.
        const Vec3 up = layer_normal(index(own.nodes.back()), layer);
        const Vec3 raised = up * up.dot(at(layer, node) - foot);
        if (holds == 1) {
            const auto number = std::ranges::find(own.nodes, static_cast<Index>(node));
            const Vec3 along = own.tangent(parts_,
                                           [&](std::size_t n) -> const Vec3& { return at(layer, n); }),
                       normal = normal_of(own, layer);
            const Vec3 inward = up.cross(along) * (up.cross(along).dot(normal) > 0 ? 1 : -1);
            const double across = inward.dot(normal);
            if (!(across > 0)) return;
            const Vec3 lean = along * own.lean[static_cast<std::size_t>(number - own.nodes.begin())] + raised;
            at(layer, node) = foot + lean + inward * ((holders[0].height - lean.dot(normal)) / across);
            return;
        }
        // Where rows cross, the heights over both walls determine the position.
        std::array<Vec3, 2> normal{Vec3::Zero(), Vec3::Zero()}, within = normal;
        std::array<double, 2> off{};
        for (std::size_t h = 0; h < holds; ++h) {
            const RowColumn& column = columns_[holders[h].column];
            normal[h] = normal_of(column, layer);
            within[h] = normal[h] - up * up.dot(normal[h]);
            off[h] = holders[h].height -
                     (at(layer, node) - at(layer, parts_.rim_node(column.link, column.node))).dot(normal[h]);
        }
        const double a = normal[0].dot(within[0]), b = normal[0].dot(within[1]), c = normal[1].dot(within[0]),
                     d = normal[1].dot(within[1]);
        const double det = a * d - b * c;
        if (!(a > 0 && det > kVisible * a * d)) return; // the two walls are one
        at(layer, node) += within[0] * ((d * off[0] - b * off[1]) / det) +
                           within[1] * ((a * off[1] - c * off[0]) / det);
    }

    /// Where rows end on other walls, move their nodes along the layer's rim to the required heights. Nodes
    /// beyond the rows move in proportion.
    void slide_on_walls()
    {
        for (std::size_t b = 0; b < parts_.links.size(); ++b) {
            const std::size_t n = parts_.size_of(b);
            std::vector<std::size_t> corners;
            for (std::size_t i = 0; i < n; ++i)
                if (still_column_[b][i] != 0) corners.push_back(i);
            if (!corners.empty()) corners.push_back(corners.front() + n);
            for (std::size_t c = 0; c + 1 < corners.size(); ++c) slide_between(b, corners[c], corners[c + 1]);
        }
    }

    /// The column over the rim node `foot` whose first row node is `next`; null: none.
    [[nodiscard]] const RowColumn* column_along(Index foot, Index next) const
    {
        for (const RowColumn& column : columns_) {
            if (column.nodes.front() == next &&
                static_cast<Index>(parts_.rim_node(column.link, column.node)) == foot)
                return &column;
        }
        return nullptr;
    }

    void slide_between(std::size_t b, std::size_t first, std::size_t last)
    {
        const auto node = [&](std::size_t i) { return static_cast<Index>(parts_.rim_node(b, i)); };
        const RowColumn* low = column_along(node(first), node(first + 1));
        const RowColumn* high = column_along(node(last), node(last - 1));
        if ((low == nullptr && high == nullptr) || last < first + 2) return;
        for (std::size_t k = 0; k <= layers_; ++k) {
            if (stays(k)) continue;
            std::vector<Vec3> line;
            for (std::size_t i = first; i <= last; ++i) line.push_back(at(k, parts_.rim_node(b, i)));
            const auto place = row_places(line, k, low, high);
            if (place) move_along(b, first, k, line, places_along(line, *place));
        }
    }

    /// Positions on a line for the nodes of rows that end on it, over the columns at both ends of the line.
    [[nodiscard]] std::optional<LinePlaces> row_places(const std::vector<Vec3>& line, std::size_t layer,
                                                       const RowColumn* low, const RowColumn* high) const
    {
        const auto over = [&](const RowColumn* column) {
            return column == nullptr ? HeightsOver{}
                                     : HeightsOver{&heights_of(column->table), normal_of(*column, layer)};
        };
        return places_at(line, {over(low), over(high)});
    }

    /// Move the nodes between two corners of the rim to new positions along the rim. On the rim of an end,
    /// nodes stay on the exact edges.
    void move_along(std::size_t b, std::size_t first, std::size_t layer, const std::vector<Vec3>& line,
                    const std::vector<std::pair<std::size_t, double>>& moved)
    {
        const surface::LinkingSurface& link = parts_.links[b];
        const surface::Chain* rim = layer == 0 ? &link.source : layer == layers_ ? &link.target : nullptr;
        std::map<FaceId, std::vector<std::size_t>> on_face;
        for (const auto& [i, x] : moved) {
            const std::size_t node = parts_.rim_node(b, first + i);
            at(layer, node) = point_at(line, x);
            if (rim != nullptr) {
                at(layer, node) = nearest_on(model_, *rim, at(layer, node));
                continue;
            }
            const auto side = std::min(static_cast<std::size_t>(x), line.size() - 2);
            const FaceId wall = parts_.wall_at(b, layer, first + side);
            if (model_[wall].origin == Origin::given && model_[wall].kind != "plane")
                on_face[wall].push_back(node);
        }
        for (const auto& [face, nodes] : on_face) project(face, nodes, layer);
    }

    void project(FaceId face, const std::vector<std::size_t>& nodes, std::size_t layer)
    {
        std::vector<Vec3> points;
        for (const std::size_t node : nodes) points.push_back(at(layer, node));
        projectors_.try_emplace(face, model_, std::vector<FaceId>{face})
            .first->second.project(points, context_);
        for (std::size_t i = 0; i < nodes.size(); ++i) at(layer, nodes[i]) = points[i];
    }

    /// Project the nodes of both ends that lie inside one face back onto that face.
    void put_on_ends()
    {
        for (const std::size_t end : {0, 1}) {
            const std::size_t layer = end == 0 ? 0 : layers_;
            if (stays(layer)) continue;
            const std::vector<FaceId>& faces = end == 0 ? parts_.ends.source : parts_.ends.target;
            std::map<FaceId, std::vector<std::size_t>> on_face;
            for (std::size_t node = 0; node < count_; ++node) {
                if (node < rim_ || (has_edges(layer) && inner_.contains(static_cast<Index>(node)))) continue;
                const auto around = quads_at_.of(node);
                if (around.empty()) continue;
                const FaceId face = faces[index(around.front())];
                const bool one = std::ranges::all_of(around,
                                                     [&](Index q) { return faces[index(q)] == face; });
                // The facets of a void end may not reach its curved rim, so nodes of rows are not projected
                // onto these facets.
                const bool near_rim = model_[face].origin == Origin::made_void &&
                                      row_nodes_.contains(static_cast<Index>(node));
                if (one && !near_rim && model_[face].kind != "plane") on_face[face].push_back(node);
            }
            for (const auto& [face, nodes] : on_face) project(face, nodes, layer);
        }
    }

    // --- moving layers along ends -------------------------------------------------------------------

    void move_layers()
    {
        if (end_table_[0] < 0 && end_table_[1] < 0) return;
        std::array<const std::vector<double>*, 2> heights{};
        for (const std::size_t end : {0, 1})
            if (end_table_[end] >= 0) heights[end] = &heights_of(end_table_[end]);
        std::vector<Vec3> before = nodes_;
        for (std::size_t node = 0; node < count_; ++node) {
            std::vector<Vec3> line;
            for (std::size_t k = 0; k <= layers_; ++k) line.push_back(before[k * count_ + node]);
            const auto place = places_at(line,
                                         {HeightsOver{heights[0], layer_normal(node, 0)},
                                          HeightsOver{heights[1], -layer_normal(node, layers_)}},
                                         still_layers_);
            if (!place) continue;
            for (auto p = place->begin(), q = std::next(p); q != place->end(); p = q++) {
                for (std::size_t k = std::max<std::size_t>(p->first, 1); k < q->first; ++k) {
                    const double share = static_cast<double>(k - p->first) /
                                         static_cast<double>(q->first - p->first);
                    at(k, node) = point_at(line, p->second + share * (q->second - p->second));
                }
            }
        }
        put_on_walls();
    }

    /// Project nodes on walls, which have moved along their columns, back onto the walls and the edges
    /// between walls.
    void put_on_walls()
    {
        std::map<std::pair<FaceId, std::size_t>, std::vector<std::size_t>> on_wall;
        for (std::size_t b = 0; b < parts_.links.size(); ++b) {
            const surface::LinkingSurface& link = parts_.links[b];
            const std::vector<std::size_t>& lines = parts_.source.links[b].line;
            for (std::size_t i = 0; i < parts_.size_of(b); ++i) {
                const auto line = std::ranges::find(lines, i);
                std::optional<surface::Chain> chain;
                if (line != lines.end())
                    chain.emplace(model_,
                                  link.lines[static_cast<std::size_t>(line - lines.begin())].line.uses);
                for (std::size_t k = 1; k < layers_; ++k) {
                    if (still_layers_.contains(k)) continue;
                    const std::size_t node = parts_.rim_node(b, i);
                    const FaceId wall = parts_.wall_at(b, k, i);
                    if (chain)
                        at(k, node) = nearest_on(model_, *chain, at(k, node));
                    else if (model_[wall].origin == Origin::given && model_[wall].kind != "plane")
                        on_wall[{wall, k}].push_back(node);
                }
            }
        }
        for (const auto& [where, nodes] : on_wall) project(where.first, nodes, where.second);
    }

    const SweptParts& parts_;
    const Model& model_ = parts_.volume.model;
    const surface::LayerTables& tables_;
    std::vector<Vec3>& nodes_;
    const RunContext& context_;
    const std::size_t count_ = parts_.source.quads.nodes.size(), layers_ = index(parts_.layers);
    std::size_t rim_ = 0; ///< number of source nodes on the rim; they come first
    std::array<std::vector<char>, 2>
        given_; ///< for each node of the source, and of the target: whether it is given
    std::set<std::size_t> on_given_wall_; ///< nodes of the rim at walls with given quads
    std::set<Index> inner_;               ///< source nodes on edges between faces of the source
    std::vector<RowColumn> columns_;
    std::map<Index, std::vector<Hold>> row_nodes_;
    std::array<int, 2> end_table_{-1, -1};
    std::vector<std::vector<char>> still_column_;
    std::set<std::size_t> still_layers_;
    mesh::Incidence quads_at_;
    /// The first for layers without inner edges, the second for layers with inner edges.
    std::array<std::optional<HarmonicSpread>, 2> spread_;
    std::map<FaceId, surface::Projector> projectors_;
};

} // namespace

KeptThickness keep_thickness(const SweptParts& parts, const surface::LayerTables& tables,
                             std::vector<Vec3>& nodes, const RunContext& context)
{
    if (tables.heights.empty()) return {};
    return ThicknessKeeper(parts, tables, nodes, context).run();
}

} // namespace lacuna::sweep
