// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/source_mesh.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/geometry/shared/transfinite.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/surface/detail/face_sides.h>
#include <lacuna/surface/detail/linking_map.h>
#include <lacuna/surface/shared/fill_face.h>
#include <lacuna/surface/shared/projector.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>
#include <utility>

namespace lacuna::surface {

using namespace topology;

namespace {

class SourceMesher {
public:
    SourceMesher(const OpenVolume& volume, std::span<const LinkingSurface> links, const Seeds& seeds,
                 const SizeFields& sizes, const quads::PlanarQuadMesher& mesher, const RunContext& context)
        : volume_(volume),
          model_(volume.model),
          seeds_(seeds),
          sizes_(sizes),
          mesher_(mesher),
          context_(context)
    {
        for (const LinkingSurface& link : links) add_link(link);
        for (const FaceId face : volume.faces(Role::source)) {
            for (const Loop& loop : is_filled(face) ? border_loops(model_, face) : model_[face].loops) {
                for (const EdgeUse& use : loop.uses) add_edge(use.edge);
            }
        }
    }

    SourceMesh run()
    {
        for (const FaceId face : volume_.faces(Role::source)) {
            const auto corners = seeds_.corners.find(face);
            const std::size_t before = result_.quads.quads.size();
            how_ = seeds_.kept.contains(face) ? "kept" : "mapped";
            if (seeds_.kept.contains(face))
                keep(face);
            else if (corners != seeds_.corners.end())
                map_or_fill(face, corners->second);
            else if (seeds_.tubes.contains(face))
                map_tube(face);
            else
                fill(face);
            result_.quads.face.resize(result_.quads.quads.size(), static_cast<Index>(face.index()));
            const std::vector<Quad>& cells = result_.quads.quads;
            const auto triangles = static_cast<std::size_t>(std::count_if(
                cells.begin() + static_cast<std::ptrdiff_t>(before), cells.end(), mesh::is_triangle));
            std::string line = formatted("{}: {}, {} quads", entity_of(model_, face), how_,
                                         cells.size() - before - triangles);
            if (triangles > 0) line += formatted(", {} triangles", triangles);
            result_.notes.push_back(std::move(line));
        }
        put_triangles_last();
        // Face normals point outward, but normals of quads must point along the sweep.
        for (Quad& quad : result_.quads.quads) quad = mesh::turned_over(quad);
        return std::move(result_);
    }

private:
    [[nodiscard]] bool is_filled(FaceId face) const
    {
        return !seeds_.kept.contains(face) && !seeds_.corners.contains(face);
    }

    void put_triangles_last()
    {
        const std::vector<Quad> cells = std::exchange(result_.quads.quads, {});
        const std::vector<Index> face = std::exchange(result_.quads.face, {});
        for (const bool triangles : {false, true}) {
            for (std::size_t q = 0; q < cells.size(); ++q) {
                if (mesh::is_triangle(cells[q]) != triangles) continue;
                result_.quads.quads.push_back(cells[q]);
                result_.quads.face.push_back(face[q]);
            }
        }
    }

    Index add_node(const Vec3& p)
    {
        result_.quads.nodes.push_back(p);
        return static_cast<Index>(result_.quads.nodes.size()) - 1;
    }

    void add_link(const LinkingSurface& link)
    {
        LinkingNodes nodes = seeds_.nodes(link);
        const auto first = static_cast<Index>(result_.quads.nodes.size());
        const std::vector<Vec3> points = link.source.points(nodes.source_at);
        for (const Vec3& p : points) add_node(p);
        std::vector<Index>& loop = result_.quads.loops.emplace_back();
        for (std::size_t i = points.size(); i-- > 0;) loop.push_back(first + static_cast<Index>(i));

        // Store the nodes of each edge in the direction of the edge.
        std::size_t i = 0;
        for (std::size_t u = 0; u < link.source.uses().size(); ++u) {
            const EdgeUse use = link.source.uses()[u];
            std::vector<Index> chain;
            for (int k = 0; k <= seeds_.count(use.edge); ++k)
                chain.push_back(first +
                                static_cast<Index>((i + static_cast<std::size_t>(k)) % points.size()));
            i += chain.size() - 1;
            node_of_[use_from(model_, use)] = chain.front();
            if (use.reversed) std::ranges::reverse(chain);
            result_.on_edge[use.edge] = std::move(chain);
        }
        result_.links.push_back(std::move(nodes));
        result_.first.push_back(first);
    }

    void add_edge(EdgeId edge)
    {
        if (result_.on_edge.contains(edge)) return;
        const std::vector<Vec3> points = edge_points(model_, edge, seeds_.fractions(edge));
        std::vector<Index> chain;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (i > 0 && i + 1 < points.size()) {
                chain.push_back(add_node(points[i]));
                continue;
            }
            const auto [found, fresh] = node_of_.try_emplace(i == 0 ? model_[edge].from : model_[edge].to,
                                                             -1);
            if (fresh) found->second = add_node(points[i]);
            chain.push_back(found->second);
        }
        result_.on_edge[edge] = std::move(chain);
    }

    [[nodiscard]] std::vector<Index> nodes_along(EdgeUse use) const
    {
        std::vector<Index> chain = result_.on_edge.at(use.edge);
        if (use.reversed) std::ranges::reverse(chain);
        return chain;
    }

    /// Mesh a kept face: copy its given quads and triangles, node for node.
    void keep(FaceId face)
    {
        std::unordered_map<Index, Index> node_of_point;
        for (const EdgeUse& use : uses_of(model_[face])) {
            const std::vector<Index> points = use_points(model_, use), nodes = nodes_along(use);
            for (std::size_t i = 0; i < points.size(); ++i) node_of_point[points[i]] = nodes[i];
        }
        std::vector<Quad> cells = model_[face].given_quads;
        for (const Triangle& t : loose_triangles(model_[face])) cells.push_back({t[0], t[1], t[2], t[2]});
        for (const Quad& quad : cells) {
            Quad kept{};
            for (std::size_t k = 0; k < 4; ++k) {
                const auto [found, fresh] = node_of_point.try_emplace(quad[k], -1);
                if (fresh) found->second = add_node(model_.at(quad[k]));
                kept[k] = found->second;
            }
            result_.quads.quads.push_back(kept);
        }
    }

    /// Mesh a mapped face by a grid between four sides.
    void map(FaceId face, const std::vector<std::size_t>& corners)
    {
        const Loop& loop = model_[face].loops[0];
        const std::size_t uses = loop.uses.size();
        std::array<std::vector<Index>, 4> side;
        for (std::size_t s = 0; s < 4; ++s) {
            for (std::size_t i = corners[s]; i != corners[(s + 1) % 4]; i = (i + 1) % uses) {
                const std::vector<Index> chain = nodes_along(loop.uses[i]);
                side[s].insert(side[s].end(), chain.begin() + (side[s].empty() ? 0 : 1), chain.end());
            }
        }
        std::ranges::reverse(side[2]);
        std::ranges::reverse(side[3]);
        const std::size_t n = side[0].size() - 1, m = side[1].size() - 1;
        const auto places = [&](const std::vector<Index>& nodes) {
            std::vector<Vec3> points;
            for (const Index node : nodes)
                points.push_back(result_.quads.nodes[static_cast<std::size_t>(node)]);
            return points;
        };
        const std::vector<Vec3> grid = geometry::transfinite(places(side[0]), places(side[1]),
                                                             places(side[2]), places(side[3]));
        std::vector<Vec3> inside;
        for (std::size_t j = 1; j < m; ++j)
            inside.insert(inside.end(), grid.begin() + static_cast<std::ptrdiff_t>(j * (n + 1) + 1),
                          grid.begin() + static_cast<std::ptrdiff_t>(j * (n + 1) + n));
        if (model_[face].kind != "plane" && !inside.empty())
            Projector(model_, {face}).project(inside, context_);
        const auto first = static_cast<Index>(result_.quads.nodes.size());
        result_.quads.nodes.insert(result_.quads.nodes.end(), inside.begin(), inside.end());
        const auto node = [&](std::size_t i, std::size_t j) {
            if (j == 0) return side[0][i];
            if (j == m) return side[2][i];
            if (i == 0) return side[3][j];
            if (i == n) return side[1][j];
            return first + static_cast<Index>((j - 1) * (n - 1) + i - 1);
        };
        for (std::size_t j = 0; j < m; ++j) {
            for (std::size_t i = 0; i < n; ++i)
                result_.quads.quads.push_back(
                    {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
        }
    }

    /// Mesh a mapped face. A flat one that winds, so that its grid is poor, is filled instead if its quads
    /// are good then.
    void map_or_fill(FaceId face, const std::vector<std::size_t>& corners)
    {
        mesh::QuadMesh& mesh = result_.quads;
        const auto nodes = std::ssize(mesh.nodes), quads = std::ssize(mesh.quads);
        map(face, corners);
        if (model_[face].kind != "plane" || !mesher_ || !seeds_.rows.empty()) return;
        if (least_of(face, quads) >= kPoorCell) return;
        const std::vector<Vec3> grid_nodes(mesh.nodes.begin() + nodes, mesh.nodes.end());
        const std::vector<Quad> grid(mesh.quads.begin() + quads, mesh.quads.end());
        mesh.nodes.resize(static_cast<std::size_t>(nodes));
        mesh.quads.resize(static_cast<std::size_t>(quads));
        fill(face);
        if (least_of(face, quads) >= kPoorCell) return;
        mesh.nodes.resize(static_cast<std::size_t>(nodes));
        mesh.quads.resize(static_cast<std::size_t>(quads));
        mesh.nodes.insert(mesh.nodes.end(), grid_nodes.begin(), grid_nodes.end());
        mesh.quads.insert(mesh.quads.end(), grid.begin(), grid.end());
        how_ = "mapped";
    }

    /// The least scaled Jacobian of the quads from the given one on, seen along the normal of their face.
    [[nodiscard]] double least_of(FaceId face, std::ptrdiff_t first) const
    {
        const Vec3 normal = face_area_vector(model_, face).stableNormalized(), u = normal.unitOrthogonal(),
                   v = normal.cross(u);
        double least = 1;
        for (auto quad = result_.quads.quads.begin() + first; quad != result_.quads.quads.end(); ++quad) {
            std::array<Vec2, 4> corners;
            for (std::size_t k = 0; k < 4; ++k) {
                const Vec3& p = result_.quads.nodes[index((*quad)[k])];
                corners[k] = Vec2(p.dot(u), p.dot(v));
            }
            least = std::min(least, quads::scaled_jacobian(corners, {0, 1, 2, 3}));
        }
        return least;
    }

    /// The nodes of a closed chain of edges, and their running lengths.
    struct ChainNodes {
        std::vector<Index> nodes;
        std::vector<double> at;
    };

    [[nodiscard]] ChainNodes nodes_of(const Chain& chain) const
    {
        ChainNodes result;
        for (std::size_t u = 0; u < chain.uses().size(); ++u) {
            const EdgeUse use = chain.uses()[u];
            const std::vector<Index> nodes = nodes_along(use);
            const std::vector<double> share = seeds_.fractions(use.edge);
            const double length = chain.start(u + 1) - chain.start(u);
            for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
                const double along = use.reversed ? 1 - share[share.size() - 1 - i] : share[i];
                result.nodes.push_back(nodes[i]);
                result.at.push_back(chain.start(u) + along * length);
            }
        }
        return result;
    }

    /// Mesh a tube by a grid around it, as a wall between its two loops. The number of rows follows from the
    /// mean size.
    void map_tube(FaceId face)
    {
        const LinkingSurface link = tube_link(volume_, face, context_);
        const ChainNodes low = nodes_of(link.source), high = nodes_of(link.target);
        const std::size_t n = low.nodes.size();
        const double length = link.target.length(), start = link.segments.front().target_from;
        const auto first = std::ranges::min_element(
            high.at, {}, [&](double at) { return std::abs(std::remainder(at - start, length)); });
        std::vector<Index> top(high.nodes);
        const auto begin = first - high.at.begin();
        LinkingNodes rim{low.at, high.at, {}};
        std::ranges::rotate(top, top.begin() + begin);
        std::ranges::rotate(rim.target_at, rim.target_at.begin() + begin);
        for (double& at : rim.target_at)
            if (at < rim.target_at.front()) at += length;

        double sides = 0, area = 0;
        for (const Triangle& t : model_[face].triangles) {
            const double own = facet_area_vector(model_, t).norm();
            const Vec3 middle = (model_.at(t[0]) + model_.at(t[1]) + model_.at(t[2])) / 3;
            sides += own / sizes_.edge(middle);
            area += own;
        }
        const double rows = map_of(volume_, link, true, context_)->height() * sides / area;
        const auto m = static_cast<std::size_t>(std::max(1.0, std::round(rows)));
        std::vector<double> heights;
        for (std::size_t k = 0; k <= m; ++k)
            heights.push_back(static_cast<double>(k) / static_cast<double>(m));
        const WallMesh grid = mesh_walls(volume_, {&link, 1}, {&rim, 1}, heights, {}, context_).front();
        std::vector<std::vector<Index>> row{low.nodes};
        for (std::size_t k = 1; k <= m; ++k) {
            std::vector<Index>& above = row.emplace_back(k == m ? top : std::vector<Index>());
            for (std::size_t i = 0; i < n && k < m; ++i) above.push_back(add_node(grid.points[k * n + i]));
            for (std::size_t i = 0; i < n; ++i) {
                const std::size_t next = (i + 1) % n;
                result_.quads.quads.push_back({row[k - 1][i], above[i], above[next], row[k - 1][next]});
            }
        }
        if (volume_.faces(Role::source).size() == 1) result_.rows = std::move(row);
    }

    /// The boundary rows along a face's rim, for rim nodes in the order of `border_loops()`.
    [[nodiscard]] quads::BoundaryRows rows_along(FaceId face, const std::vector<RimNode>& rim) const
    {
        quads::BoundaryRows rows;
        rows.heights = seeds_.rows.heights;
        rows.turn.assign(rim.size(), quads::RowTurn::smooth);
        rows.table.assign(rim.size(), -1);
        if (seeds_.rows.empty()) return rows;
        std::size_t next = 0;
        for (const Loop& loop : border_loops(model_, face)) {
            for (std::size_t u = 0; u < loop.uses.size(); ++u) {
                const EdgeUse use = loop.uses[u];
                const double angle = loop.uses.size() > 1 ? inner_angle(model_, face, loop, u) : 180;
                if (angle < kCornerBelow) rows.turn[next] = quads::RowTurn::inner;
                if (angle > kReversalAbove) rows.turn[next] = quads::RowTurn::outer;
                std::vector<double> at = seeds_.fractions(use.edge);
                if (use.reversed) std::ranges::reverse(at);
                for (std::size_t i = 0; i + 1 < at.size(); ++i, ++next) {
                    const RimRows::Part* part = seeds_.rows.part_at(use.edge, (at[i] + at[i + 1]) / 2);
                    if (part != nullptr) rows.table[next] = part->table;
                }
            }
        }
        return rows;
    }

    /// Report rows that do not fit: name the wall to which they belong, and the edge along which they run.
    [[noreturn]] void refuse_rows(FaceId face, const std::vector<RimNode>& rim,
                                  const quads::RowsFinding& finding) const
    {
        using Why = quads::RowsFinding::Why;
        const RimNode& node = rim[static_cast<std::size_t>(finding.node)];
        FaceId of;
        for (const auto& [edge, parts] : seeds_.rows.parts) {
            for (const RimRows::Part& part : parts) {
                if (part.table == finding.table && (edge == node.edge || !of.valid())) of = part.wall;
            }
        }
        const Argument wall = of.valid() ? Argument(entity_of(model_, of)) : "a wall";
        const NamedEntity along = entity_of(model_, node.edge), in = entity_of(model_, face);
        const std::string place = place_with_digits(node.point, 4);
        switch (finding.why) {
        case Why::no_room:
            throw NotSweepable(
                Message("surface.layers_room",
                        "the boundary layers of {} along {} of {} are {:.4g} high in total, but only {:.4g} "
                        "are free near {} up to the opposite side, including its own rows",
                        wall, along, in, needed(finding.asked), found(finding.found), place)
                    .remedy("use fewer or thinner rows"));
        case Why::sharp_bend:
            throw NotSweepable(Message("surface.layers_bend",
                                       "the boundary layers of {} along {} of {} fold near {} at a height of "
                                       "{:.4g}, where there is only room for {:.4g}",
                                       wall, along, in, place, needed(finding.asked), found(finding.found))
                                   .remedy("use fewer or thinner rows, or a smaller 'size'"));
        case Why::off_height:
            throw NotSweepable(
                Message("surface.layers_ends",
                        "the boundary layers of {} along {} of {} end near {} on nodes at height "
                        "{:.4g} instead of {:.4g}; these are given nodes, or the edge is too short for "
                        "the rows",
                        wall, along, in, place, found(finding.found), needed(finding.asked))
                    .remedy("load with keep_mesh = false, or use fewer or thinner rows"));
        case Why::unlike:
            break;
        }
        throw NotSweepable(Message("surface.layers_meet",
                                   "the boundary layers of {} along {} of {} continue into those of the next "
                                   "wall near {} without a corner, but the two differ",
                                   wall, along, in, place)
                               .remedy("give both walls the same table"));
    }

    /// Mesh a free face by the planar mesher. A seam lies inside such a face and gets no nodes; a pole is an
    /// ordinary point.
    void fill(FaceId face)
    {
        if (!mesher_) {
            throw NotSweepable(Message("surface.no_mesher",
                                       "{} is not four-sided, and no planar mesher is available",
                                       entity_of(model_, face))
                                   .remedy("sweep with quads = \"paved\""));
        }
        std::vector<Index> boundary;
        std::vector<RimNode> rim;
        std::vector<std::vector<Index>> loops;
        for (const Loop& loop : border_loops(model_, face)) {
            std::vector<Index>& cycle = loops.emplace_back();
            for (const EdgeUse& use : loop.uses) {
                const std::vector<Index> chain = nodes_along(use);
                std::vector<double> fractions = seeds_.fractions(use.edge);
                if (use.reversed) std::ranges::reverse(fractions);
                for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
                    cycle.push_back(static_cast<Index>(rim.size()));
                    boundary.push_back(chain[i]);
                    rim.push_back(
                        {result_.quads.nodes[static_cast<std::size_t>(chain[i])], use.edge, fractions[i]});
                }
            }
        }
        const quads::BoundaryRows rows = rows_along(face, rim);
        const bool any = std::ranges::any_of(rows.table, [](int t) { return t >= 0; });
        const FaceQuads filling = fill_face(model_, face, rim, loops, sizes_, mesher_, any ? &rows : nullptr,
                                            context_);
        if (filling.finding) refuse_rows(face, rim, *filling.finding);
        how_ = filling.how.empty() ? "free" : filling.how;
        std::vector<Index> node = std::move(boundary);
        for (std::size_t p = rim.size(); p < filling.points.size(); ++p)
            node.push_back(add_node(filling.points[p]));
        for (const Quad& q : filling.quads) {
            Quad mapped{};
            for (std::size_t i = 0; i < 4; ++i) mapped[i] = node[static_cast<std::size_t>(q[i])];
            result_.quads.quads.push_back(mapped);
        }
    }

    const OpenVolume& volume_;
    const Model& model_;
    const Seeds& seeds_;
    const SizeFields& sizes_;
    const quads::PlanarQuadMesher& mesher_;
    const RunContext& context_;
    SourceMesh result_;
    std::string how_; ///< the method by which the last face was meshed
    std::map<VertexId, Index> node_of_;
};

} // namespace

SourceMesh mesh_source(const OpenVolume& volume, std::span<const LinkingSurface> links, const Seeds& seeds,
                       const SizeFields& sizes, const quads::PlanarQuadMesher& mesher,
                       const RunContext& context)
{
    return SourceMesher(volume, links, seeds, sizes, mesher, context).run();
}

} // namespace lacuna::surface
