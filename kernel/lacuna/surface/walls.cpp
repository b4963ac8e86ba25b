// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/walls.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/swept_patch.h>
#include <lacuna/geometry/shared/transfinite.h>
#include <lacuna/surface/detail/chain_nodes.h>
#include <lacuna/surface/detail/strip_grid.h>
#include <lacuna/surface/shared/swept_motion.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>

namespace lacuna::surface {

using namespace topology;

namespace {

/// For each side line, the faces of the walls between this line and the next one.
std::vector<std::vector<FaceId>> panel_faces(const Model& model, const LinkingSurface& link)
{
    std::set<EdgeId> borders;
    for (const LinkingLine& line : link.lines) {
        for (const EdgeUse& use : line.line.uses) borders.insert(use.edge);
    }
    const std::set<FaceId> walls(link.walls.begin(), link.walls.end());
    std::vector<std::vector<FaceId>> panels;
    for (const LinkingLine& line : link.lines) {
        const EdgeUse foot =
            link.source.uses()[link.source.position(line.source_at + kSamePlace * link.source.length()).use];
        std::vector<FaceId> faces;
        for (const FaceUse& use : model.uses_of_edge(foot.edge)) {
            if (walls.contains(use.face)) faces.push_back(use.face);
        }
        for (std::size_t i = 0; i < faces.size(); ++i) {
            for (const EdgeUse& use : uses_of(model[faces[i]])) {
                if (borders.contains(use.edge)) continue;
                for (const FaceUse& other : model.uses_of_edge(use.edge)) {
                    const bool known = std::ranges::find(faces, other.face) != faces.end();
                    if (!known && walls.contains(other.face)) faces.push_back(other.face);
                }
            }
        }
        panels.push_back(std::move(faces));
    }
    return panels;
}

/// Meshes one linking surface.
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
          begun_(begin_wall(volume.model, link, nodes, columns, layers_)),
          motion_(swept_motion(volume)),
          line_of_(count_, -1)
    {
        for (std::size_t i = 0; i < nodes.line.size(); ++i) line_of_[nodes.line[i]] = static_cast<int>(i);
    }

    WallMesh run()
    {
        if (!begun_.given.has_sides()) return mesh(true);
        auto following = attempt<NotSweepable>([&] { return mesh(true); });
        if (following) return std::move(*following);
        if (following.why->code() != "surface.wall_edge") following.raise();
        // Columns of given nodes cannot follow an edge between void faces, so such edges are ignored.
        map_.reset();
        net_ = {};
        WallMesh result = mesh(false);
        result.notes.emplace_back("edges between void faces are not followed by the mesh, because "
                                  "the given nodes of the walls leave no column for them");
        return result;
    }

private:
    WallMesh mesh(bool void_edges)
    {
        mesh_ = begun_.mesh;
        on_face_.assign(mesh_.points.size(), FaceId());
        set_row(0, link_.source.points(nodes_.source_at));
        set_row(layers_, target_points(link_, nodes_));
        if (begun_.given.has_all(0, count_)) return std::move(mesh_);
        const auto panels = panel_faces(model_, link_);
        if (moves_along(panels)) {
            mesh_by_motion(panels);
            return std::move(mesh_);
        }
        const bool simple = !panels.empty() &&
                            std::ranges::all_of(panels, [&](const auto& faces) { return is_simple(faces); });
        if (!simple || has_bent_line(model_, link_)) {
            map_ = map_of(volume_, link_, void_edges, context_);
            if (!simple) net_ = wall_net(model_, link_, *map_);
        }
        grid_ = lay_strip({model_, link_, nodes_, heights_, line_of_, begun_}, map_.get(), net_, context_);
        mesh_lines();
        if (panels.empty()) mesh_by_map(0, count_);
        for (std::size_t i = 0; i < panels.size(); ++i) {
            const std::size_t first = nodes_.line[i];
            const std::size_t last = i + 1 < panels.size() ? nodes_.line[i + 1] : count_;
            if (begun_.given.has_all(first, last)) continue;
            if (is_simple(panels[i]))
                mesh_transfinite(panels[i].front(), first, last);
            else
                mesh_by_map(first, last);
        }
        check_stops();
        if (exact_) move_with_rims();
        return std::move(mesh_);
    }

    [[nodiscard]] Vec3& point(std::size_t layer, std::size_t node)
    {
        return mesh_.points[layer * count_ + node % count_];
    }

    void set_row(std::size_t layer, const std::vector<Vec3>& points)
    {
        for (std::size_t i = 0; i < count_; ++i) point(layer, i) = points[i];
    }

    /// Whether the rows of the walls can be placed by a motion: one motion created all walls, and between
    /// each two side lines there is one face for each part of the motion's path.
    [[nodiscard]] bool moves_along(const std::vector<std::vector<FaceId>>& panels) const
    {
        return motion_ && !panels.empty() && std::ranges::all_of(panels, [&](const auto& faces) {
                   return faces.size() + 1 == motion_->levels.size();
               });
    }

    /// Place the rows by moving the source's rim along the path. At the end, the moved rim may differ from
    /// the target's rim. This difference is distributed over the rows in proportion to their heights.
    void mesh_by_motion(const std::vector<std::vector<FaceId>>& panels)
    {
        const geometry::Motion& motion = *motion_;
        std::vector<Vec3> reach(count_, Vec3::Zero()), missed;
        for (std::size_t i = 0; i < count_; ++i) {
            if (motion.reach) reach[i] = motion.reach(point(0, i));
            missed.emplace_back(point(layers_, i) - motion.map(1) * point(0, i) - reach[i]);
        }
        for (std::size_t k = 1; k < layers_; ++k) {
            const Eigen::Affine3d map = motion.map(heights_[k]);
            for (std::size_t i = 0; i < count_; ++i)
                if (!begun_.given.has_node(k, i))
                    point(k, i) = map * point(0, i) + heights_[k] * (reach[i] + missed[i]);
        }
        std::size_t panel = panels.size() - 1;
        for (std::size_t i = 0; i < count_; ++i) {
            if (line_of_[i] >= 0) panel = static_cast<std::size_t>(line_of_[i]);
            for (std::size_t k = 0; k < layers_; ++k) {
                const double middle = (heights_[k] + heights_[k + 1]) / 2;
                const auto above = std::ranges::upper_bound(motion.levels, middle);
                if (begun_.given.side[k * count_ + i] == 0)
                    mesh_.face[k * count_ + i] =
                        panels[panel][static_cast<std::size_t>(above - motion.levels.begin()) - 1];
            }
        }
    }

    [[nodiscard]] bool is_simple(const std::vector<FaceId>& faces) const
    {
        return faces.size() == 1 && model_[faces.front()].loops.size() == 1;
    }

    /// Refuse an edge that turns or ends between columns of given nodes: a node would have to lie there, but
    /// these columns cannot move.
    void check_stops() const
    {
        for (std::size_t i = 0; i < grid_.stops.size(); ++i) {
            const WallNet::Stop& stop = net_.stops[i];
            const Vec3& at = model_.at(model_[stop.vertex].point);
            if ((mesh_.points[grid_.stops[i]] - at).norm() <= model_.tolerance) continue;
            throw NotSweepable(
                Message("surface.wall_edge",
                        "{} turns or ends at {}, where the given nodes of walls or ends allow no column",
                        entity_of(model_, net_.columns[stop.column].edge), entity_of(model_, stop.vertex))
                    .remedy("load with keep_mesh = false, or merge the two adjacent faces"));
        }
    }

    /// The position of a node on an edge of the net; empty if the node is on none.
    [[nodiscard]] std::optional<Vec3> pinned_point(std::size_t layer, std::size_t node) const
    {
        const auto found = grid_.on_edge.find(layer * count_ + node);
        if (found == grid_.on_edge.end()) return std::nullopt;
        return edge_points(model_, found->second.edge, std::array{found->second.share}).front();
    }

    void mesh_lines()
    {
        for (std::size_t i = 0; i < link_.lines.size(); ++i) {
            const std::size_t node = nodes_.line[i];
            const Chain chain(model_, link_.lines[i].line.uses);
            const auto share = [&](double t) { return map_ ? map_->share_of_line(i, t) : t; };
            std::vector<double> at;
            for (std::size_t k = 0; k <= layers_; ++k)
                at.push_back(share(grid_.place[k * count_ + node].y()) * chain.length());
            // A level that other walls or neighbours prescribed at a vertex of the line is known up to the
            // accuracy of their maps alone.
            for (std::size_t use = 1; use < chain.uses().size(); ++use) {
                const double vertex = chain.start(use);
                for (std::size_t k = 1; k < layers_; ++k)
                    if (std::abs(at[k] - vertex) <= kAlikeSizes * (at[k + 1] - at[k - 1]) / 2) at[k] = vertex;
            }
            const std::vector<Vec3> points = chain.points(at);
            for (std::size_t k = 1; k < layers_; ++k) {
                if (!begun_.given.has_node(k, node))
                    point(k, node) = pinned_point(k, node).value_or(points[k]);
            }
        }
    }

    void mesh_transfinite(FaceId face, std::size_t first, std::size_t last)
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
        // Flat faces use the plain transfinite patch, so that an affine block stays affine up to rounding. It
        // lies in their plane. Their facets do not cover it between the chords of a rim and its curve.
        const bool flat = model_[face].kind == "plane" || plane_of(model_, face);
        const std::vector<Vec3> grid = flat || model_[face].geometry == Geometry::newell
                                           ? geometry::transfinite(bottom, right, top, left)
                                           : geometry::swept_grid(bottom, right, top, left);
        std::vector<Vec3> inside;
        for (std::size_t k = 1; k < layers_; ++k) {
            for (std::size_t i = 1; i < n; ++i) inside.push_back(grid[k * (n + 1) + i]);
        }
        if (!flat && !inside.empty()) {
            if (exact_) {
                Projector(model_, {face}).project(inside, context_);
            } else {
                const geometry::FacetTree tree(model_.points, model_[face].triangles);
                for (Vec3& p : inside) p = tree.closest(p).point;
            }
        }
        std::size_t next = 0;
        for (std::size_t k = 1; k < layers_; ++k) {
            for (std::size_t i = 1; i < n; ++i) {
                point(k, first + i) = inside[next++];
                if (!flat) on_face_[k * count_ + first + i] = face;
            }
        }
        for (std::size_t k = 0; k < layers_; ++k) {
            for (std::size_t i = first; i < last; ++i) mesh_.face[k * count_ + i] = face;
        }
    }

    void mesh_by_map(std::size_t first, std::size_t last)
    {
        std::vector<WallPosition> places;
        std::vector<std::size_t> nodes;
        for (std::size_t i = first; i < last; ++i) {
            for (std::size_t k = 1; k < layers_ && line_of_[i] < 0; ++k) {
                if (begun_.given.has_node(k, i)) continue;
                if (const std::optional<Vec3> pinned = pinned_point(k, i)) {
                    point(k, i) = *pinned;
                    continue;
                }
                const Vec2& at = grid_.place[k * count_ + i];
                places.push_back(map_->locate(at.x(), at.y()));
                nodes.push_back(k * count_ + i);
            }
            for (std::size_t k = 0; k < layers_; ++k) {
                if (begun_.given.side[k * count_ + i] != 0) continue;
                Vec2 next = grid_.place[k * count_ + (i + 1) % count_] +
                            grid_.place[(k + 1) * count_ + (i + 1) % count_];
                if (i + 1 == count_) next.x() += 2;
                const Vec2 at = (grid_.place[k * count_ + i] + grid_.place[(k + 1) * count_ + i] + next) / 4;
                mesh_.face[k * count_ + i] = map_->locate(at.x(), at.y()).face;
            }
        }
        const std::vector<Vec3> points = points_at(model_, places, exact_);
        for (std::size_t j = 0; j < points.size(); ++j) {
            mesh_.points[nodes[j]] = points[j];
            on_face_[nodes[j]] = places[j].face;
        }
    }

    /// The facets of a void face without an exact surface are chords of its rims, which may be exact curves.
    /// Move the nodes inside such faces by what the nodes next above and below, on the rims, lie off the
    /// facets.
    void move_with_rims()
    {
        std::map<FaceId, Projector> projectors; // created on first use
        const auto is_inside = [&](std::size_t node) {
            const FaceId face = on_face_[node];
            return face.valid() && model_[face].origin == Origin::made_void && !model_[face].surface;
        };
        const auto off_facets = [&](std::size_t k, std::size_t i, FaceId face) -> Vec3 {
            const bool on_rim = k == 0 || k == layers_ || grid_.on_edge.contains(k * count_ + i);
            if (!on_rim || begun_.given.has_node(k, i)) return Vec3::Zero();
            std::array foot{point(k, i)};
            projectors.try_emplace(face, model_, std::vector{face}).first->second.project(foot, context_);
            return point(k, i) - foot[0];
        };
        for (std::size_t i = 0; i < count_; ++i) {
            for (std::size_t low = 0, k = 1; k <= layers_; ++k) {
                if (is_inside(k * count_ + i)) continue;
                if (k > low + 1) {
                    const Vec3 below = off_facets(low, i, on_face_[(low + 1) * count_ + i]),
                               above = off_facets(k, i, on_face_[(k - 1) * count_ + i]);
                    const auto height = [&](std::size_t j) { return grid_.place[j * count_ + i].y(); };
                    for (std::size_t j = low + 1; j < k; ++j) {
                        const double share = (height(j) - height(low)) / (height(k) - height(low));
                        point(j, i) += (1 - share) * below + share * above;
                    }
                }
                low = k;
            }
        }
    }

    const OpenVolume& volume_;
    const Model& model_;
    const LinkingSurface& link_;
    const LinkingNodes& nodes_;
    std::vector<double> heights_;
    bool exact_; ///< true: nodes lie on exact faces; false: on the facets
    const RunContext& context_;
    std::size_t count_, layers_;
    BegunWall begun_;
    geometry::MotionPointer motion_; ///< the motion that made the walls; null: none
    WallMesh mesh_;
    std::vector<FaceId> on_face_; ///< for each node inside a face that is not flat, the face
    std::shared_ptr<const LinkingMap> map_;
    WallNet net_;
    StripGrid grid_;
    std::vector<int> line_of_; ///< for each node of the rim, its side line; -1: none
};

} // namespace

LinkingNodes linking_nodes(const LinkingSurface& link, std::span<const std::vector<double>> source,
                           std::span<const std::vector<double>> target)
{
    LinkingNodes nodes;
    std::size_t line = 0;
    for (std::size_t i = 0; i < link.segments.size(); ++i) {
        const RimSegment& segment = link.segments[i];
        while (line < link.lines.size() &&
               link.lines[line].source_at <= segment.source_from + kRoundoff * link.source.length()) {
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

std::vector<Vec3> target_points(const LinkingSurface& link, const LinkingNodes& nodes)
{
    std::vector<double> at = nodes.target_at;
    for (double& x : at) x = link.target.wrapped(x);
    return link.target.points(at);
}

std::vector<WallMesh> mesh_walls(const OpenVolume& volume, std::span<const LinkingSurface> links,
                                 std::span<const LinkingNodes> nodes, std::span<const double> heights,
                                 std::span<const GivenColumns> columns, const RunContext& context, bool exact)
{
    const GivenColumns none;
    std::vector<WallMesh> meshes;
    for (std::size_t b = 0; b < links.size(); ++b) {
        const GivenColumns& given = columns.empty() ? none : columns[b];
        meshes.push_back(WallMesher(volume, links[b], nodes[b], given, heights, exact, context).run());
    }
    return meshes;
}

std::size_t check_wall_edges(const OpenVolume& volume, const RunContext& context)
{
    std::ptrdiff_t inside = 0;
    for (const LinkingSurface& link : linking_surfaces(volume, Turning::each, {}, context)) {
        if (edges_between(volume.model, link, true).empty()) continue;
        const WallNet net = wall_net(volume.model, link, *map_of(volume, link, true, context));
        inside += std::ranges::count_if(net.stops, [](const WallNet::Stop& stop) { return stop.level >= 0; });
    }
    return static_cast<std::size_t>(inside);
}

} // namespace lacuna::surface
