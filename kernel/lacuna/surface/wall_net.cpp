// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/wall_net.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/shared/joined_faces.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Whether an edge leaves the direction of its column or level as at a crease.
bool is_slanted(double across, double along) { return std::atan2(across, along) > kCreaseAngle * kDegree; }

double wrapped(double s) { return s - std::floor(s + kSamePlace); }

/// Whether two intervals on a circle of length 1 have more than a point in common.
bool overlap(double a0, double a1, double b0, double b1)
{
    const double shift = std::floor(a0 - b0);
    for (const double turn : {shift - 1, shift, shift + 1, shift + 2}) {
        if (std::min(a1, b1 + turn) - std::max(a0, b0 + turn) > kSamePlace) return true;
    }
    return false;
}

class NetMaker {
public:
    NetMaker(const Model& model, const LinkingSurface& link, const LinkingMap& map)
        : model_(model), link_(link), map_(map)
    {
        for (std::size_t u = 0; u < link.source.uses().size(); ++u)
            on_source_[use_from(model, link.source.uses()[u])] = link.source.start(u);
        for (std::size_t u = 0; u < link.target.uses().size(); ++u)
            on_target_[use_from(model, link.target.uses()[u])] = link.target.start(u);
        for (std::size_t i = 0; i < link.lines.size(); ++i) {
            for (const EdgeUse& use : link.lines[i].line.uses)
                on_line_[use_from(model, use)] = on_line_[use_to(model, use)] = i;
        }
    }

    WallNet run()
    {
        for (const LinkingMap::Upright& upright : map_.uprights()) add_long_edge(upright);
        for (std::size_t r = 0; r < map_.rings().size(); ++r) add_level(r);
        for (const WallNet::Level& level : net_.levels) check_one_way(map_.rings()[*level.ring]);
        if (net_.stops.empty()) return std::move(net_);
        for (std::size_t r = 0; r < map_.rings().size(); ++r) check_cross_edges(net_.levels[r]);
        make_columns();
        make_point_levels();
        sort();
        return std::move(net_);
    }

private:
    std::size_t stop_at(VertexId vertex, const Vec2& place)
    {
        const auto [found, fresh] = stop_of_.try_emplace(vertex, net_.stops.size());
        if (fresh) net_.stops.push_back({vertex, place});
        return found->second;
    }

    void add_long_edge(const LinkingMap::Upright& upright)
    {
        if (upright.pieces.empty())
            refuse_wall_edge(model_, upright.edge, "has no part between the rims", "merge the two faces");
        double up = 0;
        for (const LinkingMap::Piece& piece : upright.pieces) up += piece.b.y() - piece.a.y();
        for (const LinkingMap::Piece& piece : upright.pieces) {
            const double rise = (up > 0 ? 1 : -1) * (piece.b.y() - piece.a.y()) * map_.height();
            if (is_slanted(std::abs(piece.b.x() - piece.a.x()) * map_.width(), rise))
                refuse_direction(upright.edge);
        }
        const Edge& edge = model_[upright.edge];
        const LinkingMap::Piece &first = upright.pieces.front(), &last = upright.pieces.back();
        const bool as_edge = first.from < last.to;
        const std::size_t a = stop_at(as_edge ? edge.from : edge.to, first.a);
        const std::size_t b = stop_at(as_edge ? edge.to : edge.from, last.b);
        const bool rises = up > 0;
        net_.long_edges.push_back({&upright, rises ? a : b, rises ? b : a, rises != as_edge});
    }

    [[noreturn]] void refuse_direction(EdgeId edge) const
    {
        refuse_wall_edge(model_, edge,
                         "crosses the layers: a wall edge must run along the sweep or around it",
                         "choose other faces as source and target, cut the volume where its section "
                         "changes, or merge the two faces");
    }

    /// Positions in the strip of the end vertices of a ring's edges.
    [[nodiscard]] std::map<VertexId, Vec2> places_of(const LinkingMap::Ring& ring) const
    {
        std::map<VertexId, Vec2> places;
        for (const LinkingMap::Piece& piece : ring.pieces) {
            const Edge& edge = model_[piece.edge];
            const auto end = [&](double share, const Vec2& place) {
                if (share < kSamePlace) places.emplace(edge.from, place);
                if (share > 1 - kSamePlace) places.emplace(edge.to, place);
            };
            end(piece.from, piece.a);
            end(piece.to, piece.b);
        }
        return places;
    }

    void add_level(std::size_t r)
    {
        const LinkingMap::Ring& ring = map_.rings()[r];
        WallNet::Level level;
        level.height = ring.height;
        level.ring = r;
        level.edge = ring.pieces.front().edge;
        level.plain = true;
        const std::map<VertexId, Vec2> places = places_of(ring);
        for (const auto& [vertex, place] : places) {
            const auto line = on_line_.find(vertex);
            if (line != on_line_.end()) level.lines.push_back(line->second);
            const bool met = stop_of_.contains(vertex);
            const EdgeId corner = corner_at(ring, vertex);
            if (!met && (!corner.valid() || on_line_.contains(vertex))) continue;
            if (on_source_.contains(vertex) || on_target_.contains(vertex)) {
                // The level ends on the rim, where a column may start but no layer can follow the level.
                refuse_wall_edge(model_, corner.valid() ? corner : level.edge,
                                 "runs around the walls and ends on a rim, where no layer can follow it",
                                 "let it end above or below the rim, or merge the two faces");
            }
            level.plain = false;
            level.stops.push_back(stop_at(vertex, place));
        }
        // A level with stops also has stops at those of its vertices that are on side lines.
        for (const auto& [vertex, place] : places) {
            if (level.plain || !on_line_.contains(vertex)) continue;
            const std::size_t stop = stop_at(vertex, place);
            if (std::ranges::find(level.stops, stop) == level.stops.end()) level.stops.push_back(stop);
        }
        for (const std::size_t stop : level.stops) net_.stops[stop].level = static_cast<int>(r);
        level_stops_.insert(level.stops.begin(), level.stops.end());
        net_.levels.push_back(std::move(level));
    }

    /// If a ring turns or ends at a vertex: an edge of the ring at this vertex. Invalid if the ring continues
    /// smoothly there.
    [[nodiscard]] EdgeId corner_at(const LinkingMap::Ring& ring, VertexId vertex) const
    {
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
        return away.size() == 2 && away[0].dot(away[1]) < -kOneCurve ? EdgeId() : any;
    }

    /// Check that the edges of a ring follow each other around the walls in one direction. Edges around a
    /// round patch do not: they turn back.
    void check_one_way(const LinkingMap::Ring& ring) const
    {
        struct Reach {
            EdgeId edge;
            double at, low, high, way;
        };
        std::vector<Reach> reaches;
        for (const LinkingMap::Piece& piece : ring.pieces) {
            if (reaches.empty() || reaches.back().edge != piece.edge)
                reaches.push_back({piece.edge, piece.a.x(), piece.a.x(), piece.a.x(), 0});
            Reach& reach = reaches.back();
            reach.at += piece.b.x() - piece.a.x();
            reach.way += std::abs(piece.b.x() - piece.a.x());
            reach.low = std::min(reach.low, reach.at);
            reach.high = std::max(reach.high, reach.at);
        }
        // Minimum range of s of an edge, as a share of the sum of its movements in s, forwards and backwards.
        // An edge in one direction has 1; a closed edge that returns to its start has one half. Heuristic.
        constexpr double kStraightOn = 0.75;
        for (std::size_t i = 0; i < reaches.size(); ++i) {
            const Reach& reach = reaches[i];
            if (reach.high - reach.low < kStraightOn * reach.way) refuse_direction(reach.edge);
            for (std::size_t j = 0; j < i; ++j) {
                if (overlap(reaches[j].low, reaches[j].high, reach.low, reach.high))
                    refuse_direction(reach.edge);
            }
        }
    }

    /// Check that the edges of levels with stops are nearly horizontal throughout. Rings without stops, which
    /// run from side line to side line or all around the walls, may climb.
    void check_cross_edges(const WallNet::Level& level) const
    {
        if (level.plain) return;
        std::map<EdgeId, double> round;
        for (const LinkingMap::Piece& piece : map_.rings()[*level.ring].pieces)
            round[piece.edge] += piece.b.x() - piece.a.x();
        std::map<VertexId, int> ends;
        for (const auto& [id, along] : round) {
            const Edge& edge = model_[id];
            for (const VertexId end : {edge.from, edge.to}) {
                if (++ends[end] < 3) continue;
                refuse_wall_edge(model_, id,
                                 "branches off other edges around the walls, and a layer can follow only "
                                 "one of them",
                                 "merge two of the faces there");
            }
        }
        for (const LinkingMap::Piece& piece : map_.rings()[*level.ring].pieces) {
            const double along = (round[piece.edge] > 0 ? 1 : -1) * (piece.b.x() - piece.a.x());
            if (is_slanted(std::abs(piece.b.y() - piece.a.y()) * map_.height(), along * map_.width()))
                refuse_direction(piece.edge);
        }
    }

    [[nodiscard]] EdgeId edge_at(std::size_t stop) const
    {
        for (const WallNet::LongEdge& edge : net_.long_edges) {
            if (edge.low == stop || edge.high == stop) return edge.upright->edge;
        }
        for (const WallNet::Level& level : net_.levels) {
            if (std::ranges::find(level.stops, stop) == level.stops.end()) continue;
            for (const LinkingMap::Piece& piece : map_.rings()[*level.ring].pieces) {
                const Edge& edge = model_[piece.edge];
                if (edge.from == net_.stops[stop].vertex || edge.to == net_.stops[stop].vertex)
                    return piece.edge;
            }
        }
        return net_.levels.front().edge;
    }

    void make_columns()
    {
        geometry::UnionFind groups(net_.stops.size());
        for (const WallNet::LongEdge& edge : net_.long_edges) {
            for (const std::size_t end : {edge.low, edge.high}) {
                if (!on_line_.contains(net_.stops[end].vertex)) continue;
                refuse_wall_edge(
                    model_, edge.upright->edge,
                    "starts or ends on a side line, and a column of nodes can follow only one of "
                    "them",
                    "let it start on the rim or on an edge around the walls, or merge the two "
                    "faces");
            }
            groups.unite(edge.high, edge.low);
        }
        std::map<std::size_t, std::size_t> of_line;
        for (std::size_t i = 0; i < net_.stops.size(); ++i) {
            const auto line = on_line_.find(net_.stops[i].vertex);
            if (line != on_line_.end()) groups.unite(i, of_line.try_emplace(line->second, i).first->second);
        }
        std::map<std::size_t, std::vector<std::size_t>> members;
        for (std::size_t i = 0; i < net_.stops.size(); ++i) members[groups.find(i)].push_back(i);
        std::vector<std::pair<WallNet::Column, std::vector<std::size_t>>> made;
        for (const auto& [root, stops] : members) made.emplace_back(column_of(stops), stops);
        std::ranges::stable_sort(made, [](const auto& a, const auto& b) { return a.first.at < b.first.at; });
        for (auto& [column, stops] : made) {
            for (const std::size_t stop : stops) net_.stops[stop].column = net_.columns.size();
            net_.columns.push_back(column);
        }
    }

    WallNet::Column column_of(const std::vector<std::size_t>& stops)
    {
        WallNet::Column column;
        column.edge = edge_at(stops.front());
        const double first = net_.stops[stops.front()].place.x();
        double least = first, most = first;
        for (const std::size_t i : stops) {
            WallNet::Stop& stop = net_.stops[i];
            const double s = stop.place.x() - std::round(stop.place.x() - first);
            least = std::min(least, s);
            most = std::max(most, s);
            const auto low = on_source_.find(stop.vertex), high = on_target_.find(stop.vertex);
            const auto line = on_line_.find(stop.vertex);
            if (low != on_source_.end()) {
                stop.level = WallNet::kSource;
                stop.place.y() = 0;
                column.source_at = low->second;
            }
            if (high != on_target_.end()) {
                stop.level = WallNet::kTarget;
                stop.place.y() = 1;
                column.target_at = high->second;
            }
            column.low = std::min(column.low, stop.place.y());
            column.high = std::max(column.high, stop.place.y());
            if (line != on_line_.end()) column.line = line->second;
        }
        column.at = wrapped((least + most) / 2);
        if (column.target_at) column.at = wrapped(target_coordinate(link_, *column.target_at));
        if (column.source_at) column.at = wrapped(*column.source_at / link_.source.length());
        if (column.line) column.at = wrapped(link_.lines[*column.line].source_at / link_.source.length());
        return column;
    }

    /// Create a level for each stop between the rims that is on no cross edge.
    void make_point_levels()
    {
        for (std::size_t i = 0; i < net_.stops.size(); ++i) {
            WallNet::Stop& stop = net_.stops[i];
            if (stop.level == WallNet::kSource && on_source_.contains(stop.vertex)) continue;
            if (stop.level == WallNet::kTarget || level_stops_.contains(i)) continue;
            stop.level = static_cast<int>(net_.levels.size());
            WallNet::Level level;
            level.height = stop.place.y();
            level.stops = {i};
            level.edge = edge_at(i);
            net_.levels.push_back(std::move(level));
        }
    }

    void sort()
    {
        std::vector<std::size_t> order(net_.levels.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, {}, [&](std::size_t level) { return net_.levels[level].height; });
        std::vector<WallNet::Level> sorted;
        std::vector<int> place(order.size());
        for (std::size_t k = 0; k < order.size(); ++k) {
            place[order[k]] = static_cast<int>(k);
            sorted.push_back(std::move(net_.levels[order[k]]));
        }
        net_.levels = std::move(sorted);
        for (WallNet::Stop& stop : net_.stops) {
            if (stop.level >= 0) stop.level = place[static_cast<std::size_t>(stop.level)];
        }
    }

    const Model& model_;
    const LinkingSurface& link_;
    const LinkingMap& map_;
    WallNet net_;
    std::map<VertexId, double> on_source_, on_target_;
    std::map<VertexId, std::size_t> on_line_;
    std::map<VertexId, std::size_t> stop_of_;
    std::set<std::size_t> level_stops_; ///< stops of rings
};

} // namespace

bool WallNet::over_each_other(const LinkingMap& map, std::size_t a, std::size_t b) const
{
    for (const std::size_t line : levels[a].lines) {
        if (std::ranges::find(levels[b].lines, line) != levels[b].lines.end()) return true;
    }
    for (const std::size_t i : levels[a].stops) {
        for (const std::size_t j : levels[b].stops) {
            if (stops[i].column == stops[j].column) return true;
        }
    }
    if (!levels[a].ring || !levels[b].ring) {
        const Level& point = levels[a].ring ? levels[b] : levels[a];
        const Level& other = levels[a].ring ? levels[a] : levels[b];
        return other.ring &&
               !LinkingMap::crossings(map.rings()[*other.ring], columns[stops[point.stops.front()].column].at)
                    .empty();
    }
    for (const LinkingMap::Piece& p : map.rings()[*levels[a].ring].pieces) {
        for (const LinkingMap::Piece& q : map.rings()[*levels[b].ring].pieces) {
            if (overlap(std::min(p.a.x(), p.b.x()), std::max(p.a.x(), p.b.x()), std::min(q.a.x(), q.b.x()),
                        std::max(q.a.x(), q.b.x())))
                return true;
        }
    }
    return false;
}

std::vector<std::vector<std::size_t>> WallNet::levels_below(const LinkingMap& map) const
{
    std::vector<std::vector<std::size_t>> below(levels.size());
    for (std::size_t b = 0; b < levels.size(); ++b) {
        for (std::size_t a = 0; a < b; ++a) {
            if (over_each_other(map, a, b)) below[b].push_back(a);
        }
    }
    return below;
}

int most_levels(const std::vector<std::vector<std::size_t>>& below)
{
    std::vector<int> depth(below.size(), 1);
    for (std::size_t b = 0; b < below.size(); ++b) {
        for (const std::size_t a : below[b]) depth[b] = std::max(depth[b], depth[a] + 1);
    }
    return depth.empty() ? 0 : *std::ranges::max_element(depth);
}

WallNet wall_net(const Model& model, const LinkingSurface& link, const LinkingMap& map)
{
    return NetMaker(model, link, map).run();
}

void refuse_wall_edge(const Model& model, EdgeId edge, const char* why, const char* remedy)
{
    std::vector<NamedEntity> faces;
    for (const FaceUse& use : model.uses_of_edge(edge)) faces.push_back(entity_of(model, use.face));
    // Coarse facets of a tube may bend as much as those at an edge.
    const std::span<const FaceUse> uses = model.uses_of_edge(edge);
    const bool of_facets = uses.size() == 2 && std::ranges::all_of(uses, [&](const FaceUse& use) {
                               const Face& face = model[use.face];
                               return face.origin == Origin::given && !face.surface && !face.keeps_nodes &&
                                      are_named_alike(face, model[uses.front().face]);
                           });
    throw NotSweepable(
        Message("surface.wall_edge", "{} of {} {}", entity_of(model, edge), faces, why)
            .remedy("{}{}", remedy,
                    of_facets ? ", or load with a larger 'feature_angle' if it only bends between facets"
                              : ""));
}

} // namespace lacuna::surface
