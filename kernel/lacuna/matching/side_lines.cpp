// SPDX-License-Identifier: MIT
#include <lacuna/matching/side_lines.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/geometry/shared/harmonic.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/matching/shared/corners.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <set>

namespace lacuna::matching {

using namespace topology;

namespace {

/// Least climb of an edge on a side line. The climb is the sine of the angle between the edge and the level
/// lines, so the angle is 30°. Edges that climb less separate walls that are stacked on each other.
constexpr double kLevel = 0.5;

std::vector<Index> rim_points(const Model& model, const std::vector<FaceId>& faces)
{
    std::vector<Index> points;
    for (const EdgeId edge : rim_edges(model, faces))
        points.insert(points.end(), model[edge].points.begin(), model[edge].points.end());
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

/// The heights of the inner points of side lines: the share of the line's length below the point.
std::map<Index, double> heights_along(const Model& model, const std::vector<SideLine>& lines)
{
    std::map<Index, double> heights;
    for (const SideLine& line : lines) {
        const std::vector<Index> chain = use_points(model, line.uses);
        const std::vector<double> run = geometry::arc_lengths(places_at(model, chain));
        for (std::size_t i = 1; i + 1 < chain.size(); ++i) heights[chain[i]] = run[i] / run.back();
    }
    return heights;
}

enum class Digits { all, nine };

/// The points whose heights are known: 0 on the source's rim, 1 on the target's, and those on side lines.
class KnownHeights {
public:
    KnownHeights(const OpenVolume& volume, const std::vector<SideLine>& lines)
    {
        const auto add = [this](Index point, double height) {
            number_.emplace_back(point, known_.size());
            known_.emplace_back(point, height);
        };
        for (const Index p : rim_points(volume.model, volume.faces(Role::source))) add(p, 0);
        low_ = known_.size();
        for (const Index p : rim_points(volume.model, volume.faces(Role::target))) add(p, 1);
        high_ = known_.size();
        for (const auto& [p, height] : heights_along(volume.model, lines)) add(p, height);
        std::ranges::sort(number_);
    }

    /// Fix the heights of a problem's points. @return  whether its triangles join both rims
    bool fix(geometry::HarmonicProblem& problem) const
    {
        std::vector<Index> points;
        for (const Triangle& t : problem.triangles) points.insert(points.end(), t.begin(), t.end());
        std::ranges::sort(points);
        points.erase(std::ranges::unique(points).begin(), points.end());
        std::vector<std::size_t> own;
        for (const Index p : points)
            for (const auto& [point, number] : std::ranges::equal_range(number_, p, {}, &Numbered::first))
                own.push_back(number);
        std::ranges::sort(own);
        problem.fixed_values.resize(static_cast<Eigen::Index>(own.size()), 1);
        for (const std::size_t k : own) {
            problem.fixed_values(static_cast<Eigen::Index>(problem.fixed.size()), 0) = known_[k].second;
            problem.fixed.push_back(known_[k].first);
        }
        const auto first_of_target = std::ranges::lower_bound(own, low_);
        return first_of_target != own.begin() && first_of_target != own.end() && *first_of_target < high_;
    }

private:
    using Numbered = std::pair<Index, std::size_t>;
    std::vector<std::pair<Index, double>> known_;
    std::vector<Numbered> number_; ///< points and their indices in known_, by point
    std::size_t low_ = 0, high_ = 0;
};

/// wall_heights() of some wall parts.
std::vector<double> heights_of(const OpenVolume& volume, const std::vector<std::vector<FaceId>>& parts,
                               const std::vector<SideLine>& lines, Digits digits, const RunContext& context)
{
    const Model& model = volume.model;
    const KnownHeights known(volume, lines);
    std::vector<geometry::HarmonicValues> solved(parts.size());
    parallel_each(context, parts.size(), 1, [&](std::size_t i) {
        const std::vector<Triangle> triangles = facets_of(model, parts[i]);
        geometry::HarmonicProblem problem;
        problem.nine_digits = digits == Digits::nine;
        problem.points = model.points;
        problem.triangles = triangles;
        if (known.fix(problem)) solved[i] = geometry::solve_on_facets(problem, context);
    });
    std::vector<double> heights(model.points.size(), std::numeric_limits<double>::quiet_NaN());
    for (const geometry::HarmonicValues& part : solved)
        for (std::size_t p = 0; p < part.points.size(); ++p)
            heights[index(part.points[p])] = part.values(static_cast<Eigen::Index>(p), 0);
    return heights;
}

/// A wall edge that climbs steeply enough for a side line, and its cost in a path. `Rises` groups such edges
/// by their lower vertex.
struct Rise {
    EdgeUse use;
    VertexId to;
    double cost;
};
using Rises = std::map<VertexId, std::vector<Rise>>;

/// The edges of walls that belong to no end and to no void face over which a wall continues.
std::set<EdgeId> edges_between(const OpenVolume& volume)
{
    std::set<EdgeId> between = edges_of(volume.model, volume.faces(Role::wall));
    for (const Role end : {Role::source, Role::target})
        for (const EdgeId edge : edges_of(volume.model, volume.faces(end))) between.erase(edge);
    for (const FaceId face : volume.faces(Role::wall))
        if (continued_wall(volume.model, face))
            for (const EdgeUse& use : uses_of(volume.model[face])) between.erase(use.edge);
    return between;
}

std::set<VertexId> rim_vertices(const OpenVolume& volume, Role role)
{
    std::set<VertexId> vertices;
    for (const EdgeUse& use : rim_uses(volume.model, volume.faces(role)))
        vertices.insert(use_from(volume.model, use));
    return vertices;
}

/// Whether side lines must be chosen among several paths: an inner vertex has more than two of these edges,
/// or a rim vertex more than one.
bool has_choices(const OpenVolume& volume, const std::set<EdgeId>& edges)
{
    std::map<VertexId, int> room;
    for (const Role end : {Role::source, Role::target})
        for (const VertexId vertex : rim_vertices(volume, end)) room[vertex] = 1;
    for (const EdgeId edge : edges) {
        for (const bool reversed : {false, true}) {
            const VertexId vertex = use_from(volume.model, EdgeUse{edge, reversed});
            if (--room.try_emplace(vertex, 2).first->second < 0) return true;
        }
    }
    return false;
}

/// The connected parts of the walls that have some of these edges. Heights of other parts are not needed.
std::vector<std::vector<FaceId>> wall_parts_with(const OpenVolume& volume, const std::set<EdgeId>& edges)
{
    std::set<FaceId> beside;
    for (const EdgeId edge : edges)
        for (const FaceUse& use : volume.model.uses_of_edge(edge)) beside.insert(use.face);
    std::vector<std::vector<FaceId>> parts = connected_parts(volume.model, volume.faces(Role::wall));
    std::erase_if(parts, [&](const std::vector<FaceId>& part) {
        return std::ranges::none_of(part, [&](FaceId face) { return beside.contains(face); });
    });
    return parts;
}

/// The climb of each edge.
std::vector<double> climbs(const OpenVolume& volume, const std::set<EdgeId>& edges,
                           const std::vector<double>& heights)
{
    const std::vector<double> gradient = height_gradient(volume, heights);
    std::vector<double> up;
    for (const EdgeId edge : edges) up.push_back(climb(volume.model, edge, heights, gradient));
    return up;
}

Rises rises(const OpenVolume& volume, const RunContext& context)
{
    // If heights have nine correct digits, climbs have six. If a climb differs from `kLevel` by less than
    // kVisible, a thousand times this error, all heights are computed again with full precision.
    const Model& model = volume.model;
    const std::set<EdgeId> between = edges_between(volume);
    if (between.empty()) return {};
    const std::vector<std::vector<FaceId>> parts = wall_parts_with(volume, between);
    std::vector<double> up;
    const auto in_doubt = [](double u) { return std::abs(std::abs(u) - kLevel) <= kVisible; };
    if (!has_choices(volume, between))
        up = climbs(volume, between, heights_of(volume, parts, {}, Digits::nine, context));
    if (up.empty() || std::ranges::any_of(up, in_doubt))
        up = climbs(volume, between, heights_of(volume, parts, {}, Digits::all, context));
    Rises result;
    const std::set<VertexId> low = rim_vertices(volume, Role::source),
                             high = rim_vertices(volume, Role::target);
    const auto spans = [&](VertexId a, VertexId b) { return low.contains(a) && high.contains(b); };
    auto climb = up.begin();
    for (const EdgeId edge : between) {
        double own = *climb++;
        const Edge& e = model[edge];
        // A void edge from end to end joins matched vertices, so it is a side line even if it climbs little.
        if (e.origin == Origin::made_void && !(std::abs(own) > kLevel))
            own = spans(e.from, e.to) - spans(e.to, e.from);
        if (!(std::abs(own) > kLevel)) continue;
        const EdgeUse use{edge, own < 0};
        result[use_from(model, use)].push_back(
            {use, use_to(model, use), edge_length(model, edge) / std::abs(own)});
    }
    return result;
}

struct Path {
    SideLine line;
    double cost = 0;
};

/// Cheapest path from a vertex up to any target vertex that passes none of the vertices `taken`.
std::optional<Path> climb_from(VertexId start, const Rises& graph, const std::set<VertexId>& targets,
                               const std::set<VertexId>& taken, const Model& model)
{
    std::map<VertexId, std::pair<double, EdgeUse>> reached;
    using Item = std::pair<double, VertexId>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> front;
    std::set<VertexId> done;
    front.emplace(0.0, start);
    while (!front.empty()) {
        const auto [cost, at] = front.top();
        front.pop();
        if (!done.insert(at).second) continue;
        if (targets.contains(at)) {
            Path path{{start, at, {}}, cost};
            for (VertexId back = at; back != start; back = use_from(model, reached.at(back).second)) {
                path.line.uses.push_back(reached.at(back).second);
            }
            std::reverse(path.line.uses.begin(), path.line.uses.end());
            return path;
        }
        const auto found = graph.find(at);
        if (found == graph.end()) continue;
        for (const Rise& rise : found->second) {
            if (taken.contains(rise.to) || done.contains(rise.to)) continue;
            const double sum = cost + rise.cost;
            const auto known = reached.find(rise.to);
            if (known != reached.end() && known->second.first <= sum) continue;
            reached[rise.to] = {sum, rise.use};
            front.emplace(sum, rise.to);
        }
    }
    return std::nullopt;
}

} // namespace

std::vector<double> wall_heights(const OpenVolume& volume, const std::vector<SideLine>& lines,
                                 const RunContext& context)
{
    const auto parts = connected_parts(volume.model, volume.faces(Role::wall));
    return heights_of(volume, parts, lines, Digits::all, context);
}

std::vector<double> height_gradient(const OpenVolume& volume, const std::vector<double>& heights)
{
    const Model& model = volume.model;
    std::vector<double> sum(model.points.size(), 0), weight(model.points.size(), 0);
    for (const FaceId face : volume.faces(Role::wall)) {
        for (const Triangle& t : model[face].triangles) {
            const Vec3 a = model.at(t[1]) - model.at(t[0]);
            const Vec3 b = model.at(t[2]) - model.at(t[0]);
            const Vec3 normal = a.cross(b);
            const double area2 = normal.squaredNorm();
            const double ha = heights[index(t[1])] - heights[index(t[0])];
            const double hb = heights[index(t[2])] - heights[index(t[0])];
            if (!(area2 > 0) || std::isnan(ha) || std::isnan(hb)) continue;
            const Vec3 gradient = (ha * b.cross(normal) + hb * normal.cross(a)) / area2;
            const double area = std::sqrt(area2);
            for (const Index p : t) {
                sum[static_cast<std::size_t>(p)] += area * gradient.norm();
                weight[static_cast<std::size_t>(p)] += area;
            }
        }
    }
    for (std::size_t p = 0; p < sum.size(); ++p)
        sum[p] = weight[p] > 0 ? sum[p] / weight[p] : std::numeric_limits<double>::quiet_NaN();
    return sum;
}

double climb(const Model& model, EdgeId edge, const std::vector<double>& heights,
             const std::vector<double>& gradient)
{
    const std::vector<Index>& points = model[edge].points;
    double most = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const auto a = static_cast<std::size_t>(points[i]);
        const auto b = static_cast<std::size_t>(points[i + 1]);
        most += (model.points[b] - model.points[a]).norm() * (gradient[a] + gradient[b]) / 2;
    }
    const double rise = heights[static_cast<std::size_t>(points.back())] -
                        heights[static_cast<std::size_t>(points.front())];
    return most > 0 ? rise / most : std::numeric_limits<double>::quiet_NaN();
}

std::optional<FaceId> continued_wall(const Model& model, FaceId face)
{
    if (model[face].origin != Origin::made_void || model[face].loops.size() != 1) return std::nullopt;
    const std::vector<EdgeUse>& rim = model[face].loops.front().uses;
    std::set<FaceId> beside;
    std::size_t corners = 0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        for (const FaceUse& user : model.uses_of_edge(rim[i].edge)) beside.insert(user.face);
        corners += is_corner(model, rim, i) ? 1 : 0;
    }
    beside.erase(face);
    if (corners == 4 || beside.size() != 1) return std::nullopt;
    const Face& wall = model[*beside.begin()];
    if (wall.origin == Origin::made_void || wall.keeps_nodes) return std::nullopt;
    return *beside.begin();
}

std::vector<SideLine> side_lines(const OpenVolume& volume, const RunContext& context)
{
    const Model& model = volume.model;
    const Rises graph = rises(volume, context);
    const std::set<VertexId> targets = rim_vertices(volume, Role::target);
    std::vector<Path> waiting; // the cheapest path of each source vertex
    std::set<VertexId> taken;
    for (const VertexId start : rim_vertices(volume, Role::source)) {
        check_cancelled(context);
        if (targets.contains(start)) // possible, for example, after the rims of steps were divided
            throw InvalidInput(Message("topology.ends_touch",
                                       "source and target meet in {}; the ends of a sweep must not touch",
                                       entity_of(model, start))
                                   .remedy("choose other faces"));
        if (auto path = climb_from(start, graph, targets, taken, model)) waiting.push_back(std::move(*path));
    }
    std::vector<SideLine> lines;
    while (!waiting.empty()) {
        check_cancelled(context);
        const auto best = std::ranges::min_element(waiting, {}, &Path::cost);
        std::set<VertexId> gone; // vertices of this line; no other line may pass them now
        for (const EdgeUse& use : best->line.uses) gone.insert(use_to(model, use));
        taken.insert(gone.begin(), gone.end());
        lines.push_back(std::move(best->line));
        waiting.erase(best);
        // Other paths that pass these vertices are searched again; the rest are still the cheapest.
        std::erase_if(waiting, [&](Path& path) {
            const bool loses = std::ranges::any_of(
                path.line.uses, [&](EdgeUse use) { return gone.contains(use_to(model, use)); });
            if (!loses) return false;
            auto other = climb_from(path.line.source, graph, targets, taken, model);
            if (other) path = std::move(*other);
            return !other.has_value();
        });
    }
    std::ranges::sort(lines, {}, &SideLine::source);
    return lines;
}

} // namespace lacuna::matching
