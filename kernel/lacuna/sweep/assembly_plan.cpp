// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/surface/shared/default_size.h>
#include <lacuna/surface/shared/intervals.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/shared/rim_breaks.h>
#include <lacuna/surface/shared/seeds.h>
#include <lacuna/sweep/detail/assembly_levels.h>
#include <lacuna/sweep/detail/assembly_plan.h>
#include <lacuna/sweep/detail/edge_rows.h>
#include <lacuna/sweep/detail/keep_thickness.h>
#include <lacuna/sweep/detail/member_edge.h>
#include <lacuna/sweep/detail/plan_heights.h>
#include <lacuna/sweep/detail/shared_faces.h>
#include <lacuna/sweep/detail/source_quads.h>
#include <lacuna/sweep/detail/volume_share.h>
#include <lacuna/topology/shared/give_mesh.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <tuple>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Maximum number of nodes on the edges of all members. More nodes would exhaust the memory before anything
/// is meshed.
constexpr double kMostNodes = 2e7;
/// A request for a rim segment ignores an edge if it covers less than this share of the edge.
constexpr double kInset = 1e-3;
/// Number of places along an edge at which the size is sampled. Heuristic.
constexpr std::size_t kSizeSamples = 128;
/// Maximum number of rounds that make the number of sides of ends even. Each round adds a side to one class;
/// families of blocks need far fewer.
constexpr int kRounds = 64;

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
    /// The first point within the tolerance. If there is none, the place becomes a point.
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

class Planner {
public:
    Planner(std::span<const AssemblyMember> members, std::span<const SharedFace> shared,
            std::span<const std::pair<std::size_t, FaceId>> beside, std::span<const PeriodicFaces> periodic,
            const RunContext& context)
        : members_(members), shared_(shared), periodic_(periodic), context_(context), levels_(members, shared)
    {
        for (std::size_t m = 0; m < members.size(); ++m) {
            const Model& model = members[m].volume->model;
            first_.push_back(edges_.size());
            for (std::size_t e = 0; e < model.edges.size(); ++e)
                edges_.push_back(member_edge(model, m, EdgeId(e)));
        }
        first_.push_back(edges_.size());
        layers_.assign(members.size(), 1);
        for (const AssemblyMember& member : members) per_turn_.push_back(member.options.curvature);
        if (!periodic.empty()) grid_ = grid_of(members);
        const auto add_beside = [&](std::size_t m, FaceId face) {
            for (const Loop& loop : border_loops(model(m), face))
                for (const EdgeUse& use : loop.uses) beside_.insert(number(m, use.edge));
        };
        for (const auto& [m, face] : beside) add_beside(m, face);
        for (const SharedFace& face : shared) {
            const bool a = is_wall(face.a, face.face_a), b = is_wall(face.b, face.face_b);
            // The rows of the wall have a node wherever an edge of the other member's end ends.
            if (a && !b) add_beside(face.a, face.face_a);
            if (b && !a) add_beside(face.b, face.face_b);
        }
    }

    AssemblyPlan run()
    {
        find_same();
        join_periodic();
        find_cusps();
        classes_ = same_;
        for (std::size_t m = 0; m < members_.size(); ++m) {
            check_cancelled(context_);
            if (members_[m].fixed == nullptr) join_by_sweep(m);
        }
        heights_ = levels_.heights([this](std::size_t m, double height) {
            const std::vector<Vec3>& points = model(m).points;
            const Vec3 middle = std::accumulate(points.begin(), points.end(), Vec3(Vec3::Zero())) /
                                static_cast<double>(points.size());
            return std::max<double>(layers_[m], height / size(m, middle));
        });
        join_opposite();
        find_directions();
        for (std::size_t e = 0; e < edges_.size(); ++e)
            if (stacked_.contains(same_.find(e))) common_[e] = false;
        find_across();
        find_kept();
        find_rows();
        count();
        make_even();
        return nodes_and_layers();
    }

private:
    /// The rows of boundary layers at one end of an edge, and the member that has these rows.
    struct RowsHere {
        std::vector<double> places; ///< running lengths from that end
        std::size_t member = 0;
        FaceId face;
    };

    [[nodiscard]] const Model& model(std::size_t m) const { return members_[m].volume->model; }
    [[nodiscard]] std::size_t number(std::size_t m, EdgeId edge) const { return first_[m] + edge.index(); }

    [[nodiscard]] bool is_same(const MemberEdge& a, const MemberEdge& b) const
    {
        return sweep::is_same(a, b, std::max(model(a.member).tolerance, model(b.member).tolerance));
    }

    /// Find edges that are the same in several members.
    void find_same()
    {
        std::vector<std::size_t> order(edges_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        common_.assign(edges_.size(), false);
        std::ranges::sort(order, {}, [&](std::size_t e) { return edges_[e].box.min().x(); });
        same_ = geometry::UnionFind(edges_.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            const MemberEdge& a = edges_[order[i]];
            const double reach = a.box.min().x() + model(a.member).tolerance + kSameMiddle * a.length;
            for (std::size_t k = i + 1; k < order.size() && edges_[order[k]].box.min().x() <= reach; ++k) {
                const MemberEdge& b = edges_[order[k]];
                if (a.member == b.member || !is_same(a, b)) continue;
                same_.unite(std::min(order[i], order[k]), std::max(order[i], order[k]));
                common_[order[i]] = common_[order[k]] = true;
            }
        }
        for (const SharedFace& face : shared_) find_same_rims(face);
        for (const std::size_t e : beside_) common_[e] = true;
    }
    /// Unite the rims of a shared face that consist of a single closed edge with those of the same face in
    /// the other member. They are the same edges even if their chords differ widely.
    void find_same_rims(const SharedFace& face)
    {
        const auto closed_rims = [&](std::size_t m, FaceId of) {
            std::vector<std::size_t> rims;
            for (const Loop& loop : border_loops(model(m), of))
                if (loop.uses.size() == 1) rims.push_back(number(m, loop.uses.front().edge));
            return rims;
        };
        const std::vector<std::size_t> own = closed_rims(face.a, face.face_a),
                                       others = closed_rims(face.b, face.face_b);
        if (own.size() != others.size()) return;
        for (const std::size_t a : own) {
            const std::size_t b = *std::ranges::min_element(others, {}, [&](std::size_t other) {
                // Concentric rims have the same centre, so their lengths are compared too.
                return (edges_[other].centre - edges_[a].centre).norm() +
                       std::abs(edges_[other].length - edges_[a].length);
            });
            same_.unite(std::min(a, b), std::max(a, b));
            common_[a] = common_[b] = true;
        }
    }

    /// Join the edges of periodic faces with their images. The first edge of each set defines the position
    /// and the nodes of all edges of the set.
    void join_periodic()
    {
        // Transforms onto the first edge of each set.
        std::map<std::size_t, std::vector<std::pair<std::size_t, Eigen::Isometry3d>>> images;
        for (const PeriodicFaces& pair : periodic_)
            for (const auto& [own, image] : pair.edges) {
                const std::size_t a = same_.find(number(pair.a, own)), b = same_.find(number(pair.b, image));
                images[a].emplace_back(b, pair.onto.inverse());
                images[b].emplace_back(a, pair.onto);
            }
        std::map<std::size_t, Eigen::Isometry3d> home;
        std::vector<std::pair<std::size_t, std::size_t>> joined;
        for (const auto& [first, ignored] : images) {
            if (!home.emplace(first, Eigen::Isometry3d::Identity()).second) continue;
            for (std::vector<std::size_t> left{first}; !left.empty();) {
                const std::size_t at = left.back();
                left.pop_back();
                for (const auto& [next, onto] : images.at(at)) {
                    if (!home.emplace(next, home.at(at) * onto).second) continue;
                    left.push_back(next);
                    joined.emplace_back(first, next);
                }
            }
        }
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            const auto found = home.find(same_.find(e));
            if (found == home.end()) continue;
            edges_[e].home = found->second;
            common_[e] = true;
        }
        for (const auto& [first, next] : joined) same_.unite(first, next);
        for (const auto& [first, ignored] : home) tied_.insert(same_.find(first));
    }

    /// Move the vertices of periodic faces so that they are exact images of each other. All pairs are handled
    /// together. Vertices of given meshes do not move.
    void tie_corners()
    {
        if (periodic_.empty()) return;
        std::vector<char> fixed;
        std::vector<Tie> ties;
        const auto corner = [&](const Vec3& p, double tolerance) {
            const std::size_t place = corners_.find_or_add(p, tolerance);
            fixed.resize(corners_.points().size());
            return place;
        };
        for (const PeriodicFaces& pair : periodic_)
            for (const auto& [own, image] : pair.edges) {
                const MemberEdge &a = edges_[number(pair.a, own)], &b = edges_[number(pair.b, image)];
                if (a.closed) continue;
                const bool along = (pair.onto * a.from - b.from).norm() <= (pair.onto * a.from - b.to).norm();
                const double within = model(pair.a).tolerance, there = model(pair.b).tolerance;
                for (const bool first : {true, false})
                    ties.push_back({corner(first ? a.from : a.to, within),
                                    corner(first == along ? b.from : b.to, there), &pair.onto});
            }
        for (std::size_t e = 0; e < edges_.size(); ++e)
            for (const Vec3& end : {edges_[e].from, edges_[e].to})
                if (kept_[e] != Kept::no) {
                    const std::size_t c = corner(end, model(edges_[e].member).tolerance);
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
        if (!tied_.contains(same_.find(e))) return nodes;
        for (Vec3& p : nodes) p = edges_[e].home * p;
        if (kept_[e] == Kept::no)
            for (Vec3& p : nodes) p = on_grid(p, grid_);
        return nodes;
    }
    [[nodiscard]] std::vector<Vec3> from_home(std::vector<Vec3> nodes, std::size_t e) const
    {
        if (!tied_.contains(same_.find(e))) return nodes;
        const Eigen::Isometry3d back = edges_[e].home.inverse();
        for (Vec3& p : nodes) p = back * p;
        if (kept_[e] == Kept::no) return nodes;
        const MemberEdge& edge = edges_[e];
        std::vector<Vec3> given = surface::edge_line(model(edge.member), edge.edge);
        if (!edge.closed && (nodes.front() - edge.from).norm() > (nodes.back() - edge.from).norm())
            std::ranges::reverse(nodes);
        double off = given.size() == nodes.size() ? 0 : edge.length;
        for (std::size_t i = 0; i < nodes.size() && off < edge.length; ++i)
            off = std::max(off, (nodes[i] - given[i]).norm());
        if (off <= model(edge.member).tolerance) return given;
        if (kept_[e] == Kept::rim) return nodes;
        const AssemblyMember& member = members_[edge.member];
        throw InvalidInput(Message("sweep.periodic_given",
                                   "periodic: {} of {} has {} given nodes, but its image has {} others, and "
                                   "given nodes do not move",
                                   entity_in(member, edge.edge), member.region, given.size(), nodes.size())
                               .remedy("load one of them with keep_mesh = false"));
    }

    /// Find cusps: corners of ends whose two edges leave in the same direction, such as an arc and its
    /// tangent line. A quad at a cusp has an angle near 0° unless its sides are long enough to reach the
    /// place where the edges have diverged.
    void find_cusps()
    {
        for (std::size_t m = 0; m < members_.size(); ++m) {
            if (members_[m].fixed != nullptr) continue;
            for (std::size_t f = 0; f < model(m).faces.size(); ++f) {
                if (members_[m].volume->role[f] == Role::wall) continue;
                for (const Loop& loop : border_loops(model(m), FaceId(f)))
                    for (std::size_t u = 0; u < loop.uses.size() && loop.uses.size() > 1; ++u)
                        find_cusp(m, FaceId(f), loop.uses[u], loop.uses[(u + 1) % loop.uses.size()]);
            }
        }
    }
    void find_cusp(std::size_t m, FaceId face, const EdgeUse& in, const EdgeUse& out)
    {
        const std::size_t a = number(m, in.edge), b = number(m, out.edge);
        std::vector<Vec3> back = use_places(model(m), in), on = use_places(model(m), out);
        std::ranges::reverse(back);
        const std::vector<double> back_at = geometry::arc_lengths(back), on_at = geometry::arc_lengths(on);
        const double most = std::max(back_at.back(), on_at.back()) / 2;
        const Vec3 normal = face_area_vector(model(m), face);
        const auto is_flat = [&](double length) {
            const Vec3 p = geometry::point_at(back, back_at, std::min(length, back_at.back())) - back.front(),
                       q = geometry::point_at(on, on_at, std::min(length, on_at.back())) - on.front();
            const Vec3 across = q.cross(p);
            return p.dot(q) > 0 && across.dot(normal) >= 0 && across.norm() < kFlatQuad * p.norm() * q.norm();
        };
        if (is_flat(most) || !is_flat(std::min(back_at[1], on_at[1]))) return;
        double low = 0, high = most;
        for (int round = 0; round < kRounds; ++round)
            (is_flat((low + high) / 2) ? low : high) = (low + high) / 2;
        for (const auto& [e, end] : {std::pair(a, !in.reversed), std::pair(b, out.reversed)}) {
            double& first = cusps_[same_.find(e)][end == runs_along(e) ? 1 : 0];
            first = std::max(first, high);
            common_[e] = true;
        }
    }

    /// Two edges with the same number of sides, and whether their sides correspond in opposite directions.
    struct JoinedEdges {
        std::size_t a = 0, b = 0;
        bool reversed = false;
    };
    void join(std::size_t a, std::size_t b, bool reversed)
    {
        classes_.unite(a, b);
        joined_.push_back({a, b, reversed});
    }
    /// Find the direction of each edge relative to the other edges of its class.
    void find_directions()
    {
        std::map<std::size_t, std::vector<std::pair<std::size_t, bool>>> beside; // of sets of same edges
        for (const JoinedEdges& pair : joined_) {
            const std::size_t a = same_.find(pair.a), b = same_.find(pair.b);
            const bool reversed = pair.reversed != (runs_along(pair.a) != runs_along(pair.b));
            beside[a].emplace_back(b, reversed);
            beside[b].emplace_back(a, reversed);
        }
        std::map<std::size_t, bool> against; // of sets of same edges
        for (const auto& [first, ignored] : beside) {
            if (!against.emplace(first, false).second) continue;
            for (std::vector<std::size_t> left{first}; !left.empty();) {
                const std::size_t at = left.back();
                left.pop_back();
                for (const auto& [next, reversed] : beside.at(at))
                    if (against.emplace(next, against.at(at) != reversed).second) left.push_back(next);
            }
        }
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            const auto found = against.find(same_.find(e));
            reversed_.push_back((found != against.end() && found->second) == runs_along(e));
        }
    }

    /// Join edges that must have the same number of sides for the sweep of a member.
    void join_by_sweep(std::size_t m)
    {
        std::map<EdgeId, std::set<EdgeId>> target_of, source_of;
        std::map<EdgeId, bool> reversed; // on the source: the side corresponds to one of the other direction
        const std::vector<surface::LinkingSurface> links = surface::linking_surfaces(*members_[m].volume);
        find_demands(m, links);
        plan_sides(m, links);
        levels_.read(m, links, context_);
        for (const surface::LinkingSurface& link : links) {
            for (const surface::RimSegment& segment : link.segments) {
                const EdgeId from = link.source.uses()[segment.use].edge;
                // A segment may cover several edges of the target.
                const double whole = link.target.length();
                const double inset = kInset * (segment.target_to - segment.target_from);
                const auto use_at = [&](double at) {
                    while (at >= whole) at -= whole;
                    return link.target.position(at).use;
                };
                const std::size_t last = use_at(segment.target_to - inset);
                for (std::size_t use = use_at(segment.target_from + inset);;
                     use = (use + 1) % link.target.uses().size()) {
                    const EdgeId to = link.target.uses()[use].edge;
                    target_of[from].insert(to);
                    source_of[to].insert(from);
                    reversed[from] = link.source.uses()[segment.use].reversed !=
                                     link.target.uses()[use].reversed;
                    if (use == last) break;
                }
            }
            for (const surface::LinkingLine& line : link.lines) {
                if (line.line.uses.size() != 1) { // the sweep decides how many sides each edge gets
                    for (const EdgeUse& use : line.line.uses)
                        stacked_.insert(same_.find(number(m, use.edge)));
                    const auto is_beside = [&](const EdgeUse& use) {
                        return beside_.contains(number(m, use.edge));
                    };
                    if (std::ranges::any_of(line.line.uses, is_beside)) stacks_[m].push_back(line.line.uses);
                    continue;
                }
                sides_[m].push_back(line.line.uses.front());
                classes_.unite(number(m, sides_[m].front().edge), number(m, sides_[m].back().edge));
            }
        }
        for (const auto& [from, to] : target_of) {
            if (to.size() == 1 && source_of.at(*to.begin()).size() == 1)
                join(number(m, from), number(m, *to.begin()), reversed.at(from));
        }
    }

    [[nodiscard]] bool is_wall(std::size_t m, FaceId face) const
    {
        return members_[m].volume->role[face.index()] == Role::wall;
    }

    /// Ends of the edges of a line, as shares of the line's length.
    [[nodiscard]] std::vector<double> ends_along(std::size_t m, const std::vector<EdgeUse>& line) const
    {
        std::vector<double> ends{0};
        for (const EdgeUse& use : line) ends.push_back(ends.back() + edges_[number(m, use.edge)].length);
        for (double& end : ends) end /= ends.back();
        return ends;
    }

    /// Find the numbers of sides and layers that a member needs to keep its volume.
    void plan_sides(std::size_t m, std::span<const surface::LinkingSurface> links)
    {
        const OpenVolume& volume = *members_[m].volume;
        const SweepOptions& options = members_[m].options;
        const surface::SizeField size_at = [this, m](const Vec3& p) { return size(m, p); };
        const VolumePlan plan = plan_volume(volume, links, options, size_at, context_);
        per_turn_[m] = plan.per_turn;
        if (plan.layers) layers_[m] = plan.layers(1);
        if (!sizes_by_default(options)) return;
        spacing_[m] *= plan.part;
        surface::RimFacets facets(volume, links);
        for (const auto& [edge, at] : facets.breaks(per_turn_[m], size_at).edges) {
            std::vector<double> ends{0};
            ends.insert(ends.end(), at.begin(), at.end());
            ends.push_back(1);
            followed_[same_.find(number(m, edge))] = {number(m, edge), std::move(ends)};
        }
    }

    /// Read the interval requests of a member. Errors are ignored here, because the member's own sweep
    /// reports them.
    void find_demands(std::size_t m, std::span<const surface::LinkingSurface> links)
    {
        const AssemblyMember& member = members_[m];
        if (member.options.intervals.empty()) return;
        try {
            demands_[m] = surface::find_intervals(*member.volume, links, member.options.intervals);
        } catch (const Cancelled&) {
            throw;
        } catch (const Error& error) {
            log_line(context_, error.message().about(member.region).text());
        }
    }

    /// An edge of the source with an interval request.
    struct EdgeAsked {
        EdgeId edge;
        double covered = 0; ///< share of its length that the request covers
        double length = 0;  ///< covered length [model length]
        bool reversed = false;
    };

    /// Assign requested numbers of sides to classes. A request that covers only a part of an edge is left to
    /// the sweep of the member.
    void ask_sides()
    {
        for (const auto& [m, demands] : demands_) {
            for (const surface::SidesAsked& asked : demands.sides) {
                std::vector<EdgeAsked> edges;
                for (const surface::SidesAsked::Part& part : asked.parts) {
                    if (edges.empty() || edges.back().edge != part.edge)
                        edges.push_back({part.edge, 0, 0, part.reversed});
                    edges.back().covered += part.to - part.from;
                    edges.back().length += (part.to - part.from) * edges_[number(m, part.edge)].length;
                }
                const bool whole = std::ranges::all_of(
                    edges, [](const EdgeAsked& edge) { return edge.covered > 1 - kInset; });
                if (whole && static_cast<std::size_t>(asked.count) >= edges.size())
                    ask_sides(m, asked, edges);
            }
        }
    }
    /// Distribute the requested sides over several edges by length. Every edge gets at least one side.
    void ask_sides(std::size_t m, const surface::SidesAsked& asked, const std::vector<EdgeAsked>& edges)
    {
        double all = 0, until = 0;
        for (const EdgeAsked& edge : edges) all += edge.length;
        int before = 0;
        for (std::size_t k = 0; k < edges.size(); ++k) {
            until += edges[k].length;
            const auto left = static_cast<int>(edges.size() - k - 1);
            const int node = left == 0 ? asked.count
                                       : std::clamp(static_cast<int>(std::lround(asked.count * until / all)),
                                                    before + 1, asked.count - left);
            const std::size_t e = number(m, edges[k].edge);
            ask_class(e, {node - before, members_[m].region, asked.name});
            if (edges.size() == 1 && asked.bias != 1)
                bias_[same_.find(e)] = {e, edges[k].reversed ? 1 / asked.bias : asked.bias};
            before = node;
        }
    }
    struct SidesOfClass {
        int count = 0;
        std::string region; ///< region of the member with the request
        Argument name;      ///< name of the entity with the request
    };
    void ask_class(std::size_t e, const SidesOfClass& sides)
    {
        const auto [found, fresh] = intervals_.try_emplace(classes_.find(e), sides);
        if (fresh || found->second.count == sides.count) return;
        const SidesOfClass& before = found->second;
        throw NotSweepable(
            Message("surface.sides_asked",
                    "intervals: matching edges cannot have both {} sides ({}: {}) and {} ({}: {})",
                    lacuna::found(sides.count), sides.region, sides.name, needed(before.count), before.region,
                    before.name)
                .remedy("ask for the same number in both"));
    }

    /// Join opposite edges of walls, whose quads form rows and columns. Also join opposite edges of shared
    /// faces with four edges, so that both members mesh such a face by the same grid.
    void join_opposite()
    {
        for (std::size_t m = 0; m < members_.size(); ++m) {
            for (const FaceId wall : members_[m].volume->faces(Role::wall)) join_opposite(m, wall, true);
        }
        for (const SharedFace& face : shared_) {
            const bool rows = is_wall(face.a, face.face_a) || is_wall(face.b, face.face_b);
            join_opposite(face.a, face.face_a, rows);
            join_opposite(face.b, face.face_b, rows);
        }
    }
    /// @param rows  whether the quads form rows. A face with two rims then has the same number of nodes on
    ///         both rims.
    void join_opposite(std::size_t m, FaceId face, bool rows)
    {
        if (members_[m].fixed != nullptr) return; // a fixed member keeps its quads
        const std::vector<Loop> loops = border_loops(model(m), face);
        if (rows && loops.size() == 2 && loops[0].uses.size() == 1 && loops[1].uses.size() == 1)
            classes_.unite(number(m, loops[0].uses[0].edge), number(m, loops[1].uses[0].edge));
        if (loops.size() != 1 || loops[0].uses.size() != 4) return;
        for (std::size_t k = 0; k < 2; ++k) {
            const EdgeUse &use = loops[0].uses[k], &opposite = loops[0].uses[k + 2];
            join(number(m, use.edge), number(m, opposite.edge), use.reversed == opposite.reversed);
        }
    }

    /// An edge that follows facets. `ends` are the positions of those of its vertices that become nodes, as
    /// shares of its length.
    struct Followed {
        std::size_t edge = 0;
        std::vector<double> ends;
    };
    /// Number of sides, at about the requested size, if all these vertices become nodes.
    [[nodiscard]] double followed_sides(const Followed& followed, const MemberEdge& edge) const
    {
        double sides = 0;
        for (std::size_t i = 1; i < followed.ends.size(); ++i)
            sides += std::max(1.0, std::round((followed.ends[i] - followed.ends[i - 1]) * edge.length /
                                              size(edge.member, edge.middle)));
        return sides;
    }
    /// Distribute `count` sides over the intervals between these vertices. The interval with the longest
    /// sides is divided first.
    static std::vector<double> spread_between(const std::vector<double>& ends, std::size_t count)
    {
        std::vector<int> parts(ends.size() - 1, 1);
        const auto side = [&](std::size_t i) { return (ends[i + 1] - ends[i]) / parts[i]; };
        for (std::size_t k = parts.size(); k < count; ++k) {
            std::size_t longest = 0;
            for (std::size_t i = 1; i < parts.size(); ++i)
                if (side(i) > side(longest) * (1 + kInset)) longest = i;
            ++parts[longest];
        }
        std::vector<double> at{0};
        for (std::size_t i = 0; i < parts.size(); ++i) {
            for (int k = 1; k <= parts[i]; ++k)
                at.push_back(k == parts[i] ? ends[i + 1] : ends[i] + k * side(i));
        }
        return at;
    }

    /// Number of sides that an edge needs for the size and the curvature of its member.
    [[nodiscard]] double wanted(const MemberEdge& edge) const
    {
        const std::vector<Vec3> line = surface::edge_line(model(edge.member), edge.edge);
        double sides = 0, turn = 0;
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            const Vec3 &a = line[i], &b = line[i + 1];
            sides += (b - a).norm() / size(edge.member, (a + b) / 2);
            if (i > 0) turn += geometry::angle_between(a - line[i - 1], b - a);
        }
        const std::size_t own = number(edge.member, edge.edge);
        if (const auto followed = followed_.find(same_.find(own)); followed != followed_.end())
            return followed_sides(followed->second, edge);
        const auto lines = sides_.find(edge.member);
        const bool is_side = lines != sides_.end() &&
                             std::ranges::find(lines->second, edge.edge, &EdgeUse::edge) !=
                                 lines->second.end();
        if (is_side) sides = std::max(sides, static_cast<double>(layers_[edge.member]));
        return std::max(sides, turn * per_turn_[edge.member] / (2 * std::numbers::pi));
    }

    /// Numbers of sides for the whole length at places along each class that has an edge on the rim of a
    /// source beside a narrow place. The classes of side lines are left out: layers do not follow narrow
    /// places.
    void find_dense()
    {
        std::set<std::size_t> layered;
        for (const auto& [m, sides] : sides_)
            for (const EdgeUse& side : sides) layered.insert(classes_.find(number(m, side.edge)));
        for (std::size_t m = 0; m < members_.size(); ++m) {
            const OpenVolume& volume = *members_[m].volume;
            if (members_[m].fixed != nullptr) continue;
            SourceSize sizes;
            sizes.asked = [this, m](const Vec3& p) { return size(m, p); };
            if (!members_[m].options.size) sizes.by_default.emplace();
            reduce_by_shape(volume, members_[m].options, sizes);
            if (!sizes.shape.width) continue;
            for (const FaceId face : volume.faces(Role::source))
                for (const Loop& loop : border_loops(model(m), face))
                    for (const EdgeUse& use : loop.uses) {
                        const std::size_t e = number(m, use.edge), of = classes_.find(e);
                        if (layered.contains(of) || kept_[e] != Kept::no) continue;
                        std::vector<double>& dense = dense_[of];
                        dense.resize(kSizeSamples, 0);
                        std::vector<double> at;
                        for (std::size_t i = 0; i < kSizeSamples; ++i)
                            at.push_back((static_cast<double>(i) + 0.5) / kSizeSamples);
                        std::vector<Vec3> points = surface::edge_points(model(m), use.edge, at);
                        if (reversed_[e]) std::ranges::reverse(points);
                        for (std::size_t i = 0; i < kSizeSamples; ++i)
                            dense[i] = std::max(dense[i], edges_[e].length / sizes.shape.at(points[i]));
                    }
        }
    }
    /// Node positions as shares of an edge's length: even, or by the sizes along its class.
    [[nodiscard]] std::vector<double> spread(std::size_t e, int count) const
    {
        std::vector<double> at;
        const auto found = dense_.find(classes_.find(e));
        if (found == dense_.end() || edges_[e].closed) {
            for (int i = 0; i <= count; ++i) at.push_back(static_cast<double>(i) / count);
            return at;
        }
        const std::vector<double>& dense = found->second;
        std::vector<double> sums{0};
        for (const double sides : dense) sums.push_back(sums.back() + sides);
        std::size_t k = 0;
        for (int i = 0; i < count; ++i) {
            const double sum = sums.back() * i / count;
            while (sums[k + 1] < sum) ++k;
            at.push_back((static_cast<double>(k) + (sum - sums[k]) / dense[k]) / kSizeSamples);
        }
        at.push_back(1);
        if (reversed_[e]) reverse_heights(at);
        return at;
    }

    [[nodiscard]] double size(std::size_t m, const Vec3& p) const
    {
        if (members_[m].options.size) return members_[m].options.size(p);
        if (spacing_.empty()) spacing_.assign(members_.size(), 0);
        if (spacing_[m] == 0) spacing_[m] = surface::default_size(*members_[m].volume).length;
        return spacing_[m];
    }

    [[nodiscard]] int layers_asked(std::size_t m) const
    {
        const LayerSpec& spec = members_[m].options.layers;
        const auto demands = demands_.find(m);
        if (demands != demands_.end() && demands->second.layers) return demands->second.layers->count;
        return spec.heights.empty() ? spec.count : static_cast<int>(spec.heights.size());
    }

    [[nodiscard]] int sides_of(std::size_t e) const
    {
        return static_cast<int>(model(edges_[e].member)[edges_[e].edge].points.size()) - 1;
    }

    /// Find edges whose given nodes are kept. If several members have the same edge, an edge next to given
    /// quads takes precedence over an edge on the rim of a face whose given mesh only defines its shape.
    void find_kept()
    {
        kept_.assign(edges_.size(), Kept::no);
        for (std::size_t m = 0; m < members_.size(); ++m) {
            for (const EdgeId edge : kept_edges(model(m))) kept_[number(m, edge)] = Kept::rim;
            for (const Face& face : model(m).faces) {
                if (!face.keeps_nodes || face.given_quads.empty()) continue;
                for (const Loop& loop : face.loops) {
                    for (const EdgeUse& use : loop.uses) kept_[number(m, use.edge)] = Kept::quads;
                }
            }
        }
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (kept_[e] == Kept::no) continue;
            const auto [found, fresh] = kept_one_.try_emplace(same_.find(e), e);
            if (!fresh && kept_[found->second] < kept_[e]) found->second = e;
        }
    }

    /// Whether the same edge runs in the same direction in two members.
    static bool run_alike(const MemberEdge& a, const MemberEdge& b)
    {
        const Vec3 from = a.home * a.from;
        return (from - b.home * b.from).norm() <= (from - b.home * b.to).norm();
    }
    /// Whether a member's edge runs in the direction of the edge that represents it.
    [[nodiscard]] bool runs_along(std::size_t e) const { return run_alike(edges_[e], edges_[same_.find(e)]); }

    /// Find edges on which rows of boundary layers end. The rows of one member apply to all members that have
    /// the edge.
    void find_rows()
    {
        for (std::size_t m = 0; m < members_.size(); ++m) {
            for (auto& [edge, rows] : edge_rows(members_[m])) {
                const std::size_t e = number(m, edge);
                if (edges_[e].closed || kept_[e] == Kept::quads) continue; // its nodes are given
                if (!runs_along(e)) std::swap(rows[0], rows[1]);
                std::array<RowsHere, 2>& here = rows_[same_.find(e)];
                for (std::size_t k = 0; k < 2; ++k) {
                    if (rows[k].places.empty()) continue;
                    if (!here[k].places.empty() && !are_alike(here[k].places, rows[k].places))
                        refuse_rows(here[k], m, rows[k].face, e);
                    if (here[k].places.empty()) here[k] = {rows[k].places, m, rows[k].face};
                }
                const double taken = (here[0].places.empty() ? 0 : here[0].places.back()) +
                                     (here[1].places.empty() ? 0 : here[1].places.back());
                if (taken >= edges_[e].length)
                    rows_.erase(same_.find(e)); // drop the rows; the sweep reports the misfit
            }
        }
    }

    static bool are_alike(const std::vector<double>& a, const std::vector<double>& b)
    {
        if (a.size() != b.size()) return false;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double thick = a[i] - (i > 0 ? a[i - 1] : 0);
            if (std::abs(a[i] - b[i]) > kThicknessOff * thick) return false;
        }
        return true;
    }

    [[noreturn]] void refuse_rows(const RowsHere& there, std::size_t m, FaceId face, std::size_t e) const
    {
        const AssemblyMember& own = members_[m];
        const AssemblyMember& other = members_[there.member];
        throw NotSweepable(Message("assembly.layers_differ",
                                   "the boundary layers of {} of {} and of {} of {} end on the same edge, "
                                   "{} of {}, but differ",
                                   entity_in(other, there.face), other.region, entity_in(own, face),
                                   own.region, entity_in(own, edges_[e].edge), own.region)
                               .remedy("give both faces the same boundary_layers table"));
    }

    /// Number of sides of an edge that rows take up, and the length of the edge that remains for other sides
    /// [model length].
    [[nodiscard]] std::pair<int, double> beside_rows(std::size_t e) const
    {
        const auto found = rows_.find(same_.find(e));
        if (found == rows_.end()) return {0, edges_[e].length};
        int taken = 0;
        double left = edges_[e].length;
        for (const RowsHere& end : found->second) {
            taken += static_cast<int>(end.places.size());
            if (!end.places.empty()) left -= end.places.back();
        }
        return {taken, left};
    }

    /// Check that edges have enough sides for their rows.
    void check_rows() const
    {
        for (const auto& [e, ends] : rows_) {
            const int taken = beside_rows(e).first, count = count_.at(classes_.find(e));
            if (taken < count) continue;
            const RowsHere& end = ends[ends[0].places.empty() ? 1 : 0];
            const AssemblyMember &own = members_[end.member], &other = members_[edges_[e].member];
            throw NotSweepable(
                Message(
                    "assembly.layers_rows",
                    "the boundary layers of {} of {} need at least {} sides on {} of {}, because {} rows end "
                    "there, but it has {}",
                    entity_in(own, end.face), own.region, needed(taken + 1), entity_in(other, edges_[e].edge),
                    other.region, taken, found(count))
                    .remedy("use a smaller 'count' of rows, or more layers or intervals there"));
        }
    }

    /// Determine the number of sides of each class.
    void count()
    {
        std::map<std::size_t, std::size_t> asked; // for each class: the member that requests layers
        for (const auto& [m, sides] : sides_) {
            if (layers_asked(m) == 0 || sides.empty()) continue;
            const auto [found, fresh] = asked.try_emplace(classes_.find(number(m, sides.front().edge)), m);
            const AssemblyMember &a = members_[found->second], &b = members_[m];
            if (fresh || layers_asked(found->second) == layers_asked(m)) continue;
            throw NotSweepable(
                Message("assembly.layers",
                        "{} and {} lie side by side and are swept in the same direction, so they "
                        "need equal layers, but {} and {} are asked for",
                        a.region, b.region, lacuna::found(layers_asked(found->second)),
                        lacuna::found(layers_asked(m)))
                    .remedy("ask for the same number in both"));
        }
        ask_sides();
        for (const auto& [of, m] : asked)
            if (const auto other = intervals_.find(of); other != intervals_.end())
                ask_class(of, {layers_asked(m), members_[m].region, "its layers"});
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            Kept& of = kept_of_class_[classes_.find(e)];
            of = std::max(of, kept_[e]);
        }
        find_dense();
        std::map<std::size_t, double> most;
        for (const auto& [of, dense] : dense_)
            most[of] = std::accumulate(dense.begin(), dense.end(), 0.0) / kSizeSamples;
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            const std::size_t of = classes_.find(e);
            double& sides = most[of];
            if (asked.contains(of) || kept_[e] != kept_of_class_.at(of)) continue;
            const auto [taken, left] = beside_rows(e);
            sides = std::max(sides, kept_[e] != Kept::no ? sides_of(e)
                                    : taken == 0         ? wanted(edges_[e])
                                                 : taken + std::max(1.0, std::round(wanted(edges_[e]) * left /
                                                                                    edges_[e].length)));
        }
        for (const auto& [of, sides] : most) {
            if (!(sides < std::numeric_limits<Index>::max() / 16.0))
                throw InvalidInput(
                    Message("sweep.too_many",
                            "an edge of the assembly would have more sides than node numbers allow")
                        .remedy("use a larger 'size'"));
            count_[of] = std::max(1, static_cast<int>(std::lround(sides)));
        }
        for (const auto& [of, m] : asked) {
            count_[of] = layers_asked(m);
            asked_.insert(of);
        }
        for (const auto& [m, sides] : sides_) {
            if (sides.empty() || heights_[m].empty()) continue;
            const std::size_t of = classes_.find(number(m, sides.front().edge));
            count_[of] = static_cast<int>(heights_[m].size());
            asked_.insert(of);
        }
        for (const auto& [of, sides] : intervals_) {
            if (kept_of_class_.at(of) == Kept::quads) continue; // the sweep reports a conflict of numbers
            count_[of] = sides.count;
            asked_.insert(of);
        }
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (edges_[e].closed) count_[classes_.find(e)] = std::max(count_[classes_.find(e)], 4);
        }
        check_rows();
    }

    /// If all edges of an end are shared or have given nodes, make the number of its sides even, because
    /// quads need an even number.
    void make_even()
    {
        for (int round = 0; round < kRounds; ++round) {
            bool odd = false;
            for (std::size_t m = 0; m < members_.size(); ++m) {
                for (std::size_t f = 0; f < model(m).faces.size(); ++f) {
                    if (members_[m].volume->role[f] != Role::wall)
                        odd = make_even(m, FaceId(f), round) || odd;
                }
            }
            if (!odd) return;
        }
    }

    /// @return  whether a class has got one more side.
    bool make_even(std::size_t m, FaceId face, int round)
    {
        std::map<std::size_t, int> uses; // number of uses of each class by the face
        int sides = 0;
        for (const Loop& loop : border_loops(model(m), face)) {
            for (const EdgeUse& use : loop.uses) {
                const std::size_t e = number(m, use.edge);
                if (!common_[e] && kept_[e] == Kept::no) return false;
                const std::size_t of = classes_.find(e);
                ++uses[of];
                sides += count_.at(of);
            }
        }
        if (sides % 2 == 0) return false;
        std::size_t best = edges_.size();
        for (const auto& [of, times] : uses) {
            if (times % 2 == 0 || asked_.contains(of) || kept_of_class_.at(of) == Kept::quads) continue;
            // Later rounds choose the next class, so that two ends do not undo each other's changes. Classes
            // with given nodes on rims of faces whose mesh only defines the shape are changed last.
            const auto before = [&](std::size_t a, std::size_t b) {
                return std::tuple(kept_of_class_.at(a) != Kept::rim, -bumps_[a], count_.at(a)) >
                       std::tuple(kept_of_class_.at(b) != Kept::rim, -bumps_[b], count_.at(b));
            };
            if (best == edges_.size() || before(of, best)) best = of;
        }
        if (best == edges_.size()) return false;
        ++bumps_[best];
        count_[best] += round < kRounds / 2 ? 1 : count_[best] % 2;
        return true;
    }

    /// Nodes of an edge that several members share, in the direction of the first member's edge.
    [[nodiscard]] std::vector<Vec3> places(std::size_t e, int count) const
    {
        const MemberEdge& edge = edges_[e];
        if (kept_[e] != Kept::no && sides_of(e) == count)
            return surface::edge_line(model(edge.member), edge.edge);
        if (const auto found = followed_.find(same_.find(e)); found != followed_.end()) {
            const auto& [own, ends] = found->second;
            if (static_cast<std::size_t>(count) + 1 >= ends.size())
                return surface::edge_points(model(edges_[own].member), edges_[own].edge,
                                            spread_between(ends, static_cast<std::size_t>(count)));
        }
        std::vector<double> at = spread(e, count);
        // If one of the members requires a spacing of layers, use it.
        if (const auto lines = side_lines_.find(same_.find(e)); lines != side_lines_.end())
            for (const auto& [m, side] : lines->second) {
                const bool by_levels = std::cmp_equal(heights_[m].size(), count);
                const LayerSpec& spec = members_[m].options.layers;
                if (spec.heights.empty() && spec.bias == 1 && !by_levels) continue;
                LayerSpec whole = spec;
                if (by_levels)
                    whole.heights = heights_[m];
                else if (whole.heights.empty())
                    whole.count = count;
                at = layer_heights(whole);
                if (members_[m].volume->turned_round && !by_levels) reverse_heights(at);
                if (side.reversed == run_alike(edges_[number(m, side.edge)], edge)) reverse_heights(at);
            }
        if (const auto found = bias_.find(same_.find(e)); found != bias_.end() && !edge.closed) {
            at = layer_heights({.count = count, .bias = found->second.second, .heights = {}});
            if (!run_alike(edges_[found->second.first], edge)) reverse_heights(at);
        }
        if (const auto found = rows_.find(same_.find(e)); found != rows_.end())
            at = with_rows(found->second, edge.length, runs_along(e), count);
        else if (const auto cusp = cusps_.find(same_.find(e)); cusp != cusps_.end())
            at = with_cusps(cusp->second, edge.length, runs_along(e), std::move(at));
        return surface::edge_points(model(edge.member), edge.edge, at);
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
    static std::vector<double> with_rows(const std::array<RowsHere, 2>& ends, double length, bool along,
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

    AssemblyPlan nodes_and_layers()
    {
        AssemblyPlan plan;
        tie_corners();
        double all = 0;
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (common_[e]) all += count_.at(classes_.find(e));
        }
        if (all > kMostNodes)
            throw InvalidInput(Message("sweep.too_many",
                                       "the edges shared by volumes of the assembly would have {:.0f} sides, "
                                       "more than memory allows",
                                       found(all))
                                   .remedy("use a larger 'size' or fewer 'layers'"));
        plan.nodes.resize(members_.size());
        plan.layers.assign(members_.size(), 0);
        std::map<std::size_t, std::vector<Vec3>> nodes;
        const std::vector<bool> on_frame = find_frame();
        for (const auto& [m, sides] : sides_)
            for (const EdgeUse& side : sides)
                side_lines_[same_.find(number(m, side.edge))].emplace_back(m, side);
        for (std::size_t e = 0; e < edges_.size(); ++e)
            if (model(edges_[e].member)[edges_[e].edge].curve != nullptr)
                curved_one_.emplace(same_.find(e), e);
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            // The triangles of a face without quads only define its shape. Given nodes on its rim are dropped
            // if the planned number of sides differs.
            const bool gives_way = kept_[e] == Kept::rim && sides_of(e) != count_.at(classes_.find(e));
            if (!(common_[e] || gives_way) || !on_frame[e]) continue;
            auto found = nodes.find(same_.find(e));
            if (found == nodes.end()) {
                const std::size_t one = exact_one(e);
                std::vector<Vec3> made = at_home(places(one, count_.at(classes_.find(e))), one);
                found = nodes.emplace(same_.find(e), std::move(made)).first;
            }
            std::vector<Vec3> own = from_home(found->second, e);
            turn(own, edges_[e]);
            if (!edges_[e].closed) {
                own.front() = corner_at(own.front(), model(edges_[e].member).tolerance);
                own.back() = corner_at(own.back(), model(edges_[e].member).tolerance);
            }
            plan.nodes[edges_[e].member].push_back({edges_[e].edge, std::move(own)});
        }
        for (const auto& [m, sides] : sides_) {
            const bool beside = std::ranges::any_of(
                sides, [&, m = m](const EdgeUse& side) { return common_[number(m, side.edge)]; });
            if (beside) plan.layers[m] = count_.at(classes_.find(number(m, sides.front().edge)));
        }
        for (const auto& [m, lines] : stacks_) plan_stacks(m, lines, nodes, plan);
        plan.heights = heights_;
        return plan;
    }

    /// Number of layers of a member with side lines that consist of several edges: at least the largest
    /// number of edges of one line.
    [[nodiscard]] int layers_of(std::size_t m, const std::vector<std::vector<EdgeUse>>& lines) const
    {
        double layers = std::max(layers_asked(m), layers_[m]);
        if (const auto sides = sides_.find(m); sides != sides_.end())
            layers = count_.at(classes_.find(number(m, sides->second.front().edge)));
        std::size_t most = 1;
        for (const std::vector<EdgeUse>& line : lines) {
            double wanted_here = 0;
            for (const EdgeUse& use : line) wanted_here += wanted(edges_[number(m, use.edge)]);
            if (!sides_.contains(m) && layers_asked(m) == 0) layers = std::max(layers, wanted_here);
            most = std::max(most, line.size());
        }
        return std::max(static_cast<int>(std::lround(layers)), static_cast<int>(most));
    }

    /// Places of nodes on a side line: the heights of the member's layers, of which the nearest moves to each
    /// end of an edge; or, if there are none, or two ends have the same nearest height, evenly between ends.
    [[nodiscard]] std::vector<double> places_on(const std::vector<double>& ends, std::size_t m,
                                                std::size_t count) const
    {
        std::vector<double> at{0};
        at.insert(at.end(), heights_[m].begin(), heights_[m].end());
        for (const double end : ends)
            *std::ranges::min_element(at, {}, [&](double height) { return std::abs(height - end); }) = end;
        return std::ranges::includes(at, ends) ? at : spread_between(ends, count);
    }

    /// Place the nodes of side lines that consist of several edges, so that each vertex between two of these
    /// edges is a node. Edges of other members may end at such a vertex and need this node.
    void plan_stacks(std::size_t m, const std::vector<std::vector<EdgeUse>>& lines,
                     std::map<std::size_t, std::vector<Vec3>>& nodes, AssemblyPlan& plan)
    {
        const LayerSpec& spec = members_[m].options.layers;
        if (!spec.heights.empty() || spec.bias != 1) return; // the heights given by the user apply
        plan.layers[m] = heights_[m].empty() ? layers_of(m, lines) : static_cast<int>(heights_[m].size());
        for (const std::vector<EdgeUse>& line : lines) {
            const std::vector<double> ends = ends_along(m, line);
            const std::vector<double> at = places_on(ends, m, index(plan.layers[m]));
            for (std::size_t u = 0; u < line.size(); ++u) {
                const MemberEdge& edge = edges_[number(m, line[u].edge)];
                const auto [found, fresh] = nodes.try_emplace(same_.find(number(m, line[u].edge)));
                if (fresh) {
                    std::vector<double> own;
                    for (const double share : at)
                        if (share >= ends[u] && share <= ends[u + 1])
                            own.push_back((share - ends[u]) / (ends[u + 1] - ends[u]));
                    if (line[u].reversed) reverse_heights(own);
                    std::vector<Vec3> made = surface::edge_points(model(m), line[u].edge, own);
                    for (Vec3* end : {&made.front(), &made.back()})
                        *end = corner_at(*end, model(m).tolerance);
                    found->second = at_home(std::move(made), number(m, line[u].edge));
                }
                std::vector<Vec3> own = from_home(found->second, number(m, line[u].edge));
                turn(own, edge);
                plan.nodes[m].push_back({line[u].edge, std::move(own)});
            }
        }
    }

    /// Find shared edges that run around a member's walls, such as the rim of a band. Such an edge needs as
    /// many sides as the rims of the member's ends, so the nodes of these rims are planned too.
    void find_across()
    {
        const std::vector<bool> frame = find_frame();
        std::set<std::pair<std::size_t, std::size_t>> across; // member, class
        for (std::size_t e = 0; e < edges_.size(); ++e)
            if (common_[e] && !frame[e]) across.emplace(edges_[e].member, classes_.find(e));
        for (std::size_t e = 0; e < edges_.size(); ++e)
            if (frame[e] && across.contains({edges_[e].member, classes_.find(e)})) common_[e] = true;
    }

    /// For each edge, whether it is on the rim of an end or on a side line. The nodes of the other edges of
    /// walls follow from these.
    [[nodiscard]] std::vector<bool> find_frame() const
    {
        std::vector<bool> frame;
        for (std::size_t m = 0; m < members_.size(); ++m) {
            for (std::size_t e = 0; e < model(m).edges.size(); ++e)
                frame.push_back(
                    std::ranges::any_of(model(m).uses_of_edge(EdgeId(e)), [&](const FaceUse& user) {
                        return members_[m].volume->role[user.face.index()] != Role::wall;
                    }));
        }
        for (const auto& [m, sides] : sides_)
            for (const EdgeUse& side : sides) frame[number(m, side.edge)] = true;
        return frame;
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
        for (std::size_t m = 0; m < members_.size(); ++m)
            width = std::max({width, 4 * model(m).tolerance, kRoundoff * model(m).diagonal});
        return width;
    }

    /// Of the same edge in several members, the index of the one with given nodes. Without given nodes, the
    /// one with an exact curve.
    [[nodiscard]] std::size_t exact_one(std::size_t e)
    {
        const std::size_t root = same_.find(e);
        if (const auto kept = kept_one_.find(root);
            kept != kept_one_.end() && sides_of(kept->second) == count_.at(classes_.find(e)))
            return kept->second;
        const auto curved = curved_one_.find(root);
        return curved == curved_one_.end() ? root : curved->second;
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
        const std::vector<Vec3> line = surface::edge_line(model(edge.member), edge.edge);
        const std::vector<double> arc = geometry::arc_lengths(line);
        const Vec3 quarter = geometry::point_at(line, arc, arc.back() / static_cast<double>(nodes.size()));
        if ((nodes.back() - quarter).norm() < (nodes[1] - quarter).norm())
            std::reverse(nodes.begin() + 1, nodes.end());
        nodes.push_back(nodes.front());
    }

    std::span<const AssemblyMember> members_;
    std::span<const SharedFace> shared_;
    std::span<const PeriodicFaces> periodic_;
    const RunContext& context_;
    std::vector<std::size_t> first_; ///< index of each member's first edge
    std::vector<MemberEdge> edges_;  ///< edges of all members
    mutable geometry::UnionFind same_{0}, classes_{0};
    /// Which given nodes of an edge are kept: none, the rim nodes of a face whose mesh is only its shape, or
    /// the nodes of quads.
    enum class Kept : std::uint8_t { no, rim, quads };
    std::vector<Kept> kept_; ///< for each edge, which nodes are kept
    /// For each class, the highest value of its edges in this order.
    std::map<std::size_t, Kept> kept_of_class_;
    std::map<std::size_t, std::array<RowsHere, 2>>
        rows_; ///< for each set of same edges, in the direction of the first
    /// For each set of same edges, one edge of it that has given nodes.
    std::map<std::size_t, std::size_t> kept_one_;
    std::map<std::size_t, std::size_t> curved_one_; ///< for each set of same edges: the first with a curve
    std::vector<bool> common_;                      ///< for each edge, whether other members have it too
    /// For each set of same edges: minimum length of the first and the last side at cusps [model length].
    std::map<std::size_t, std::array<double, 2>> cusps_;
    double grid_ = 0;            ///< spacing of the grid for nodes on periodic faces
    std::set<std::size_t> tied_; ///< sets of same edges on periodic faces
    /// Edges of walls shared with members that are not swept, or with ends of other members.
    std::set<std::size_t> beside_;
    /// For each member: its side lines of several edges, of which some are in `beside_`.
    std::map<std::size_t, std::vector<std::vector<EdgeUse>>> stacks_;
    std::map<std::size_t, std::vector<EdgeUse>> sides_; ///< for each member: side lines of one edge
    /// For each set of same edges: members of which it is a side line of one edge.
    std::map<std::size_t, std::vector<std::pair<std::size_t, EdgeUse>>> side_lines_;
    std::map<std::size_t, int> count_;   ///< number of sides of each class
    std::vector<int> per_turn_, layers_; ///< numbers that each member needs to keep its volume
    AssemblyLevels levels_;
    /// For each member, heights of its layers that result from its levels, counted from its source.
    std::vector<std::vector<double>> heights_;
    std::map<std::size_t, Followed> followed_; ///< sets of same edges that follow facets
    /// Interval requests of each member that has any.
    std::map<std::size_t, surface::IntervalDemands> demands_;
    /// Number of sides requested for a class by 'intervals'.
    std::map<std::size_t, SidesOfClass> intervals_;
    /// For each set of same edges: the edge with a requested bias, and that bias in the direction of this
    /// edge.
    std::map<std::size_t, std::pair<std::size_t, double>> bias_;
    /// Sets of same edges that, in some member, form only a part of a side line.
    std::set<std::size_t> stacked_;
    std::vector<JoinedEdges> joined_;
    std::vector<bool> reversed_;                       ///< for each edge, whether it runs against its class
    std::map<std::size_t, std::vector<double>> dense_; ///< see `find_dense()`
    std::set<std::size_t> asked_;                      ///< classes with a number requested by the user
    std::map<std::size_t, int> bumps_;                 ///< number of sides added to each class
    PointsByPlace corners_{cell_width()};              ///< stored positions of vertices; see `corner_at()`
    mutable std::vector<double> spacing_;              ///< for each member's rim
};

} // namespace

AssemblyPlan plan_assembly(std::span<const AssemblyMember> members, std::span<const SharedFace> shared,
                           std::span<const std::pair<std::size_t, FaceId>> beside,
                           std::span<const PeriodicFaces> periodic, const RunContext& context)
{
    return Planner(members, shared, beside, periodic, context).run();
}

} // namespace lacuna::sweep
