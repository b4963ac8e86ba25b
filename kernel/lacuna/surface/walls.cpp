// SPDX-License-Identifier: MIT
#include <lacuna/surface/walls.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/affine.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/polyline.h>
#include <lacuna/geometry/swept_patch.h>
#include <lacuna/geometry/transfinite.h>
#include <lacuna/surface/detail/chain_nodes.h>
#include <lacuna/surface/detail/linking_map.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
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

/// Nodes first … last of a linking surface that stand on a void face which follows the given walls.
struct FollowedPanel {
    std::size_t link, first, last;
};

/// One linking surface being meshed.
class WallMesher {
public:
    WallMesher(const OpenVolume& volume, const LinkingSurface& link, const LinkingNodes& nodes,
               const GivenColumns& columns, std::span<const double> heights, const RunContext& context)
        : volume_(volume),
          model_(volume.model),
          link_(link),
          nodes_(nodes),
          heights_(heights.begin(), heights.end()),
          context_(context),
          count_(nodes.source_at.size()),
          layers_(heights.size() - 1),
          given_node_(count_, 0),
          given_side_(count_, 0)
    {
        mesh_.points.resize(count_ * (layers_ + 1));
        mesh_.face.resize(count_ * layers_);
        set_columns(columns);
    }

    WallMesh run()
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
            map_ = std::make_unique<LinkingMap>(volume_, link_);
            check_loose_edges();
            plan_rings();
        }
        mesh_lines();
        if (panels.empty()) mesh_by_map(0, count_);
        for (std::size_t i = 0; i < panels.size(); ++i) {
            const std::size_t first = nodes_.line[i];
            const std::size_t last = i + 1 < panels.size() ? nodes_.line[i + 1] : count_;
            if (is_given(first, last)) continue;
            if (follows(panels[i])) {
                followed_.push_back({0, first, last});
                set_faces(panels[i].front(), first, last);
                continue;
            }
            if (is_simple(panels[i]) && mesh_transfinite(panels[i].front(), first, last)) continue;
            if (map_ == nullptr) map_ = std::make_unique<LinkingMap>(volume_, link_);
            mesh_by_map(first, last);
        }
        if (map_ != nullptr) check_rings();
        return std::move(mesh_);
    }

    [[nodiscard]] const std::vector<FollowedPanel>& followed() const { return followed_; }

private:
    static std::vector<double> wrapped(std::vector<double> at, double length)
    {
        for (double& x : at) x = x >= length ? x - length : x;
        return at;
    }

    /// Take the nodes of columns as they are.
    void set_columns(const GivenColumns& columns)
    {
        const double slack = kSamePlace * link_.source.length();
        std::size_t c = 0;
        for (std::size_t i = 0; i < count_ && columns.rows == static_cast<int>(layers_); ++i) {
            while (c < columns.source_at.size() && columns.source_at[c] < nodes_.source_at[i] - slack) ++c;
            if (c == columns.source_at.size() || columns.source_at[c] > nodes_.source_at[i] + slack) continue;
            given_node_[i] = 1;
            for (std::size_t k = 0; k <= layers_; ++k) point(k, i) = model_.at(columns.points[c][k]);
            if (columns.faces[c].empty()) continue;
            const bool last = c + 1 == columns.source_at.size();
            const double next = last ? link_.source.length() : columns.source_at[c + 1];
            set_given_sides(i, next - slack, columns.points[last ? 0 : c + 1], columns.faces[c]);
        }
    }

    /// The quads from node `first` to the column before running length `end`. Nodes between divide them: an
    /// odd rim was given one more.
    void set_given_sides(std::size_t first, double end, const std::vector<Index>& next,
                         const std::vector<FaceId>& faces)
    {
        std::size_t last = first;
        while (last + 1 < count_ && nodes_.source_at[last + 1] < end) ++last;
        const auto sides = static_cast<double>(last - first + 1);
        for (std::size_t i = first; i <= last; ++i) {
            given_side_[i] = 1;
            for (std::size_t k = 0; k < layers_; ++k) mesh_.face[k * count_ + i] = faces[k];
            if (i == first) continue;
            given_node_[i] = 1;
            const double share = static_cast<double>(i - first) / sides;
            for (std::size_t k = 0; k <= layers_; ++k)
                point(k, i) = (1 - share) * point(k, first) + share * model_.at(next[k]);
        }
    }

    /// Whether all sides from a node to another are given quads.
    [[nodiscard]] bool is_given(std::size_t first, std::size_t last) const
    {
        return std::all_of(given_side_.begin() + static_cast<std::ptrdiff_t>(first),
                           given_side_.begin() + static_cast<std::ptrdiff_t>(last),
                           [](char given) { return given != 0; });
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

    /// Give each ring the layer nearest to it that leaves one for all others; rings less than half a layer
    /// apart, one step of the walls, share theirs.
    void plan_rings()
    {
        const auto layers = static_cast<int>(layers_);
        const std::vector<LinkingMap::Ring>& rings = map_->rings();
        std::vector<int> level; // of each ring, counted from the source
        for (std::size_t r = 0; r < rings.size(); ++r) {
            const bool shared = r > 0 && rings[r].height - rings[r - 1].height < 0.5 / layers;
            level.push_back(r == 0 ? 0 : level.back() + (shared ? 0 : 1));
        }
        const int levels = level.empty() ? 0 : level.back() + 1;
        if (levels >= layers) {
            throw NotSweepable("surface.too_few_layers",
                               name_of(model_, rings.front().pieces.front().edge) +
                                   " runs round the walls between source and target, as do edges at " +
                                   std::to_string(levels) +
                                   " heights in all; each needs a layer to lie on, " +
                                   "which takes layers = " + std::to_string(levels + 1) + " or more, and " +
                                   std::to_string(layers) + " are asked for");
        }
        int last = 0, last_level = -1;
        for (std::size_t r = 0; r < rings.size(); ++r) {
            if (level[r] != last_level) {
                int nearest = 1;
                for (int k = 1; k < layers; ++k) {
                    if (std::abs(heights_[static_cast<std::size_t>(k)] - rings[r].height) <
                        std::abs(heights_[static_cast<std::size_t>(nearest)] - rings[r].height))
                        nearest = k;
                }
                last = std::min(std::max(nearest, last + 1), layers - levels + level[r]);
                last_level = level[r];
            }
            ring_layer_.push_back(last);
        }
    }

    /// Edges that run up the walls without being side lines are refused.
    void check_loose_edges() const
    {
        if (!map_->loose_edges().empty()) {
            const EdgeId edge = map_->loose_edges().front();
            throw NotSweepable("surface.wall_edge",
                               name_of(model_, edge) + beside(edge) +
                                   " runs up the walls and is no side line from a corner of the source to "
                                   "one of the target, so the layers would cut across it; carry it on to "
                                   "both ends, or join the two faces to one");
        }
    }

    /// So are rings that turn or end where no column stands.
    void check_rings() const
    {
        for (const LinkingMap::Ring& ring : map_->rings()) {
            for (const VertexId vertex : ring.vertices) {
                const EdgeId corner = corner_at(ring, vertex);
                if (!corner.valid() || has_column(vertex)) continue;
                throw NotSweepable("surface.wall_edge",
                                   name_of(model_, corner) + beside(corner) + " turns or ends at " +
                                       name_of(model_, vertex) +
                                       ", where no column of nodes stands, so the mesh would cut across it; "
                                       "put a vertex on the source's rim below it with an edge up to it, or "
                                       "join the two faces to one");
            }
        }
    }

    [[nodiscard]] std::string beside(EdgeId edge) const
    {
        std::string text;
        const auto uses = edge_uses(model_);
        for (const FaceUse& use : uses[edge.index()])
            text += (text.empty() ? " between " : " and ") + name_of(model_, use.face);
        return text;
    }

    /// An edge of a ring that turns or ends at a vertex; none where the ring runs on smoothly.
    [[nodiscard]] EdgeId corner_at(const LinkingMap::Ring& ring, VertexId vertex) const
    {
        constexpr double kSmooth = 0.94; ///< cosine of 20°, below which facets' edges count as bent: a choice
        std::vector<Vec3> away;
        std::set<EdgeId> edges;
        for (const LinkingMap::Piece& piece : ring.pieces) edges.insert(piece.edge);
        EdgeId any;
        for (const EdgeId id : edges) {
            const Edge& edge = model_[id];
            const auto leave = [&](Index from, Index to) {
                away.push_back((model_.at(to) - model_.at(from)).normalized());
                any = id;
            };
            if (edge.from == vertex) leave(edge.points[0], edge.points[1]);
            if (edge.to == vertex) leave(edge.points.back(), edge.points[edge.points.size() - 2]);
        }
        return away.size() == 2 && away[0].dot(away[1]) < -kSmooth ? EdgeId() : any;
    }

    /// Whether a node of the walls stands on a vertex.
    [[nodiscard]] bool has_column(VertexId vertex) const
    {
        const Vec3& at = model_.at(model_[vertex].point);
        return std::any_of(mesh_.points.begin(), mesh_.points.end(),
                           [&](const Vec3& p) { return (p - at).norm() <= model_.tolerance; });
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

    /// Where the rings cross a column, by their layers.
    [[nodiscard]] std::map<int, LinkingMap::Crossing> crossings_at(double s) const
    {
        std::map<int, LinkingMap::Crossing> at_layer;
        for (std::size_t r = 0; r < ring_layer_.size(); ++r) {
            const LinkingMap::Ring& ring = map_->rings()[r];
            for (const LinkingMap::Crossing& crossing : LinkingMap::crossings(ring, s)) {
                const auto [found, fresh] = at_layer.try_emplace(ring_layer_[r], crossing);
                if (!fresh && std::abs(crossing.t - ring.height) < std::abs(found->second.t - ring.height))
                    found->second = crossing;
            }
        }
        return at_layer;
    }

    [[nodiscard]] std::vector<double> heights_at(const std::map<int, LinkingMap::Crossing>& crossings) const
    {
        std::map<int, double> at_layer;
        for (const auto& [layer, crossing] : crossings) at_layer[layer] = crossing.t;
        return map_heights(at_layer);
    }

    void mesh_lines()
    {
        for (std::size_t i = 0; i < link_.lines.size(); ++i) {
            if (given_node_[nodes_.line[i]] != 0) continue;
            const Chain chain(model_, link_.lines[i].line.uses);
            std::map<int, double> at_layer;
            for (std::size_t u = 1; u < chain.uses().size(); ++u) {
                const VertexId v = use_from(model_, chain.uses()[u]);
                for (std::size_t r = 0; r < ring_layer_.size(); ++r) {
                    const auto& vertices = map_->rings()[r].vertices;
                    if (std::find(vertices.begin(), vertices.end(), v) != vertices.end()) {
                        at_layer[ring_layer_[r]] = chain.start(u) / chain.length();
                    }
                }
            }
            std::vector<double> at = column_heights(at_layer);
            for (double& t : at) t *= chain.length();
            const std::vector<Vec3> points = chain.points(at);
            for (std::size_t k = 1; k < layers_; ++k) point(k, nodes_.line[i]) = points[k];
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
        if (f.origin == Origin::given && f.kind != "plane" && !inside.empty()) {
            const std::vector<Vec3> patch = inside;
            Projector(model_, {face}).project(inside, context_);
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
        const auto s_of = [&](std::size_t i) {
            return i < count_ ? nodes_.source_at[i] / link_.source.length() : 1.0;
        };
        const std::set<std::size_t> lines(nodes_.line.begin(), nodes_.line.end());
        std::vector<double> before;
        for (std::size_t i = first; i <= last; ++i) {
            const std::map<int, LinkingMap::Crossing> crossings = crossings_at(s_of(i));
            const std::vector<double> at = heights_at(crossings);
            const bool settled = lines.contains(i) || (i < count_ && given_node_[i] != 0);
            for (std::size_t k = 1; k < layers_ && i < last && !settled; ++k) {
                const auto ring = crossings.find(static_cast<int>(k));
                if (ring != crossings.end()) {
                    const double at_edge[] = {ring->second.at};
                    point(k, i) = edge_points(model_, ring->second.edge, at_edge).front();
                    continue;
                }
                const WallPosition place = map_->locate(s_of(i), at[k]);
                on_face[place.face].first.push_back(place.at);
                on_face[place.face].second.push_back(k * count_ + i);
            }
            for (std::size_t k = 0; k < layers_ && i > first && given_side_[i - 1] == 0; ++k) {
                const double t = (at[k] + at[k + 1] + before[k] + before[k + 1]) / 4;
                mesh_.face[k * count_ + i - 1] = map_->locate((s_of(i - 1) + s_of(i)) / 2, t).face;
            }
            before = at;
        }
        for (const auto& [face, work] : on_face) {
            const std::vector<Vec3> points = points_at(model_, face, work.first);
            for (std::size_t j = 0; j < points.size(); ++j) mesh_.points[work.second[j]] = points[j];
        }
    }

    const OpenVolume& volume_;
    const Model& model_;
    const LinkingSurface& link_;
    const LinkingNodes& nodes_;
    std::vector<double> heights_;
    const RunContext& context_;
    std::size_t count_, layers_;
    WallMesh mesh_;
    std::unique_ptr<LinkingMap> map_;
    std::vector<FollowedPanel> followed_;
    std::vector<int> ring_layer_;  ///< of each ring of the map; 0: none
    std::vector<char> given_node_; ///< nodes that are a column's
    std::vector<char> given_side_; ///< sides of the rim that given quads stand on
};

/// The rows of the walls that are there, as a section each.
struct Rows {
    std::vector<std::vector<Vec3>> points; ///< of each row, those of all known columns
    std::vector<Vec3> areas;               ///< Newell vectors of each row's linking surfaces
};

Rows known_rows(const std::vector<WallMesh>& meshes, std::span<const LinkingNodes> nodes,
                const std::vector<FollowedPanel>& followed, std::size_t layers)
{
    Rows rows;
    rows.points.resize(layers + 1);
    rows.areas.assign(layers + 1, Vec3::Zero());
    for (std::size_t b = 0; b < meshes.size(); ++b) {
        const std::size_t n = nodes[b].source_at.size();
        std::vector<bool> known(n, true);
        for (const FollowedPanel& panel : followed) {
            for (std::size_t i = panel.first + 1; panel.link == b && i < panel.last; ++i) known[i] = false;
        }
        for (std::size_t k = 0; k <= layers; ++k) {
            std::vector<Vec3> loop;
            for (std::size_t i = 0; i < n; ++i) {
                if (known[i]) loop.push_back(meshes[b].points[k * n + i]);
            }
            rows.areas[k] += geometry::newell_vector(loop);
            rows.points[k].insert(rows.points[k].end(), loop.begin(), loop.end());
        }
    }
    return rows;
}

/// Put the nodes of followed panels where each row's known columns lead the source rim and the target rim,
/// blended by height and moved to meet the panel's sides.
void follow_rows(std::vector<WallMesh>& meshes, std::span<const LinkingNodes> nodes,
                 const std::vector<FollowedPanel>& followed, std::size_t layers)
{
    const Rows rows = known_rows(meshes, nodes, followed, layers);
    for (std::size_t k = 1; k < layers; ++k) {
        const double t = static_cast<double>(k) / static_cast<double>(layers);
        const geometry::AffineFit up = geometry::fit_affine(rows.points.front(), rows.points[k],
                                                            rows.areas.front(), rows.areas[k]);
        const geometry::AffineFit down = geometry::fit_affine(rows.points.back(), rows.points[k],
                                                              rows.areas.back(), rows.areas[k]);
        for (const FollowedPanel& panel : followed) {
            std::vector<Vec3>& points = meshes[panel.link].points;
            const std::size_t n = nodes[panel.link].source_at.size();
            const auto led = [&](std::size_t i) {
                return Vec3((1 - t) * up(points[i % n]) + t * down(points[layers * n + i % n]));
            };
            const Vec3 left = points[k * n + panel.first % n] - led(panel.first);
            const Vec3 right = points[k * n + panel.last % n] - led(panel.last);
            for (std::size_t i = panel.first + 1; i < panel.last; ++i) {
                const double s = static_cast<double>(i - panel.first) /
                                 static_cast<double>(panel.last - panel.first);
                points[k * n + i] = led(i) + (1 - s) * left + s * right;
            }
        }
    }
}

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
    LinkingNodes nodes;
    std::size_t line = 0;
    for (std::size_t i = 0; i < link.segments.size(); ++i) {
        const RimSegment& segment = link.segments[i];
        while (line < link.lines.size() &&
               link.lines[line].source_at <= segment.source_from + 1e-12 * link.source.length()) {
            nodes.line.push_back(nodes.source_at.size());
            ++line;
        }
        for (const double f : shares[i]) {
            nodes.source_at.push_back(segment.source_from + f * (segment.source_to - segment.source_from));
            nodes.target_at.push_back(segment.target_from + f * (segment.target_to - segment.target_from));
        }
    }
    return nodes;
}

std::vector<WallMesh> mesh_walls(const OpenVolume& volume, std::span<const LinkingSurface> links,
                                 std::span<const LinkingNodes> nodes, std::span<const double> heights,
                                 std::span<const GivenColumns> columns, const RunContext& context)
{
    const GivenColumns none;
    std::vector<WallMesh> meshes;
    std::vector<FollowedPanel> followed;
    for (std::size_t b = 0; b < links.size(); ++b) {
        WallMesher mesher(volume, links[b], nodes[b], columns.empty() ? none : columns[b], heights, context);
        meshes.push_back(mesher.run());
        for (FollowedPanel panel : mesher.followed()) {
            panel.link = b;
            followed.push_back(panel);
        }
    }
    if (!followed.empty()) follow_rows(meshes, nodes, followed, heights.size() - 1);
    return meshes;
}

} // namespace lacuna::surface
