// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/assembly_plan.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/shared/seeds.h>
#include <lacuna/sweep/detail/edge_counts.h>
#include <lacuna/sweep/detail/plan_heights.h>
#include <lacuna/sweep/detail/rim_arcs.h>
#include <lacuna/sweep/detail/same_edges.h>
#include <lacuna/sweep/detail/shared_faces.h>
#include <lacuna/topology/shared/give_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Points in the order in which they were added, found by their place in a grid of cells.
class PointsByPlace {
public:
    explicit PointsByPlace(double cell) : cell_(cell) {}

    [[nodiscard]] const std::vector<Vec3>& points() const { return points_; }
    void add(const Vec3& p)
    {
        cells_[cell_at(p)].push_back(points_.size());
        points_.push_back(p);
    }
    /// The first point within the tolerance; without one, `p` is added.
    std::size_t find_or_add(const Vec3& p, double tolerance)
    {
        std::size_t first = points_.size();
        const Cell low = cell_at(p.array() - tolerance), high = cell_at(p.array() + tolerance);
        for (Cell at = low; at[0] <= high[0]; ++at[0])
            for (at[1] = low[1]; at[1] <= high[1]; ++at[1])
                for (at[2] = low[2]; at[2] <= high[2]; ++at[2])
                    if (const auto cell = cells_.find(at); cell != cells_.end())
                        for (const std::size_t other : cell->second)
                            if ((points_[other] - p).norm() <= tolerance) first = std::min(first, other);
        if (first == points_.size()) add(p);
        return first;
    }

private:
    using Cell = std::array<double, 3>; ///< whole numbers
    [[nodiscard]] Cell cell_at(const Vec3& p) const
    {
        return {std::floor(p.x() / cell_), std::floor(p.y() / cell_), std::floor(p.z() / cell_)};
    }

    double cell_;
    std::vector<Vec3> points_;
    std::map<Cell, std::vector<std::size_t>> cells_;
};
/// Distribute `count` sides over the intervals of a line. Every interval gets one side; then each further
/// side goes to the interval whose sides are longest.
/// @param ends  positions of the vertices between the intervals, as shares of the line's length, from 0 to 1.
/// @return  positions of the nodes, as shares of the line's length.
std::vector<double> spread_between(const std::vector<double>& ends, std::size_t count)
{
    std::vector<int> parts(ends.size() - 1, 1);
    const auto side = [&](std::size_t i) { return (ends[i + 1] - ends[i]) / parts[i]; };
    for (std::size_t k = parts.size(); k < count; ++k) {
        std::size_t longest = 0;
        for (std::size_t i = 1; i < parts.size(); ++i)
            if (side(i) > side(longest) * (1 + kVisible)) longest = i;
        ++parts[longest];
    }
    std::vector<double> at{0};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (int k = 1; k <= parts[i]; ++k) at.push_back(k == parts[i] ? ends[i + 1] : ends[i] + k * side(i));
    }
    return at;
}

/// Places the nodes of shared edges.
class NodePlacer {
public:
    NodePlacer(const SameEdges& edges, const EdgeCounts& counts) : edges_(edges), counts_(counts)
    {
        if (!edges.periodic().empty()) grid_ = grid_of(edges.members());
    }

    AssemblyPlan run()
    {
        AssemblyPlan plan;
        tie_corners();
        double all = 0;
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (counts_.is_planned(e)) all += counts_.sides_of(e);
        }
        if (all > kMostCells)
            throw InvalidInput(Message("sweep.too_many",
                                       "the edges shared by volumes of the assembly would have {:.0f} sides, "
                                       "more than memory allows",
                                       found(all))
                                   .remedy("use a larger 'size' or fewer 'layers'"));
        plan.nodes.resize(edges_.members().size());
        plan.layers.assign(edges_.members().size(), 0);
        std::map<std::size_t, std::vector<Vec3>> nodes;
        for (const auto& [m, sides] : counts_.side_lines())
            for (const EdgeUse& side : sides)
                side_lines_[edges_.set_of(edges_.number(m, side.edge))].emplace_back(m, side);
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (edges_.model(edges_[e].member)[edges_[e].edge].curve != nullptr)
                curved_one_.emplace(edges_.set_of(e), e);
            if (!is_imprinted(e) || edges_.kept_one(edges_.set_of(e)) != nullptr) continue;
            imprinted_one_.emplace(edges_.set_of(e), e);
            for (const Vec3& end : {edges_[e].from, edges_[e].to})
                corner_at(end, edges_.model(edges_[e].member).tolerance);
        }
        for (const auto& [m, sides] : counts_.side_lines()) {
            const bool beside = std::ranges::any_of(sides, [&, m = m](const EdgeUse& side) {
                return counts_.is_planned(edges_.number(m, side.edge));
            });
            if (beside) plan.layers[m] = counts_.sides_of(edges_.number(m, sides.front().edge));
        }
        for (const auto& [m, lines] : counts_.stacks()) plan_stacks(m, lines, nodes, plan);
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            // The triangles of a face without quads only define its shape. Given nodes on its rim are dropped
            // if the planned number of sides differs.
            const bool gives_way = edges_.kept(e) == SameEdges::Kept::rim &&
                                   edges_.given_sides(e) != counts_.sides_of(e);
            const bool placed = (counts_.is_planned(e) || gives_way) && counts_.is_on_frame(e);
            auto found = nodes.find(edges_.set_of(e));
            const bool in_stack = found != nodes.end() && counts_.is_on_frame(e);
            if (!placed && !in_stack && !is_kept_elsewhere(e)) continue;
            if (found == nodes.end()) {
                const std::size_t one = placed ? exact_one(e) : *edges_.kept_one(edges_.set_of(e));
                const int sides = placed ? counts_.sides_of(e) : edges_.given_sides(one);
                std::vector<Vec3> made = at_home(places(one, sides), one);
                found = nodes.emplace(edges_.set_of(e), std::move(made)).first;
            }
            std::vector<Vec3> own = from_home(found->second, e);
            turn(own, edges_[e]);
            if (!edges_[e].closed) {
                own.front() = corner_at(own.front(), edges_.model(edges_[e].member).tolerance);
                own.back() = corner_at(own.back(), edges_.model(edges_[e].member).tolerance);
            }
            plan.nodes[edges_[e].member].push_back({edges_[e].edge, std::move(own)});
        }
        plan.heights = counts_.heights();
        return plan;
    }

private:
    /// Nodes of an edge that several members share, in the direction of the first member's edge.
    [[nodiscard]] std::vector<Vec3> places(std::size_t e, int count) const
    {
        const MemberEdge& edge = edges_[e];
        if (edges_.kept(e) != SameEdges::Kept::no && edges_.given_sides(e) == count)
            return surface::edge_line(edges_.model(edge.member), edge.edge);
        const std::size_t set = edges_.set_of(e);
        if (const EdgeCounts::Followed* followed = counts_.followed(set)) {
            const auto& [own, ends] = *followed;
            if (static_cast<std::size_t>(count) + 1 >= ends.size())
                return surface::edge_points(edges_.model(edges_[own].member), edges_[own].edge,
                                            spread_between(ends, static_cast<std::size_t>(count)));
        }
        std::vector<double> at = counts_.spread(e, count);
        // If the edge is a side line of a member that requires a spacing of its layers, use this spacing.
        if (const auto lines = side_lines_.find(set); lines != side_lines_.end())
            for (const auto& [m, side] : lines->second) {
                const bool by_levels = std::cmp_equal(counts_.heights()[m].size(), count);
                const LayerSpec& spec = edges_.members()[m].options.layers;
                LayerSpec whole = spec;
                if (by_levels)
                    whole.heights = counts_.heights()[m];
                else if (whole.heights.empty())
                    whole.count = count;
                at = layer_heights(whole);
                if (edges_.members()[m].volume->turned_round && !by_levels) reverse_heights(at);
                at = counts_.on_line(m, side.edge, std::move(at));
                if (side.reversed == run_alike(edges_[edges_.number(m, side.edge)], edge))
                    reverse_heights(at);
            }
        if (const auto* bias = counts_.bias(set); bias != nullptr && !edge.closed) {
            at = layer_heights({.count = count, .bias = bias->second, .heights = {}});
            if (!run_alike(edges_[bias->first], edge)) reverse_heights(at);
        }
        if (const auto* rows = counts_.rows(set))
            at = with_rows(*rows, edge.length, edges_.runs_along(e), count);
        else if (const auto* cusps = edges_.cusps(set))
            at = with_cusps(*cusps, edge.length, edges_.runs_along(e), std::move(at));
        return surface::edge_points(edges_.model(edge.member), edge.edge, at);
    }

    /// Lengthen the first side at a cusp to its minimum length, and move the other nodes in proportion.
    static std::vector<double> with_cusps(const std::array<double, 2>& ends, double length, bool along,
                                          std::vector<double> at)
    {
        if (at.size() < 3) return at;
        const double low = std::max(at[1], ends[along ? 0 : 1] / length),
                     high = std::min(at[at.size() - 2], 1 - ends[along ? 1 : 0] / length);
        if (!(low < high) && at.size() > 3) return at;
        const double first = at[1], last = at[at.size() - 2];
        for (std::size_t i = 1; i + 1 < at.size(); ++i)
            at[i] = last > first ? low + (at[i] - first) / (last - first) * (high - low) : low + high - at[i];
        return at;
    }

    /// Node positions as shares of an edge's length: the rows at its ends, and equal sides between the rows.
    static std::vector<double> with_rows(const std::array<EdgeRows, 2>& ends, double length, bool along,
                                         int count)
    {
        const std::vector<double>&low = ends[along ? 0 : 1].places, &high = ends[along ? 1 : 0].places;
        std::vector<double> at{0};
        for (const double place : low) at.push_back(place / length);
        const double from = at.back(), to = high.empty() ? 1 : 1 - high.back() / length;
        const int between = count - static_cast<int>(low.size() + high.size());
        for (int i = 1; i < between; ++i) at.push_back(from + (to - from) * i / between);
        for (std::size_t k = high.size(); k-- > 0;) at.push_back(1 - high[k] / length);
        at.push_back(1);
        return at;
    }

    /// Node positions on a side line that consists of several edges, as shares of its length. They are the
    /// heights of the member's layers, and the height nearest to each vertex is moved onto the vertex. If
    /// there are no heights, or two vertices share the nearest height, nodes are evenly spaced between
    /// vertices.
    [[nodiscard]] std::vector<double> places_on(const std::vector<double>& ends, std::size_t m, EdgeId first,
                                                std::size_t count) const
    {
        std::vector<double> at{0};
        at.insert(at.end(), counts_.heights()[m].begin(), counts_.heights()[m].end());
        at = counts_.on_line(m, first, std::move(at));
        for (const double end : ends)
            *std::ranges::min_element(at, {}, [&](double height) { return std::abs(height - end); }) = end;
        return std::ranges::includes(at, ends) ? at : spread_between(ends, count);
    }

    /// Ends of the edges of a line, as shares of the line's length.
    [[nodiscard]] std::vector<double> ends_along(std::size_t m, const std::vector<EdgeUse>& line) const
    {
        std::vector<double> ends{0};
        for (const EdgeUse& use : line)
            ends.push_back(ends.back() + edges_[edges_.number(m, use.edge)].length);
        for (double& end : ends) end /= ends.back();
        return ends;
    }

    /// Place the nodes of side lines that consist of several edges, so that each vertex between two of these
    /// edges is a node. Edges of other members may end at such a vertex and need this node.
    void plan_stacks(std::size_t m, const std::vector<EdgeCounts::Line>& lines,
                     std::map<std::size_t, std::vector<Vec3>>& nodes, AssemblyPlan& plan)
    {
        const LayerSpec& spec = edges_.members()[m].options.layers;
        if (!spec.heights.empty() || spec.bias != 1) return; // the heights given by the user apply
        plan.layers[m] = counts_.heights()[m].empty() ? counts_.layers_of(m, lines)
                                                      : static_cast<int>(counts_.heights()[m].size());
        for (const std::vector<EdgeUse>& line : lines) {
            const std::vector<double> ends = ends_along(m, line);
            const std::vector<double> at = places_on(ends, m, line.front().edge, index(plan.layers[m]));
            for (std::size_t u = 0; u < line.size(); ++u) {
                const MemberEdge& edge = edges_[edges_.number(m, line[u].edge)];
                const auto [found, fresh] = nodes.try_emplace(edges_.set_of(edges_.number(m, line[u].edge)));
                if (fresh) {
                    std::vector<double> own;
                    for (const double share : at)
                        if (share >= ends[u] && share <= ends[u + 1])
                            own.push_back((share - ends[u]) / (ends[u + 1] - ends[u]));
                    if (line[u].reversed) reverse_heights(own);
                    std::vector<Vec3> made = surface::edge_points(edges_.model(m), line[u].edge, own);
                    for (Vec3* end : {&made.front(), &made.back()})
                        *end = corner_at(*end, edges_.model(m).tolerance);
                    found->second = at_home(std::move(made), edges_.number(m, line[u].edge));
                }
                std::vector<Vec3> own = from_home(found->second, edges_.number(m, line[u].edge));
                turn(own, edge);
                plan.nodes[m].push_back({line[u].edge, std::move(own)});
            }
        }
    }

    /// Whether quads of another member, but none of the own member, are given with nodes on an edge. Such an
    /// edge lies between faces of cuts.
    [[nodiscard]] bool is_kept_elsewhere(std::size_t e) const
    {
        const std::size_t* kept = edges_.kept_one(edges_.set_of(e));
        return kept != nullptr && edges_.kept(*kept) == SameEdges::Kept::quads &&
               edges_.kept(e) == SameEdges::Kept::no && edges_.members()[edges_[e].member].fixed == nullptr;
    }

    /// Whether an edge was imprinted into a face, which continues on both sides.
    [[nodiscard]] bool is_imprinted(std::size_t e) const
    {
        const Model& model = edges_.model(edges_[e].member);
        return model[edges_[e].edge].origin == Origin::made_void &&
               std::ranges::all_of(model.uses_of_edge(edges_[e].edge), [&](const FaceUse& use) {
                   return model[use.face].origin == Origin::given;
               });
    }

    /// Maximum distance of the ends and the middle of an edge from another edge that is the same.
    [[nodiscard]] double off(std::size_t e, std::size_t other) const
    {
        const std::vector<Vec3> line = surface::edge_line(edges_.model(edges_[other].member),
                                                          edges_[other].edge);
        const auto distance = [&](const Vec3& p) { return closest_on(line, p).distance; };
        return std::max({distance(edges_[e].from), distance(edges_[e].middle), distance(edges_[e].to)});
    }

    /// The edge, among those that are the same in several members, that defines the nodes: one with given
    /// nodes, else one with an exact curve, else the first. If an edge was imprinted into a face, the curve
    /// is used only if it lies on that face: otherwise its nodes would dent the face.
    [[nodiscard]] std::size_t exact_one(std::size_t e) const
    {
        const std::size_t root = edges_.set_of(e);
        if (const std::size_t* kept = edges_.kept_one(root);
            kept != nullptr && edges_.given_sides(*kept) == counts_.sides_of(e))
            return *kept;
        const auto curved = curved_one_.find(root), imprinted = imprinted_one_.find(root);
        if (curved == curved_one_.end()) return imprinted == imprinted_one_.end() ? root : imprinted->second;
        if (imprinted == imprinted_one_.end()) return curved->second;
        const double sag = edges_[curved->second].sag + edges_[imprinted->second].sag;
        return off(imprinted->second, curved->second) <= sag ? curved->second : imprinted->second;
    }

    /// Put nodes in the direction of a member's edge. On a closed edge they start at the node nearest to the
    /// edge's vertex.
    void turn(std::vector<Vec3>& nodes, const MemberEdge& edge) const
    {
        if (!edge.closed) {
            if ((nodes.front() - edge.from).norm() > (nodes.back() - edge.from).norm())
                std::ranges::reverse(nodes);
            return;
        }
        nodes.pop_back();
        const auto nearest = std::ranges::min_element(nodes, {},
                                                      [&](const Vec3& p) { return (p - edge.from).norm(); });
        std::ranges::rotate(nodes, nearest);
        // Find the direction around the edge: the second node must lie on the first half of the edge.
        const std::vector<Vec3> line = surface::edge_line(edges_.model(edge.member), edge.edge);
        const std::vector<double> arc = geometry::arc_lengths(line);
        const Vec3 quarter = geometry::point_at(line, arc, arc.back() / static_cast<double>(nodes.size()));
        if ((nodes.back() - quarter).norm() < (nodes[1] - quarter).norm())
            std::reverse(nodes.begin() + 1, nodes.end());
        nodes.push_back(nodes.front());
    }

    /// Move the vertices of periodic faces so that they are exact images of each other. All pairs are handled
    /// together. Vertices of given meshes do not move.
    void tie_corners()
    {
        if (edges_.periodic().empty()) return;
        std::vector<char> fixed;
        std::vector<Tie> ties;
        const auto corner = [&](const Vec3& p, double tolerance) {
            const std::size_t place = corners_.find_or_add(p, tolerance);
            fixed.resize(corners_.points().size());
            return place;
        };
        for (const PeriodicFaces& pair : edges_.periodic())
            for (const auto& [own, image] : pair.edges) {
                const MemberEdge &a = edges_[edges_.number(pair.a, own)],
                                 &b = edges_[edges_.number(pair.b, image)];
                if (a.closed) continue;
                const bool along = (pair.onto * a.from - b.from).norm() <= (pair.onto * a.from - b.to).norm();
                const double within = edges_.model(pair.a).tolerance, there = edges_.model(pair.b).tolerance;
                for (const bool first : {true, false})
                    ties.push_back({corner(first ? a.from : a.to, within),
                                    corner(first == along ? b.from : b.to, there), &pair.onto});
            }
        for (std::size_t e = 0; e < edges_.size(); ++e)
            for (const Vec3& end : {edges_[e].from, edges_[e].to})
                if (edges_.kept(e) != SameEdges::Kept::no) {
                    const std::size_t c = corner(end, edges_.model(edges_[e].member).tolerance);
                    fixed[c] = 1;
                }
        std::vector<Vec3> places = corners_.points();
        tie_points(places, fixed, ties, grid_);
        corners_ = PointsByPlace(cell_width());
        for (const Vec3& p : places) corners_.add(p);
    }

    /// Move the nodes of a periodic edge onto the edge that represents all its images.
    [[nodiscard]] std::vector<Vec3> at_home(std::vector<Vec3> nodes, std::size_t e) const
    {
        if (!edges_.is_tied(e)) return nodes;
        for (Vec3& p : nodes) p = edges_[e].home * p;
        if (edges_.kept(e) == SameEdges::Kept::no)
            for (Vec3& p : nodes) p = on_grid(p, grid_);
        return nodes;
    }

    [[nodiscard]] std::vector<Vec3> from_home(std::vector<Vec3> nodes, std::size_t e) const
    {
        if (!edges_.is_tied(e)) return nodes;
        const Eigen::Isometry3d back = edges_[e].home.inverse();
        for (Vec3& p : nodes) p = back * p;
        if (edges_.kept(e) == SameEdges::Kept::no) return nodes;
        const MemberEdge& edge = edges_[e];
        std::vector<Vec3> given = surface::edge_line(edges_.model(edge.member), edge.edge);
        if (!edge.closed && (nodes.front() - edge.from).norm() > (nodes.back() - edge.from).norm())
            std::ranges::reverse(nodes);
        double off = given.size() == nodes.size() ? 0 : edge.length;
        for (std::size_t i = 0; i < nodes.size() && off < edge.length; ++i)
            off = std::max(off, (nodes[i] - given[i]).norm());
        if (off <= edges_.model(edge.member).tolerance) return given;
        if (edges_.kept(e) == SameEdges::Kept::rim) return nodes;
        const AssemblyMember& member = edges_.members()[edge.member];
        throw InvalidInput(Message("sweep.periodic_given",
                                   "periodic: {} of {} has {} given nodes, but its image has {} others, and "
                                   "given nodes do not move",
                                   entity_in(member, edge.edge), member.region, given.size(), nodes.size())
                               .remedy("load one of them with keep_mesh = false"));
    }

    /// The stored position of a vertex. All edges and members that meet there use the same bits.
    const Vec3& corner_at(const Vec3& p, double tolerance)
    {
        return corners_.points()[corners_.find_or_add(p, tolerance)];
    }

    /// Width of the cells in which corners are searched: a few tolerances, and no less than the resolution of
    /// the coordinates.
    [[nodiscard]] double cell_width() const
    {
        double width = 0;
        for (std::size_t m = 0; m < edges_.members().size(); ++m)
            width = std::max({width, 4 * edges_.model(m).tolerance, kRoundoff * edges_.model(m).diagonal});
        return width;
    }

    const SameEdges& edges_;
    const EdgeCounts& counts_;
    double grid_ = 0; ///< spacing of the grid for nodes on periodic faces
    /// For each set of same edges: members of which it is a side line of one edge.
    std::map<std::size_t, std::vector<std::pair<std::size_t, EdgeUse>>> side_lines_;
    std::map<std::size_t, std::size_t> curved_one_; ///< for each set of same edges: the first with a curve
    std::map<std::size_t, std::size_t>
        imprinted_one_;                   ///< the first that was imprinted, if no nodes are given
    PointsByPlace corners_{cell_width()}; ///< stored positions of vertices; see `corner_at()`
};

} // namespace

AssemblyPlan plan_assembly(std::span<const AssemblyMember> members, std::span<const SharedFace> shared,
                           std::span<const std::pair<std::size_t, FaceId>> beside,
                           std::span<const PeriodicFaces> periodic, const RunContext& context)
{
    const SameEdges edges(members, shared, beside, periodic);
    const EdgeCounts counts(edges, context);
    return NodePlacer(edges, counts).run();
}

} // namespace lacuna::sweep
