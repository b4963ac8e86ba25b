// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/rim_breaks.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/detail/chain_nodes.h>
#include <lacuna/surface/detail/edge_turning.h>
#include <lacuna/surface/detail/imprint_rules.h>
#include <lacuna/surface/detail/paired_breaks.h>
#include <lacuna/topology/shared/facet_area.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace lacuna::surface {

using namespace topology;

namespace {

/// The points that the Douglas-Peucker rule keeps, including both ends. All other points lie within `sag` of
/// the resulting chords.
std::vector<std::size_t> kept_points(std::span<const Vec3> points, double sag)
{
    std::vector<std::size_t> kept{0}, ends{points.size() - 1}; // accepted points, and ends of chords to test
    while (!ends.empty()) {
        const std::size_t from = kept.back(), to = ends.back();
        const Vec3 chord = points[to] - points[from];
        const double length2 = chord.squaredNorm();
        std::size_t furthest = from;
        double most = sag;
        for (std::size_t i = from + 1; i < to; ++i) {
            const Vec3 off = points[i] - points[from];
            const double along = length2 > 0 ? std::clamp(off.dot(chord) / length2, 0.0, 1.0) : 0;
            const double distance = (off - along * chord).norm();
            if (distance <= most) continue;
            most = distance;
            furthest = i;
        }
        if (furthest == from) {
            kept.push_back(to);
            ends.pop_back();
        } else {
            ends.push_back(furthest);
        }
    }
    return kept;
}

/// Whether an edge of a chain starts at a position. Such a position is a node in any case.
bool starts_at(const Chain& chain, double at)
{
    for (std::size_t u = 0; u <= chain.uses().size(); ++u)
        if (std::abs(chain.start(u) - at) <= kSamePlace * chain.length()) return true;
    return false;
}

/// `at` shifted by whole turns so that it is nearest to `to`.
double nearest_turn(double at, double to, double length)
{
    return at + std::round((to - at) / length) * length;
}

/// Move each end of a segment on one rim to the nearest of `vertices`, if the distance is below the share
/// `kOneEdge` of their mean spacing. Ends at which an edge of the rim starts do not move.
template <class Vertices>
void snap(BreakPairs& ends, double std::pair<double, double>::*side, const Chain& chain,
          const Vertices& vertices)
{
    const double length = chain.length(), reach = kOneEdge * length / static_cast<double>(vertices.size());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        double& at = ends[i].*side;
        if (starts_at(chain, chain.wrapped(at))) continue;
        double best = at, least = reach;
        for (const auto& vertex : vertices) {
            const double place = nearest_turn(vertex.at, at, length);
            if (std::abs(place - at) >= least) continue;
            least = std::abs(place - at);
            best = place;
        }
        if (best >= ends[i + 1].*side || best < 0 || (i > 0 && best <= ends[i - 1].*side)) continue;
        if (i == 0) ends.back().*side += best - at;
        at = best;
    }
}

/// Relative positions of the vertices between two positions, in increasing order.
template <class Vertices>
std::vector<double> shares_between(double from, double to, const Chain& chain, const Vertices& vertices)
{
    std::vector<double> shares;
    for (const auto& vertex : vertices) {
        const double share = (nearest_turn(vertex.at, (from + to) / 2, chain.length()) - from) / (to - from);
        if (share > kSamePlace && share < 1 - kSamePlace) shares.push_back(share);
    }
    std::ranges::sort(shares);
    return shares;
}

/// The positions on both rims of the starts of all segments, and of the end of the last segment.
BreakPairs boundaries(const LinkingSurface& link)
{
    BreakPairs ends;
    for (const RimSegment& segment : link.segments)
        ends.emplace_back(segment.source_from, segment.target_from);
    ends.emplace_back(link.source.length(), ends.front().second + link.target.length());
    return ends;
}

/// Whether a list contains a pair, up to whole turns.
bool holds(const BreakPairs& pairs, const std::pair<double, double>& wanted, const LinkingSurface& link)
{
    const double length = link.target.length();
    return std::ranges::any_of(pairs, [&](const std::pair<double, double>& pair) {
        return std::abs(pair.first - wanted.first) <= kSamePlace * link.source.length() &&
               std::abs(nearest_turn(pair.second, wanted.second, length) - wanted.second) <=
                   kSamePlace * length;
    });
}

/// Close a list of pairs to a whole ring, and add a pair at the start of each source edge.
BreakPairs with_starts(BreakPairs pairs, const LinkingSurface& link)
{
    pairs.emplace_back(link.source.length(), pairs.front().second + link.target.length());
    for (std::size_t u = 1; u < link.source.uses().size(); ++u) {
        const double at = link.source.start(u);
        const auto next = std::ranges::lower_bound(pairs, at - kSamePlace * link.source.length(), {},
                                                   &std::pair<double, double>::first);
        if (std::abs(next->first - at) <= kSamePlace * link.source.length()) continue;
        const auto& [s0, t0] = *(next - 1);
        const double share = (at - s0) / (next->first - s0);
        pairs.insert(next, {at, t0 + share * (next->second - t0)});
    }
    return pairs;
}

/// Pair vertices of the two rims that are close to each other. Pair every other vertex with the opposite
/// position on the other rim.
template <class Vertices>
BreakPairs paired_near(const LinkingSurface& link, const Vertices& low, const Vertices& high)
{
    BreakPairs ends = boundaries(link), pairs;
    if (!high.empty()) snap(ends, &std::pair<double, double>::second, link.target, high);
    if (!low.empty()) snap(ends, &std::pair<double, double>::first, link.source, low);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const auto [s0, t0] = ends[i];
        const auto [s1, t1] = ends[i + 1];
        const std::vector<double> own = shares_between(s0, s1, link.source, low);
        const std::vector<double> other = shares_between(t0, t1, link.target, high);
        const auto facets = static_cast<double>(std::max(own.size(), other.size()) + 1);
        BreakPairs inside = paired_breaks(own, other, kOneEdge / facets);
        complete(inside);
        pairs.emplace_back(s0, t0);
        for (const auto& [s, t] : inside) pairs.emplace_back(s0 + s * (s1 - s0), t0 + t * (t1 - t0));
    }
    pairs.push_back(ends.back());
    return pairs;
}

} // namespace

RimFacets::RimFacets(const OpenVolume& volume, std::span<const LinkingSurface> links)
    : volume_(volume), links_(links)
{
}

void RimFacets::find_sides()
{
    if (!end_of_.empty()) return;
    const Model& model = volume_.model;
    end_of_.assign(model.points.size(), 0);
    std::unordered_set<std::uint64_t> rim;
    for (const LinkingSurface& link : links_) {
        for (const Chain* chain : {&link.source, &link.target}) {
            const std::vector<ChainNode> nodes = chain_nodes(model, *chain);
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                end_of_[index(nodes[i].point)] = chain == &link.source ? 1 : 2;
                rim.insert(edge_key(nodes[i].point, nodes[(i + 1) % nodes.size()].point));
            }
        }
    }
    sides_.resize(model.points.size());
    std::vector<std::vector<std::pair<Index, Vec3>>> first(model.points.size()); // by the lower end of a side
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const bool wall = volume_.role[f] == Role::wall;
        for (const Triangle& t : model.faces[f].triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Index a = t[k], b = t[(k + 1) % 3];
                const bool across = end_of_[index(a)] != 0 && end_of_[index(b)] != 0;
                if ((!wall && !across) || (across && rim.contains(edge_key(a, b)))) continue;
                const Vec3 own = facet_area_vector(model, t);
                auto& known = first[index(std::min(a, b))];
                // Search from the end: the facets of a fan usually follow each other.
                const auto other = std::find_if(known.rbegin(), known.rend(), [&](const auto& side) {
                    return side.first == std::max(a, b);
                });
                if (other == known.rend()) {
                    known.emplace_back(std::max(a, b), own);
                    continue;
                }
                const double turn = geometry::angle_between(other->second, own);
                if (turn < kFileAccuracy) continue;
                sides_[index(a)].push_back({b, turn});
                sides_[index(b)].push_back({a, turn});
            }
        }
    }
}

const std::vector<Index>& RimFacets::crease(Index rim)
{
    find_sides();
    const auto [crease, fresh] = creases_.try_emplace(rim);
    if (fresh) crease->second = crease_from(rim);
    return crease->second;
}

/// Whether the given nodes on the rims of a linking surface are exactly the ends of its creases.
bool RimFacets::has_nodes_at(const LinkingSurface& link,
                             std::span<const std::pair<double, double>> creases) const
{
    const auto keeps = [&](const Chain& chain) {
        return std::ranges::any_of(chain.uses(),
                                   [&](EdgeUse use) { return volume_.model[use.edge].keeps_nodes; });
    };
    const bool low = keeps(link.source), high = keeps(link.target);
    if (link.segments.size() != creases.size()) return false;
    for (std::size_t i = 0; i < creases.size(); ++i) {
        const RimSegment& segment = link.segments[i];
        const double off = std::remainder(segment.target_from - creases[i].second, link.target.length());
        if (!segment.given || (high && std::abs(off) > kSamePlace * link.target.length()) ||
            (low && std::abs(segment.source_from - creases[i].first) > kSamePlace * link.source.length()))
            return false;
    }
    return true;
}

/// Follow the sharpest sides of facets from a point of a rim. @return  empty if they do not lead to another
/// rim
std::vector<Index> RimFacets::crease_from(Index rim) const
{
    const Model& model = volume_.model;
    const double least_cosine = std::cos(kBendBelow * kDegree);
    std::vector<Index> crease{rim};
    std::unordered_set<Index> passed{rim};
    while (crease.size() == 1 || end_of_[index(crease.back())] == 0) {
        const Vec3& here = model.at(crease.back());
        Index next = -1;
        double most = 0;
        for (const Side& side : sides_[index(crease.back())]) {
            double turn = side.turn;
            if (crease.size() > 1) {
                const Vec3 back = here - model.at(crease[crease.size() - 2]);
                const Vec3 on = model.at(side.to) - here;
                const double cosine = back.dot(on) / (back.norm() * on.norm());
                if (cosine < least_cosine) continue;
                turn *= cosine * cosine;
            }
            if (turn <= most) continue;
            most = turn;
            next = side.to;
        }
        if (next < 0 || !passed.insert(next).second) return {};
        crease.push_back(next);
    }
    return crease;
}

std::vector<RimFacets::Vertex> RimFacets::kept(const Chain& chain, int per_turn, const SizeField& size) const
{
    const Model& model = volume_.model;
    std::vector<Vertex> vertices;
    for (std::size_t u = 0; u < chain.uses().size(); ++u) {
        const EdgeUse use = chain.uses()[u];
        const Edge& edge = model[use.edge];
        if (edge.curve != nullptr) continue;
        if (edge.from != edge.to)
            vertices.push_back({chain.start(u), model[use_from(model, use)].point, use.edge, 0, true});
        if (edge.points.size() < 3) continue;
        const std::vector<Vec3> line = edge_line(model, use.edge);
        const std::vector<double> arc = geometry::arc_lengths(line);
        const double turn = EdgeTurning(model, use.edge).between(0, arc.back());
        if (turn < kFileAccuracy) continue;
        const double angle = kFullTurn / per_turn, sag = arc.back() * angle * angle / (8 * turn);
        const std::vector<std::size_t> points = kept_points(line, sag);
        const double most = std::max(turn / angle, arc.back() / size(line[line.size() / 2]));
        if (static_cast<double>(points.size() - 1) > std::ceil(most)) continue;
        // Skip both ends of an edge, which are nodes in any case. The start of a closed edge is kept.
        for (std::size_t k = edge.from == edge.to ? 0 : 1; k + 1 < points.size(); ++k) {
            const std::size_t i = points[k];
            const double along = use.reversed && i > 0 ? arc.back() - arc[i] : arc[i];
            vertices.push_back({chain.start(u) + along, edge.points[i], use.edge, arc[i] / arc.back()});
        }
    }
    std::ranges::sort(vertices, {}, &Vertex::at);
    return vertices;
}

/// If some vertex of an edge has no crease, remove all vertices of this edge.
std::vector<RimFacets::Vertex> RimFacets::on_creases(std::vector<Vertex> vertices)
{
    std::set<EdgeId> without;
    for (const Vertex& vertex : vertices)
        if (crease(vertex.point).empty() && !vertex.at_start) without.insert(vertex.edge);
    std::erase_if(vertices, [&](const Vertex& vertex) {
        return vertex.at_start ? crease(vertex.point).empty() : without.contains(vertex.edge);
    });
    return vertices;
}

RimBreaks RimFacets::breaks(int per_turn, const SizeField& size)
{
    RimBreaks breaks;
    breaks.pairs.resize(links_.size());
    breaks.on_crease.resize(links_.size());
    for (std::size_t b = 0; b < links_.size(); ++b) {
        const LinkingSurface& link = links_[b];
        const std::vector<Vertex> low = on_creases(kept(link.source, per_turn, size));
        const std::vector<Vertex> high = on_creases(kept(link.target, per_turn, size));
        if (low.empty() && high.empty()) continue;
        // Find the creases up the walls, and the positions on both rims that they connect.
        std::vector<Crease> up;
        BreakPairs joined;
        bool in_order = true;
        for (const Vertex& vertex : low) {
            const std::vector<Index>& crease = creases_.at(vertex.point);
            if (end_of_[index(crease.back())] == 1) continue;
            const auto end = std::ranges::find(high, crease.back(), &Vertex::point);
            if (end == high.end() && vertex.at_start) continue;
            in_order = in_order && end != high.end();
            if (!in_order) break;
            double at = end->at;
            if (!joined.empty() && at <= joined.back().second) at += link.target.length();
            in_order = joined.empty() ||
                       (at > joined.back().second && at < joined.front().second + link.target.length());
            up.push_back({vertex.at, crease});
            joined.emplace_back(vertex.at, at);
        }
        const auto is_up = [&](const Vertex& v) {
            return v.at_start || end_of_[index(creases_.at(v.point).back())] == 2;
        };
        const auto is_met = [&](const Vertex& v) {
            return is_up(v) ||
                   std::ranges::any_of(up, [&](const Crease& c) { return c.points.back() == v.point; });
        };
        if (!in_order || !std::ranges::all_of(high, is_met)) continue;
        const bool given = std::ranges::any_of(link.segments, &RimSegment::given);
        // A wall with a given mesh has the columns of this mesh, and none along creases.
        const bool meshed = std::ranges::any_of(link.walls,
                                                [&](FaceId wall) { return volume_.model[wall].keeps_nodes; });
        const bool whole = !meshed && link.lines.empty() && !up.empty() && up.front().source_at == 0 &&
                           std::ranges::all_of(low, is_up);
        BreakPairs pairs = given   ? whole && has_nodes_at(link, joined) ? with_starts(joined, link)
                                                                         : boundaries(link)
                             : whole ? with_starts(joined, link)
                                   : paired_near(link, low, high);
        if (!std::ranges::all_of(joined, [&](const auto& pair) { return holds(pairs, pair, link); }))
            continue;
        if (!whole && std::ranges::any_of(up, [](const Crease& c) { return c.points.size() > 2; })) continue;
        breaks.on_crease[b] = whole;
        if (!given || whole) breaks.pairs[b] = std::move(pairs);
        for (const std::vector<Vertex>* vertices : {&low, &high}) {
            for (const Vertex& vertex : *vertices) {
                breaks.points.insert(vertex.point);
                if (vertex.at_start) continue;
                std::vector<double>& at = breaks.edges[vertex.edge];
                if (vertex.fraction > 0) at.push_back(vertex.fraction);
            }
        }
    }
    for (auto& [edge, at] : breaks.edges) std::ranges::sort(at);
    return breaks;
}

std::vector<Crease> creases_of(const OpenVolume& volume, const LinkingSurface& link)
{
    std::vector<Crease> creases;
    if (!std::ranges::any_of(link.segments, &RimSegment::on_crease)) return creases;
    RimFacets facets(volume, std::span(&link, 1));
    const std::vector<ChainNode> nodes = chain_nodes(volume.model, link.source);
    for (const RimSegment& segment : link.segments) {
        const Index node = node_at(nodes, link.source, segment.source_from);
        if (!segment.on_crease || node < 0) continue;
        std::vector<Index> points = facets.crease(nodes[index(node)].point);
        if (!points.empty()) creases.push_back({nodes[index(node)].at, std::move(points)});
    }
    return creases;
}

std::vector<LinkingSurface> follow_facets(const RimBreaks& breaks, std::vector<LinkingSurface> links)
{
    for (std::size_t b = 0; b < links.size(); ++b) {
        LinkingSurface& link = links[b];
        for (RimSegment& segment : link.segments) segment.on_crease = breaks.on_crease[b];
        if (breaks.pairs[b].empty()) continue;
        const bool given = std::ranges::any_of(link.segments, &RimSegment::given);
        const auto follows = [&](const Chain& chain, double at) {
            const ChainPosition place = chain.position(std::fmod(at, chain.length()));
            return breaks.edges.contains(chain.uses()[place.use].edge);
        };
        link.segments.clear();
        for (std::size_t i = 0; i + 1 < breaks.pairs[b].size(); ++i) {
            const auto [s0, t0] = breaks.pairs[b][i];
            const auto [s1, t1] = breaks.pairs[b][i + 1];
            RimSegment segment{s0, s1, t0, t1, link.source.position((s0 + s1) / 2).use};
            segment.follows = follows(link.source, (s0 + s1) / 2);
            segment.target_follows = follows(link.target, (t0 + t1) / 2);
            segment.on_crease = breaks.on_crease[b];
            segment.given = given;
            link.segments.push_back(segment);
        }
    }
    return links;
}

} // namespace lacuna::surface
