// SPDX-License-Identifier: MIT
//
// imprint_target(): rims are paired first, so that every edge of the target that ends on the rim has a vertex
// to start from on the source. Then both ends are laid in one plane, their inner edges cut against each
// other, and the source faces made anew from the regions between them.
#include <lacuna/surface/imprint.h>

#include <lacuna/core/error.h>
#include <lacuna/core/number_text.h>
#include <lacuna/geometry/polyline.h>
#include <lacuna/geometry/triangulate.h>
#include <lacuna/matching/corners.h>
#include <lacuna/surface/detail/alike_ends.h>
#include <lacuna/surface/detail/flat_edges.h>
#include <lacuna/surface/detail/imprint_map.h>
#include <lacuna/surface/detail/linking_map.h>
#include <lacuna/surface/detail/plane_regions.h>
#include <lacuna/surface/detail/surface_curve.h>
#include <lacuna/topology/split_edge.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Edges of both ends nearer than this share of the size asked for are one: no quad fits between them. A
/// choice, not a measurement.
constexpr double kOneEdge = 0.4;
/// Edges that are laid more than so many times smaller on the other end are not imprinted: quads would have
/// to narrow by as much within one end. A tube of three radii's depth inside an end is laid out so; one of
/// 16, on a turned cutter, asked for a ring of 49,000 sides. A choice.
constexpr double kMostShrunk = 20;

[[noreturn]] void refuse(const Model& model, EdgeId edge, const std::string& why)
{
    throw NotSweepable(
        "surface.not_imprinted",
        name_of(model, edge) +
            " lies inside the end that is swept to and cannot be imprinted on the other: " + why);
}

/// A part of a flat edge between two cuts that follow each other.
struct Piece {
    std::size_t edge = 0; ///< number of the flat edge
    double from_at = 0, to_at = 1;
    std::size_t from = 0, to = 0; ///< nodes
    std::vector<Vec2> line;
    std::vector<double> at;
};

/// A chain of the plane with what it is on either end.
struct Border {
    EdgeId source; ///< in the new model
    std::optional<EdgeImage> image;
};

class Imprinter {
public:
    Imprinter(const OpenVolume& volume, std::span<const LinkingSurface> links, const SizeField& size,
              std::span<const KnownLine> known)
        : size_(size), given_links_(links), known_(known), inner_(inner_edges(volume, Role::target))
    {
        result_.volume = std::make_unique<OpenVolume>(volume);
        for (std::size_t f = 0; f < volume.model.faces.size(); ++f) result_.source_of.emplace_back(f);
    }

    Imprint run()
    {
        if (match_alike()) return std::move(result_);
        check_not_kept();
        pair_rims();
        link_anew();
        base_ = *result_.volume;
        map_.emplace(base_, result_.links, std::span<const ClosedPair>{}, known_);
        if (!map_->one_to_one()) {
            refuse(model(), inner_.front(), "source and target cannot be laid on each other one to one");
        }
        pair_closed();
        collect();
        snap();
        cross();
        cut_source();
        add_target();
        set_borders();
        check_sizes();
        split_faces();
        return std::move(result_);
    }

private:
    Model& model() { return result_.volume->model; }

    /// Both ends split alike need no map: edge goes to edge.
    bool match_alike()
    {
        std::optional<AlikeEnds> alike = alike_ends(*result_.volume, given_links_);
        if (!alike) return false;
        pairs_ = std::move(alike->pairs);
        link_anew();
        result_.target_of.resize(model().faces.size());
        for (const auto& [low, high] : alike->faces) result_.target_of[low.index()] = high;
        for (const auto& [low, high] : alike->edges) {
            // The target faces the other way: its edge is walked backwards.
            const bool along = low.reversed != high.reversed;
            result_.images[low.edge] = {high.edge, along ? 0.0 : 1.0, along ? 1.0 : 0.0};
        }
        return true;
    }

    /// An end that goes on far inside its rim, up a long tube, is laid on the other at a vanishing size.
    void check_sizes() const
    {
        for (const auto& [edge, image] : result_.images) {
            const Model& model = result_.volume->model;
            const double swept = std::abs(image.to - image.from) * edge_length(model, image.target);
            const double shrunk = swept / edge_length(model, edge);
            if (shrunk <= kMostShrunk) continue;
            refuse(model, image.target,
                   "it would be laid there " + with_digits(shrunk, 2) +
                       " times smaller than it is, as that end goes on far inside its rim; name other faces "
                       "as source and target");
        }
    }

    /// A face whose own quads are its mesh cannot be split.
    void check_not_kept()
    {
        for (const FaceId face : result_.volume->faces(Role::source)) {
            if (model()[face].given_quads.empty()) continue;
            refuse(model(), inner_.front(),
                   name_of(model(), face) +
                       " came with quads; load with keep_mesh = false, or name one face as the target");
        }
    }

    // --- rims ----------------------------------------------------------------------------------------

    /// Whether a vertex of the source's rim is swept to a corner or a side line's end of the target's.
    static bool is_taken(const Model& model, const LinkingSurface& link, double source_at)
    {
        const double slack = 1e-9 * link.source.length();
        for (const LinkingLine& line : link.lines) {
            if (std::abs(line.source_at - source_at) <= slack) return true;
        }
        for (const RimSegment& segment : link.segments) {
            if (std::abs(segment.source_from - source_at) > slack) continue;
            for (std::size_t i = 0; i < link.target.uses().size(); ++i) {
                double off = std::abs(segment.target_from - link.target.start(i));
                off = std::min(off, std::abs(off - link.target.length()));
                if (off <= 1e-9 * link.target.length() && matching::is_corner(model, link.target.uses(), i))
                    return true;
            }
        }
        return false;
    }

    /// A vertex on the source's rim for every one of the target's where an inner edge ends.
    void pair_rims()
    {
        std::set<VertexId> ends;
        for (const EdgeId edge : inner_) ends.insert({model()[edge].from, model()[edge].to});
        struct Split {
            double fraction;
            VertexId target;
        };
        std::map<EdgeId, std::vector<Split>> splits;
        const Model& before = model();
        for (const LinkingSurface& link : given_links_) {
            std::set<std::size_t> used;
            for (std::size_t i = 0; i < link.target.uses().size(); ++i) {
                const VertexId vertex = use_from(before, link.target.uses()[i]);
                if (!ends.contains(vertex)) continue;
                const double at = target_coordinate(link, link.target.start(i)) * link.source.length();
                const double exact = std::max(1e-9 * link.source.length(), before.tolerance);
                std::optional<std::size_t> near;
                double least = std::numeric_limits<double>::infinity();
                for (std::size_t u = 0; u < link.source.uses().size(); ++u) {
                    double off = std::abs(link.source.start(u) - at);
                    off = std::min(off, std::abs(off - link.source.length()));
                    const VertexId there = use_from(before, link.source.uses()[u]);
                    const double reach = kOneEdge * size_(before.at(before[there].point));
                    const bool free = !used.contains(u) && !is_taken(before, link, link.source.start(u));
                    if (off < least && (off <= exact || (free && off <= reach))) {
                        near = u;
                        least = off;
                    }
                }
                if (near) {
                    used.insert(*near);
                    pairs_.push_back({use_from(before, link.source.uses()[*near]), vertex});
                    continue;
                }
                const ChainPosition place = link.source.position(at);
                splits[link.source.uses()[place.use].edge].push_back({place.fraction, vertex});
            }
        }
        for (auto& [edge, list] : splits) {
            std::sort(list.begin(), list.end(),
                      [](const Split& a, const Split& b) { return a.fraction > b.fraction; });
            double end = 1; // the share of the whole that the edge still is
            for (const Split& split : list) {
                pairs_.push_back(
                    {split_at(edge, split.fraction / end, inner_at(split.target)), split.target});
                end = split.fraction;
            }
        }
    }

    /// The inner edge of the target that ends in a vertex.
    EdgeId inner_at(VertexId vertex)
    {
        for (const EdgeId edge : inner_) {
            if (model()[edge].from == vertex || model()[edge].to == vertex) return edge;
        }
        return inner_.front();
    }

    VertexId split_at(EdgeId edge, double fraction, EdgeId because)
    {
        try {
            return split_edge(model(), edge, fraction).vertex;
        } catch (const InvalidInput& error) {
            refuse(model(), because, error.what());
        }
    }

    void link_anew()
    {
        result_.links = linking_surfaces(*result_.volume, Turning::each, pairs_);
        for (std::size_t b = 0; b < result_.links.size(); ++b) {
            LinkingSurface& link = result_.links[b];
            const LinkingSurface& given = given_links_[b];
            if (link.source.uses() != given.source.uses() || link.target.uses() != given.target.uses())
                continue;
            const bool paired = std::any_of(pairs_.begin(), pairs_.end(), [&](const RimPair& pair) {
                return std::any_of(link.source.uses().begin(), link.source.uses().end(),
                                   [&](const EdgeUse& use) { return use_from(model(), use) == pair.source; });
            });
            if (paired) continue;
            link.segments = given.segments; // as they were turned
            link.branch = given.branch;
        }
    }

    // --- the plane -----------------------------------------------------------------------------------

    std::size_t add_node(const Vec2& place)
    {
        node_place_.push_back(place);
        node_vertex_.emplace_back();
        return node_place_.size() - 1;
    }

    [[nodiscard]] double reach(const Vec2& place) const
    {
        return kOneEdge * size_(map_->on_source(place).point);
    }

    FlatEdge flat_edge(EdgeId id, bool target)
    {
        FlatEdge flat{id, {}, geometry::arc_lengths(edge_line(base_.model, id)), {}};
        const double length = flat.at.back();
        for (double& at : flat.at) at /= length;
        for (const Index p : base_.model[id].points)
            flat.line.push_back(target ? map_->target(p) : map_->source(p));
        return flat;
    }

    // --- closed edges ----------------------------------------------------------------------------------

    /// A closed edge in the plane.
    struct Circle {
        EdgeId edge;
        Vec2 centre = Vec2::Zero();
        double area = 0;           ///< signed
        std::vector<Vec2> line;    ///< the first point repeated
        std::vector<double> share; ///< of the edge's length at each point
        [[nodiscard]] double radius() const { return std::sqrt(std::abs(area) / std::numbers::pi); }
    };

    /// Smooth closed edges that meet no other edge.
    std::vector<Circle> circles(Role role, const std::vector<EdgeId>& edges)
    {
        std::map<VertexId, int> ends;
        for (const Edge& edge : base_.model.edges) {
            ++ends[edge.from];
            ++ends[edge.to];
        }
        std::vector<Circle> found;
        for (const EdgeId id : edges) {
            const Edge& edge = base_.model[id];
            if (edge.from != edge.to || ends[edge.from] != 2) continue;
            constexpr double kSmooth = 0.7; ///< cosine of 45°; a choice, not a measurement
            const Vec3 out = base_.model.at(edge.points[1]) - base_.model.at(edge.points[0]);
            const Vec3 in = base_.model.at(edge.points.back()) -
                            base_.model.at(edge.points[edge.points.size() - 2]);
            if (out.dot(in) < kSmooth * out.norm() * in.norm()) continue;
            const FlatEdge flat = flat_edge(id, role == Role::target);
            Circle circle{id, Vec2::Zero(), 0, flat.line, flat.at};
            for (std::size_t i = 0; i + 1 < flat.line.size(); ++i) {
                const Vec2 &a = flat.line[i], &b = flat.line[i + 1];
                const double turn = (a.x() * b.y() - a.y() * b.x()) / 2;
                circle.area += turn;
                circle.centre += turn * (a + b) / 3;
            }
            if (!(std::abs(circle.area) > 0)) continue;
            circle.centre /= circle.area;
            found.push_back(std::move(circle));
        }
        return found;
    }

    /// How unlike what two closed edges enclose is: their distance and the difference of their radii, over
    /// the larger radius.
    static double unlike(const Circle& a, const Circle& b)
    {
        return ((a.centre - b.centre).norm() + std::abs(a.radius() - b.radius())) /
               std::max(a.radius(), b.radius());
    }

    /// Directions from its centre at even steps along a closed edge [radian].
    static std::vector<double> directions(const Circle& circle, std::size_t steps)
    {
        std::vector<double> result;
        for (std::size_t k = 0; k < steps; ++k) {
            const geometry::PolylinePlace at = geometry::place_at(
                circle.share, static_cast<double>(k) / static_cast<double>(steps));
            const Vec2 p = (1 - at.fraction) * circle.line[at.segment] +
                           at.fraction * circle.line[at.segment + 1] - circle.centre;
            result.push_back(std::atan2(p.y(), p.x()));
        }
        return result;
    }

    /// The share of the target's edge over the source edge's start, by which they are turned least.
    static ClosedPair turned(const Circle& low, const Circle& high)
    {
        constexpr std::size_t kSteps = 360; ///< a degree is near enough for where an edge starts
        const std::vector<double> a = directions(low, kSteps), b = directions(high, kSteps);
        const bool back = (low.area > 0) != (high.area > 0);
        std::size_t best = 0;
        double most = -2;
        for (std::size_t shift = 0; shift < kSteps; ++shift) {
            double sum = 0;
            for (std::size_t k = 0; k < kSteps; ++k)
                sum += std::cos(a[k] - b[(back ? shift + kSteps - k : shift + k) % kSteps]);
            if (sum <= most) continue;
            most = sum;
            best = shift;
        }
        const double from = static_cast<double>(best) / kSteps;
        return {low.edge, high.edge, from, back ? from - 1 : from + 1};
    }

    /// Closed edges that enclose about the same are one, and the plane is laid anew with them on each other.
    void pair_closed()
    {
        // Circles half of whose larger radius apart still overlap by more than half. A choice, not a
        // measurement.
        constexpr double kAlike = 0.5;
        const std::vector<Circle> low = circles(Role::source, inner_edges(base_, Role::source));
        const std::vector<Circle> high = circles(Role::target, inner_);
        std::set<std::size_t> used_low, used_high;
        for (;;) {
            double least = kAlike;
            std::optional<std::pair<std::size_t, std::size_t>> best;
            for (std::size_t i = 0; i < low.size(); ++i) {
                for (std::size_t j = 0; j < high.size(); ++j) {
                    if (used_low.contains(i) || used_high.contains(j) || unlike(low[i], high[j]) >= least)
                        continue;
                    least = unlike(low[i], high[j]);
                    best = {i, j};
                }
            }
            if (!best) break;
            used_low.insert(best->first);
            used_high.insert(best->second);
            closed_.push_back(turned(low[best->first], high[best->second]));
            EndsMap laid(base_, result_.links, closed_);
            if (laid.one_to_one())
                map_.emplace(std::move(laid));
            else
                closed_.pop_back();
        }
    }

    /// The inner edges of both ends with nodes at their vertices.
    void collect()
    {
        const Model& base = base_.model;
        std::map<VertexId, VertexId> partner;
        for (const RimPair& pair : pairs_) partner[pair.target] = pair.source;
        const auto uses = edge_uses(base);
        std::set<VertexId> on_rim;
        std::vector<EdgeId> source_inner;
        for (std::size_t e = 0; e < uses.size(); ++e) {
            if (uses[e].size() != 2) continue;
            const Role a = base_.role[uses[e][0].face.index()], b = base_.role[uses[e][1].face.index()];
            const bool seam = uses[e][0].face == uses[e][1].face;
            if (a == Role::source && b == Role::source && !seam) source_inner.emplace_back(e);
            if ((a == Role::source) != (b == Role::source)) {
                on_rim.insert({base.edges[e].from, base.edges[e].to});
                if (a == Role::source || b == Role::source) rim_edges_.emplace_back(e);
            }
        }
        const auto source_node = [&](VertexId vertex) {
            const auto [found, fresh] = node_of_.try_emplace(vertex, node_place_.size());
            if (fresh) {
                add_node(map_->source(base[vertex].point));
                node_vertex_.back() = vertex;
                if (!on_rim.contains(vertex)) loose_source_.push_back(found->second);
            }
            return found->second;
        };
        for (const EdgeId edge : rim_edges_) {
            source_node(base[edge].from);
            source_node(base[edge].to);
        }
        for (const EdgeId edge : source_inner) {
            FlatEdge flat = flat_edge(edge, false);
            flat.cuts = {{0, source_node(base[edge].from)}, {1, source_node(base[edge].to)}};
            source_.push_back(std::move(flat));
        }
        std::map<VertexId, std::size_t> target_node;
        const auto node_at = [&](VertexId vertex) {
            const auto paired = partner.find(vertex);
            if (paired != partner.end()) return source_node(paired->second);
            const auto [found, fresh] = target_node.try_emplace(vertex, node_place_.size());
            if (fresh) {
                add_node(map_->target(base[vertex].point));
                loose_target_.push_back(found->second);
            }
            return found->second;
        };
        for (const EdgeId edge : inner_) {
            const auto is_it = [&](const ClosedPair& pair) { return pair.target == edge; };
            if (std::any_of(closed_.begin(), closed_.end(), is_it)) continue;
            FlatEdge flat = flat_edge(edge, true);
            flat.cuts = {{0, node_at(base[edge].from)}, {1, node_at(base[edge].to)}};
            target_.push_back(std::move(flat));
        }
    }

    /// Put a node in another's place.
    void unite(std::size_t node, std::size_t with)
    {
        for (FlatEdge& edge : target_) {
            for (FlatEdge::Cut& cut : edge.cuts) cut.node = cut.node == node ? with : cut.node;
        }
    }

    static bool has_node(const FlatEdge& edge, std::size_t node)
    {
        return std::any_of(edge.cuts.begin(), edge.cuts.end(),
                           [&](const FlatEdge::Cut& cut) { return cut.node == node; });
    }

    /// The edge of a list closest to a node that is none of its own.
    std::optional<Closest> closest_edge(std::vector<FlatEdge>& edges, std::size_t node, FlatEdge** which)
    {
        std::optional<Closest> best;
        for (FlatEdge& edge : edges) {
            if (has_node(edge, node)) continue;
            const Closest found = closest_on(edge.line, edge.at, node_place_[node]);
            if (found.distance > reach(node_place_[node]) || (best && found.distance >= best->distance))
                continue;
            best = found;
            *which = &edge;
        }
        return best;
    }

    /// Whether a node is there only because a closed edge needs a vertex.
    static bool closes_edge(const std::vector<FlatEdge>& edges, std::size_t node)
    {
        std::size_t ends = 0;
        bool closed = false;
        for (const FlatEdge& edge : edges) {
            for (const FlatEdge::Cut& cut : edge.cuts) ends += cut.node == node ? 1 : 0;
            closed = closed || (edge.cuts.front().node == node && edge.cuts.back().node == node);
        }
        return closed && ends == 2;
    }

    /// Vertices of the target go to vertices or edges of the source that are near, and those of the source
    /// to edges of the target.
    void snap()
    {
        std::set<std::size_t> taken;
        for (const std::size_t node : loose_target_) {
            if (closes_edge(target_, node)) continue;
            std::optional<std::size_t> near;
            double least = reach(node_place_[node]);
            for (const std::size_t other : loose_source_) {
                const double off = (node_place_[node] - node_place_[other]).norm();
                if (taken.contains(other) || off > least || closes_edge(source_, other)) continue;
                least = off;
                near = other;
            }
            if (near) {
                taken.insert(*near);
                unite(node, *near);
                continue;
            }
            FlatEdge* edge = nullptr;
            if (const auto on = closest_edge(source_, node, &edge)) {
                node_place_[node] = on->place;
                edge->cuts.push_back({on->at, node});
            }
        }
        for (const std::size_t node : loose_source_) {
            if (taken.contains(node) || closes_edge(source_, node)) continue;
            FlatEdge* edge = nullptr;
            if (const auto on = closest_edge(target_, node, &edge)) edge->cuts.push_back({on->at, node});
        }
    }

    std::vector<Piece> pieces_of(std::vector<FlatEdge>& edges) const
    {
        std::vector<Piece> pieces;
        for (std::size_t e = 0; e < edges.size(); ++e) {
            FlatEdge& edge = edges[e];
            edge.sort();
            for (std::size_t c = 0; c + 1 < edge.cuts.size(); ++c) {
                const FlatEdge::Cut &a = edge.cuts[c], &b = edge.cuts[c + 1];
                Piece piece{e, a.at, b.at, a.node, b.node, {node_place_[a.node]}, {a.at}};
                for (std::size_t i = 0; i < edge.line.size(); ++i) {
                    if (edge.at[i] <= a.at + 1e-12 || edge.at[i] >= b.at - 1e-12) continue;
                    piece.line.push_back(edge.line[i]);
                    piece.at.push_back(edge.at[i]);
                }
                piece.line.push_back(node_place_[b.node]);
                piece.at.push_back(b.at);
                pieces.push_back(std::move(piece));
            }
        }
        return pieces;
    }

    /// Whether two pieces are one: the same nodes at their ends and near each other all the way.
    [[nodiscard]] bool are_one(const Piece& a, const Piece& b) const
    {
        const bool along = a.from == b.from && a.to == b.to, back = a.from == b.to && a.to == b.from;
        if (!along && !back) return false;
        const auto near = [&](const Piece& p, const Piece& q) {
            for (std::size_t i = 0; i + 1 < p.line.size(); ++i) {
                const Vec2 middle = (p.line[i] + p.line[i + 1]) / 2;
                for (const Vec2& x : {p.line[i], middle}) {
                    if (closest_on(q.line, q.at, x).distance > reach(x)) return false;
                }
            }
            return true;
        };
        return near(a, b) && near(b, a);
    }

    /// Nodes where inner edges of both ends cross.
    void cross()
    {
        const std::vector<Piece> low = pieces_of(source_), high = pieces_of(target_);
        for (const Piece& a : low) {
            for (const Piece& b : high) {
                if (are_one(a, b)) continue;
                for (std::size_t i = 0; i + 1 < a.line.size(); ++i) {
                    for (std::size_t j = 0; j + 1 < b.line.size(); ++j) {
                        const auto at = crossing(a.line[i], a.line[i + 1], b.line[j], b.line[j + 1]);
                        if (!at) continue;
                        const Vec2 place = a.line[i] + (*at)[0] * (a.line[i + 1] - a.line[i]);
                        const bool at_node = std::any_of(
                            node_place_.begin(), node_place_.end(), [&](const Vec2& node) {
                                return (node - place).norm() <= 1e-9 * base_.model.diagonal;
                            });
                        if (at_node) continue;
                        const std::size_t node = add_node(place);
                        source_[a.edge].cuts.push_back({a.at[i] + (*at)[0] * (a.at[i + 1] - a.at[i]), node});
                        target_[b.edge].cuts.push_back({b.at[j] + (*at)[1] * (b.at[j + 1] - b.at[j]), node});
                    }
                }
            }
        }
    }

    // --- the new model -------------------------------------------------------------------------------

    void set_place(Index point, const Vec2& place)
    {
        if (static_cast<std::size_t>(point) >= place_.size()) place_.resize(index(point) + 1, Vec2::Zero());
        place_[index(point)] = place;
    }

    /// Split the source's inner edges at their nodes; those that stand for the target's are noted.
    void cut_source()
    {
        for (std::size_t p = 0; p < base_.model.points.size(); ++p)
            set_place(static_cast<Index>(p), map_->source(static_cast<Index>(p)));
        const std::vector<Piece> low = pieces_of(source_);
        std::vector<EdgeId> part(low.size()); // edge of each piece
        for (std::size_t k = low.size(); k-- > 0;) {
            const Piece& piece = low[k];
            const EdgeId edge = source_[piece.edge].edge;
            part[k] = edge;
            if (k == 0 || low[k - 1].edge != piece.edge) continue;
            // The edge still runs from its start to this piece's end.
            try {
                const EdgeSplit made = split_edge(model(), edge, piece.from_at / piece.to_at);
                part[k] = made.behind;
                node_vertex_[piece.from] = made.vertex;
                const Index point = model()[made.vertex].point;
                if (index(point) < base_.model.points.size()) node_place_[piece.from] = place_[index(point)];
                set_place(point, node_place_[piece.from]);
            } catch (const InvalidInput& error) {
                refuse(model(), inner_.front(), error.what());
            }
        }
        for (std::size_t k = 0; k < low.size(); ++k) {
            borders_.push_back({part[k], {}});
            for (const ClosedPair& pair : closed_) {
                if (pair.source != source_[low[k].edge].edge) continue;
                const auto over = [&](double at) { return pair.from + at * (pair.to - pair.from); };
                borders_.back().image = EdgeImage{pair.target, over(low[k].from_at), over(low[k].to_at)};
            }
        }
        std::vector<Piece> high = pieces_of(target_);
        for (Piece& piece : high) {
            std::optional<std::size_t> same;
            for (std::size_t k = 0; k < low.size() && !same; ++k) {
                if (!borders_[k].image && are_one(low[k], piece)) same = k;
            }
            if (!same) {
                pieces_.push_back(std::move(piece));
                continue;
            }
            EdgeImage image{target_[piece.edge].edge, piece.from_at, piece.to_at};
            if (piece.from == low[*same].to && piece.to == low[*same].from) std::swap(image.from, image.to);
            borders_[*same].image = image;
        }
    }

    /// The target's edges that the source has not: new edges on its faces.
    void add_target()
    {
        for (const Piece& piece : pieces_) {
            const EdgeId target = target_[piece.edge].edge;
            const Vec2 middle = piece.line.size() > 2 ? piece.line[piece.line.size() / 2]
                                                      : Vec2((piece.line.front() + piece.line.back()) / 2);
            const FaceId face = map_->on_source(middle).face;
            split_.insert(face);
            const Edge edge = new_edge(piece, target, face);
            borders_.push_back({EdgeId(model().edges.size()), EdgeImage{target, piece.from_at, piece.to_at}});
            new_on_[borders_.back().source] = face;
            model().edges.push_back(edge);
        }
    }

    VertexId vertex_at(std::size_t node, FaceId face)
    {
        if (node_vertex_[node].valid()) return node_vertex_[node];
        Vertex vertex{add_point(face, node_place_[node]), 1, Origin::made_void};
        for (const Vertex& other : model().vertices) vertex.tag = std::max(vertex.tag, other.tag + 1);
        node_vertex_[node] = VertexId(model().vertices.size());
        model().vertices.push_back(vertex);
        return node_vertex_[node];
    }

    Index add_point(FaceId face, const Vec2& place)
    {
        const FacetPosition at[] = {map_->on_face(face, place).at};
        model().points.push_back(points_at(base_.model, face, at).front());
        set_place(static_cast<Index>(model().points.size()) - 1, place);
        return static_cast<Index>(model().points.size()) - 1;
    }

    Vec2 parameters(FaceId face, const Vec2& place) const
    {
        const FacetPosition at = map_->on_face(face, place).at;
        const std::array<Vec2, 3>& uv = base_.model[face].uv[static_cast<std::size_t>(at.triangle)];
        return at.barycentric[0] * uv[0] + at.barycentric[1] * uv[1] + at.barycentric[2] * uv[2];
    }

    /// The parameters of a place on the same side of a seam as those of a place nearby: over a seam they jump
    /// by all that the face has of them.
    Vec2 unwrapped(FaceId face, Vec2 uv, const Vec2& near)
    {
        const Vec2 range = seam_jump(face);
        for (int k = 0; k < 2; ++k) {
            if (range[k] > 0) uv[k] -= range[k] * std::round((uv[k] - near[k]) / range[k]);
        }
        return uv;
    }

    /// How far parameters jump over a face's seam; zero where it has none.
    Vec2 seam_jump(FaceId face)
    {
        const auto [found, fresh] = seam_jump_.try_emplace(face, Vec2::Zero());
        if (!fresh) return found->second;
        const Face& f = base_.model[face];
        std::set<EdgeId> once;
        bool seam = false;
        for (const Loop& loop : f.loops) {
            for (const EdgeUse& use : loop.uses) seam = !once.insert(use.edge).second || seam;
        }
        if (!seam) return found->second;
        Vec2 low = f.uv.front()[0], high = low;
        for (const auto& corners : f.uv) {
            for (const Vec2& c : corners) {
                low = low.cwiseMin(c);
                high = high.cwiseMax(c);
            }
        }
        return found->second = high - low;
    }

    /// A length that facets of a face have, in the plane.
    double facet_side(FaceId face) const
    {
        return std::sqrt(face_area(base_.model, face) /
                         static_cast<double>(base_.model[face].triangles.size()));
    }

    Edge new_edge(const Piece& piece, EdgeId target, FaceId face)
    {
        // Parameters at an end are those a little way in: on a seam it has others on either side.
        constexpr double kWayIn = 1e-6;
        const Face& on = base_.model[face];
        std::vector<Vec2> line{piece.line.front()};
        const double step = on.kind == "plane" ? std::numeric_limits<double>::infinity() : facet_side(face);
        for (std::size_t i = 0; i + 1 < piece.line.size(); ++i) {
            const Vec2 way = piece.line[i + 1] - piece.line[i];
            const int parts = std::max(1, static_cast<int>(std::ceil(way.norm() / step)));
            for (int k = 1; k <= parts; ++k) line.emplace_back(piece.line[i] + way * k / parts);
        }
        Edge edge = model()[target];
        edge.curve = nullptr;
        edge.params.clear();
        edge.from = vertex_at(piece.from, face);
        edge.to = vertex_at(piece.to, face);
        edge.points = {model()[edge.from].point};
        for (std::size_t i = 1; i + 1 < line.size(); ++i) edge.points.push_back(add_point(face, line[i]));
        edge.points.push_back(model()[edge.to].point);
        if (on.surface != nullptr) {
            std::vector<Vec3> points;
            std::vector<Vec2> uv;
            for (std::size_t i = 0; i < line.size(); ++i) {
                const Vec2& inward = line[i == 0 ? 1 : i + 1 == line.size() ? i - 1 : i];
                points.push_back(model().at(edge.points[i]));
                uv.push_back(parameters(face, line[i] + kWayIn * (inward - line[i])));
                if (i > 0) uv.back() = unwrapped(face, uv.back(), uv[i - 1]);
                edge.params.push_back(static_cast<double>(i));
            }
            edge.curve = std::make_shared<SurfaceCurve>(std::move(points), std::move(uv), on.surface);
        }
        return edge;
    }

    /// Chains of the plane: the inner edges, and the rim, beyond which there is nothing.
    void set_borders()
    {
        std::map<EdgeUse, FaceId> left;
        for (const FaceId face : result_.volume->faces(Role::source)) {
            for (const Loop& loop : model()[face].loops) {
                for (const EdgeUse& use : loop.uses) left[use] = face;
            }
        }
        for (const EdgeId edge : rim_edges_) borders_.push_back({edge, {}});
        for (const Border& border : borders_) {
            const Edge& edge = model()[border.source];
            PlaneChain chain{{}, edge.from.index(), edge.to.index()};
            for (const Index p : edge.points) chain.line.push_back(place_[index(p)]);
            if (!new_on_.contains(border.source)) {
                chain.left = left.contains({border.source, false});
                chain.right = left.contains({border.source, true});
            }
            chains_.push_back(std::move(chain));
        }
        source_left_ = std::move(left);
        for (const FaceId face : result_.volume->faces(Role::target)) {
            for (const Loop& loop : model()[face].loops) {
                for (const EdgeUse& use : loop.uses) target_left_[use] = face;
            }
        }
        for (const LinkingSurface& link : result_.links) {
            for (std::size_t u = 0; u < link.source.uses().size(); ++u) {
                const double middle = (link.source.start(u) + link.source.start(u + 1)) / 2;
                rim_target_[link.source.uses()[u].edge] = target_over(link, middle);
            }
        }
        for (const Border& border : borders_) {
            if (border.image) result_.images[border.source] = *border.image;
        }
    }

    /// The target face beside the rim above a place of the source's.
    FaceId target_over(const LinkingSurface& link, double source_at)
    {
        for (const RimSegment& segment : link.segments) {
            if (source_at > segment.source_to) continue;
            const double f = (source_at - segment.source_from) / (segment.source_to - segment.source_from);
            double at = segment.target_from + f * (segment.target_to - segment.target_from);
            if (at >= link.target.length()) at -= link.target.length();
            const EdgeUse use = link.target.uses()[link.target.position(at).use];
            return target_left_.at({use.edge, !use.reversed});
        }
        return {};
    }

    /// The target face over what lies on the left of a border; none for a border of the source alone.
    FaceId target_on_left(const PlaneUse& use)
    {
        const Border& border = borders_[use.chain];
        const auto rim = rim_target_.find(border.source);
        if (rim != rim_target_.end()) return rim->second;
        if (!border.image) return {};
        const bool along = border.image->from < border.image->to;
        // The target faces the other way: what is on the left here is on its edge's right.
        return target_left_.at({border.image->target, along != use.reversed});
    }

    FaceId source_on_left(const PlaneUse& use)
    {
        const Border& border = borders_[use.chain];
        const auto fresh = new_on_.find(border.source);
        if (fresh != new_on_.end()) return fresh->second;
        return source_left_.at({border.source, use.reversed});
    }

    void split_faces()
    {
        const std::vector<PlaneRegion> regions = plane_regions(chains_);
        std::vector<FaceId> source(regions.size()), target(regions.size());
        std::map<std::pair<std::size_t, bool>, std::size_t> region_of;
        for (std::size_t r = 0; r < regions.size(); ++r) {
            for (const auto& loop : regions[r].loops) {
                for (const PlaneUse& use : loop) {
                    region_of[{use.chain, use.reversed}] = r;
                    agree(source[r], source_on_left(use), use);
                    agree(target[r], target_on_left(use), use);
                }
            }
        }
        // Regions between edges of the source alone are swept where their neighbours are.
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t r = 0; r < regions.size(); ++r) {
                for (const auto& loop : regions[r].loops) {
                    for (const PlaneUse& use : loop) {
                        const auto other = region_of.find({use.chain, !use.reversed});
                        if (borders_[use.chain].image || other == region_of.end()) continue;
                        if (target[r].valid() || !target[other->second].valid()) continue;
                        target[r] = target[other->second];
                        changed = true;
                    }
                }
            }
        }
        std::set<FaceId> begun;
        result_.target_of.assign(model().faces.size(), {});
        for (std::size_t r = 0; r < regions.size(); ++r) {
            if (!target[r].valid() || !source[r].valid())
                refuse(model(), inner_.front(), "a part of the other end lies under no face of this one");
            FaceId face = source[r];
            if (!begun.insert(face).second) {
                if (!split_.contains(face)) // its loops are those of one region, or the plane is torn
                    refuse(model(), inner_.front(), "the edges of both ends cross each other in disorder");
                face = FaceId(model().faces.size());
                model().faces.push_back(base_.model[source[r]]);
                result_.volume->role.push_back(Role::source);
                result_.source_of.push_back(source[r]);
                result_.target_of.emplace_back();
            }
            result_.target_of[face.index()] = target[r];
            if (split_.contains(source[r])) make_facets(regions[r], source[r], face);
        }
    }

    void agree(FaceId& known, FaceId found, const PlaneUse& use)
    {
        if (!found.valid()) return;
        if (known.valid() && known != found) {
            const Border& border = borders_[use.chain];
            refuse(model(), border.image ? border.image->target : inner_.front(),
                   "there it crosses other edges in disorder");
        }
        known = found;
    }

    /// The facets of a region of source face `of`, as face `face`.
    void make_facets(const PlaneRegion& region, FaceId of, FaceId face)
    {
        std::vector<std::vector<Index>> loops;
        std::vector<Index> points;
        std::vector<Vec2> places;
        std::vector<Loop> uses;
        for (const auto& walk : region.loops) {
            std::vector<Index>& loop = loops.emplace_back();
            Loop& own = uses.emplace_back();
            for (const PlaneUse& use : walk) {
                own.uses.push_back({borders_[use.chain].source, use.reversed});
                const std::vector<Index> along = use_points(model(), own.uses.back());
                for (std::size_t i = 0; i + 1 < along.size(); ++i) {
                    loop.push_back(static_cast<Index>(points.size()));
                    points.push_back(along[i]);
                    places.push_back(place_[index(along[i])]);
                }
            }
        }
        const bool plane = base_.model[of].kind == "plane";
        geometry::TriangulateOptions options;
        options.interior_points = !plane;
        const double side = facet_side(of);
        options.size = [side](const Vec2&) { return side; };
        options.grading = 1;
        geometry::Triangulation made;
        try {
            made = geometry::triangulate(places, loops, options);
        } catch (const InvalidInput& error) {
            const Border& border = borders_[region.loops.front().front().chain];
            refuse(model(), border.image ? border.image->target : inner_.front(),
                   "what it cuts off on " + name_of(base_.model, of) + " has no outline of its own (" +
                       error.what() + ")");
        }
        for (std::size_t p = places.size(); p < made.points.size(); ++p)
            points.push_back(add_point(of, made.points[p]));
        std::vector<Triangle> triangles;
        std::vector<std::array<Vec2, 3>> uv;
        for (const Triangle& t : made.triangles) {
            triangles.push_back({points[index(t[0])], points[index(t[1])], points[index(t[2])]});
            if (base_.model[of].surface == nullptr) continue;
            const Vec2 centre =
                (made.points[index(t[0])] + made.points[index(t[1])] + made.points[index(t[2])]) / 3;
            std::array<Vec2, 3>& corners = uv.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec2& corner = made.points[index(t[k])];
                corners[k] = unwrapped(of, parameters(of, corner + 1e-6 * (centre - corner)),
                                       parameters(of, centre));
            }
        }
        Face& now = model()[face];
        now.triangles = std::move(triangles);
        now.uv = std::move(uv);
        now.loops = std::move(uses);
    }

    const SizeField& size_;
    std::span<const LinkingSurface> given_links_;
    std::span<const KnownLine> known_;
    std::vector<EdgeId> inner_;
    std::vector<RimPair> pairs_;
    Imprint result_;
    OpenVolume base_; ///< with the rims split, the faces whole
    std::optional<EndsMap> map_;
    std::vector<ClosedPair> closed_;
    std::vector<EdgeId> rim_edges_;
    std::vector<FlatEdge> source_, target_;
    std::vector<Vec2> node_place_;
    std::vector<VertexId> node_vertex_;
    std::map<VertexId, std::size_t> node_of_;
    std::vector<std::size_t> loose_source_, loose_target_; ///< nodes off the rim
    std::vector<Piece> pieces_;                            ///< of the target alone
    std::vector<Vec2> place_;                              ///< of each model point
    std::vector<Border> borders_;                          ///< the source's pieces, the target's, the rim
    std::vector<PlaneChain> chains_;                       ///< of each border
    std::map<EdgeId, FaceId> new_on_;                      ///< source face each new edge lies on
    std::map<FaceId, Vec2> seam_jump_;
    std::set<FaceId> split_; ///< source faces with new edges
    std::map<EdgeUse, FaceId> source_left_, target_left_;
    std::map<EdgeId, FaceId> rim_target_; ///< target face over each edge of the source's rim
};

} // namespace

std::vector<EdgeId> inner_edges(const OpenVolume& volume, Role role)
{
    std::vector<EdgeId> result;
    const auto uses = edge_uses(volume.model);
    for (std::size_t e = 0; e < uses.size(); ++e) {
        const bool inner = uses[e].size() == 2 && uses[e][0].face != uses[e][1].face &&
                           volume.role[uses[e][0].face.index()] == role &&
                           volume.role[uses[e][1].face.index()] == role;
        if (inner) result.emplace_back(e);
    }
    return result;
}

std::map<EdgeId, double> image_lengths(const Imprint& imprint)
{
    std::map<EdgeId, double> lengths;
    for (const auto& [edge, image] : imprint.images)
        lengths[edge] = std::abs(image.to - image.from) * edge_length(imprint.volume->model, image.target);
    return lengths;
}

Imprint imprint_target(const OpenVolume& volume, std::span<const LinkingSurface> links, const SizeField& size,
                       std::span<const KnownLine> known)
{
    return Imprinter(volume, links, size, known).run();
}

} // namespace lacuna::surface
