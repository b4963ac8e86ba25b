// SPDX-License-Identifier: MIT
//
// imprint_target() works in four steps. It pairs the rims: every inner edge of the target that ends on the
// rim gets a vertex on the source's rim. It maps both ends into one plane. There it intersects their inner
// edges. Finally it rebuilds the source faces from the regions between these edges.
#include <lacuna/surface/shared/imprint.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/surface/detail/alike_ends.h>
#include <lacuna/surface/detail/flat_ends.h>
#include <lacuna/surface/detail/imprint_rims.h>
#include <lacuna/surface/detail/imprint_rules.h>
#include <lacuna/surface/detail/plane_regions.h>
#include <lacuna/surface/detail/quad_path.h>
#include <lacuna/surface/detail/surface_curve.h>
#include <lacuna/topology/shared/section.h>
#include <lacuna/topology/shared/split_edge.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <ranges>
#include <set>
#include <unordered_map>
#include <unordered_set>

namespace lacuna::surface {

using namespace topology;

namespace {

/// A chain in the plane: the edge of the source that it represents, and its image on the target.
struct Border {
    EdgeId source; ///< edge of the new model
    std::optional<EdgeImage> image;
};

class TargetImprinter {
public:
    TargetImprinter(const OpenVolume& volume, std::span<const LinkingSurface> links, const SizeField& size,
                    std::span<const KnownLine> known, ImprintedLines lines)
        : size_(size), given_links_(links), known_(known), inner_(inner_edges(volume, Role::target))
    {
        if (lines == ImprintedLines::open)
            for (const EdgeUse& use : closed_lines(volume, Role::target, inner_) | std::views::join)
                std::erase(inner_, use.edge);
        result_.volume = std::make_unique<OpenVolume>(volume);
        for (std::size_t f = 0; f < volume.model.faces.size(); ++f) result_.source_of.emplace_back(f);
    }

    Imprint run()
    {
        if (inner_.empty() || match_alike()) return std::move(result_);
        pairs_ = pair_rims(model(), given_links_, inner_, size_);
        result_.links = link_anew(*result_.volume, given_links_, pairs_);
        base_ = *result_.volume;
        map_.emplace(base_, result_.links, known_);
        if (!map_->one_to_one()) {
            refuse_imprint(model(), inner_.front(),
                           "source and target cannot be mapped onto each other one to one");
        }
        find_paths();
        flat_ = lay_flat(base_, *map_, pairs_, left_, reach_);
        cut_at_paths();
        cut_source();
        builder_.emplace(model());
        add_paths();
        add_target();
        check_not_kept();
        set_borders();
        check_sizes();
        split_faces();
        model() = std::move(builder()).finish();
        for (LinkingSurface& link : result_.links) link.map.reset(); // the maps refer to the old model
        return std::move(result_);
    }

private:
    Model& model() { return result_.volume->model; }
    ModelBuilder& builder() { return *builder_; }

    /// If both ends are split in the same way, map edges to edges. The common plane is then not needed.
    bool match_alike()
    {
        std::optional<AlikeEnds> alike = alike_ends(*result_.volume, given_links_);
        if (!alike) return false;
        pairs_ = std::move(alike->pairs);
        result_.links = link_anew(*result_.volume, given_links_, pairs_);
        result_.target_of.resize(model().faces.size());
        for (const auto& [low, high] : alike->faces) result_.target_of[low.index()] = high;
        for (const auto& [low, high] : alike->edges) {
            // The target's loops run in the opposite direction, so its edges are traversed backwards.
            const bool along = low.reversed != high.reversed;
            result_.images[low.edge] = {high.edge, along ? 0.0 : 1.0, along ? 1.0 : 0.0};
        }
        return true;
    }

    /// Refuse an edge whose image on the other end is far shorter than the edge. Example: the edge around the
    /// floor of a long tube inside one end.
    void check_sizes() const
    {
        for (const auto& [edge, image] : result_.images) {
            const Model& model = *builder_;
            const double swept = std::abs(image.to - image.from) * edge_length(model, image.target);
            const double shrunk = swept / edge_length(model, edge);
            if (shrunk <= kMostShrunk) continue;
            throw NotSweepable(
                Message(
                    "surface.not_imprinted",
                    "{} lies so far from the rim of one end that its imprint on the other would be {:.2g} "
                    "times smaller",
                    entity_of(model, image.target), found(shrunk))
                    .remedy("choose other faces as source and target"));
        }
    }

    /// Refuse to split a face whose given quads are kept.
    void check_not_kept()
    {
        for (const FaceId face : not_followed_) {
            if (base_.model[face].given_quads.empty()) continue;
            // Quads on a cut are those of the piece beside it.
            const bool is_cut = base_.model[face].origin == Origin::made_void;
            throw NotSweepable(Message("surface.not_imprinted",
                                       "{} lies inside one end and cannot be imprinted on the other: {} "
                                       "keeps {} and cannot be split",
                                       entity_of(base_.model, inner_.front()), entity_of(base_.model, face),
                                       is_cut ? "the quads of the piece beside it" : "its given quads")
                                   .remedy("{}, or choose a target that is a single face",
                                           is_cut ? "cut the volume otherwise, give another 'size'"
                                                  : "load with keep_mesh = false"));
        }
    }

    // --- the new model -------------------------------------------------------------------------------

    void set_place(Index point, const Vec2& place)
    {
        if (static_cast<std::size_t>(point) >= place_.size()) place_.resize(index(point) + 1, Vec2::Zero());
        place_[index(point)] = place;
    }

    /// Split the source's inner edges at their nodes. Record the pieces that coincide with edges of the
    /// target.
    void cut_source()
    {
        const std::vector<FlatPiece> low = pieces_of(flat_.source, flat_.place);
        std::vector<EdgeId> part(low.size()); // edge of each piece
        for (std::size_t k = low.size(); k-- > 0;) {
            const FlatPiece& piece = low[k];
            const EdgeId edge = flat_.source[piece.edge].edge;
            part[k] = edge;
            if (k == 0 || low[k - 1].edge != piece.edge) continue;
            // Pieces are split off from the last to the first. The edge that remains therefore always ends
            // where the current piece ends.
            const EdgeSplit made = split_at(model(), edge, piece.from_at / piece.to_at, inner_.front());
            part[k] = made.behind;
            flat_.vertex[piece.from] = made.vertex;
            const Index point = model()[made.vertex].point;
            if (index(point) < base_.model.points.size()) flat_.place[piece.from] = place_[index(point)];
            set_place(point, flat_.place[piece.from]);
        }
        for (const EdgeId edge : part) borders_.push_back({edge, {}});
        std::vector<FlatPiece> high = pieces_of(flat_.target, flat_.place);
        for (FlatPiece& piece : high) {
            std::optional<std::size_t> same;
            for (std::size_t k = 0; k < low.size() && !same; ++k) {
                if (!borders_[k].image && are_one(low[k], piece, reach_)) same = k;
            }
            if (!same) {
                pieces_.push_back(std::move(piece));
                continue;
            }
            EdgeImage image{flat_.target[piece.edge].edge, piece.from_at, piece.to_at};
            if (piece.from == low[*same].to && piece.to == low[*same].from) std::swap(image.from, image.to);
            borders_[*same].image = image;
        }
    }

    /// Find sides of kept quads that represent closed lines of the target.
    void find_paths()
    {
        for (std::size_t p = 0; p < base_.model.points.size(); ++p)
            set_place(static_cast<Index>(p), map_->source(static_cast<Index>(p)));
        left_ = inner_;
        std::vector<Quad> quads;
        for (const FaceId face : base_.faces(Role::source)) {
            const Face& own = base_.model[face];
            if (own.keeps_nodes && has_quads_all_over(own))
                quads.insert(quads.end(), own.given_quads.begin(), own.given_quads.end());
        }
        if (quads.empty()) return;
        std::vector<FlatEdge> own;
        for (const EdgeId edge : inner_edges(base_, Role::source))
            own.push_back(flat_edge(base_.model, *map_, edge, false));
        const auto is_on_source = [&](const EdgeUse& use) {
            return std::ranges::all_of(flat_edge(base_.model, *map_, use.edge, true).line,
                                       [&](const Vec2& p) {
                                           return std::ranges::any_of(own, [&](const FlatEdge& edge) {
                                               return closest_on(edge.line, edge.at, p).distance <= reach_(p);
                                           });
                                       });
        };
        std::unordered_set<Index> taken;
        for (const std::vector<EdgeUse>& line : closed_lines(base_, Role::target, inner_)) {
            if (std::ranges::all_of(line, is_on_source)) continue; // both ends have the line
            std::vector<PathSide> path = path_along(base_.model, *map_, quads, place_, line, taken);
            if (path.empty()) continue;
            for (const EdgeUse& use : line) std::erase(left_, use.edge);
            for (const PathSide& side : path) taken.insert(side.from);
            path_.insert(path_.end(), path.begin(), path.end());
        }
        result_.follows_quads = !path_.empty();
    }

    /// Cut the source's inner edges where paths cross them or run along them.
    void cut_at_paths()
    {
        std::unordered_set<Index> on_path;
        for (const PathSide& side : path_) on_path.insert(side.from);
        for (FlatEdge& edge : flat_.source) {
            const std::vector<Index>& points = base_.model[edge.edge].points;
            for (std::size_t i = 1; i + 1 < points.size(); ++i) {
                if (!on_path.contains(points[i])) continue;
                edge.cuts.push_back({edge.at[i], flat_.place.size()});
                flat_.place.push_back(place_[index(points[i])]);
                flat_.vertex.emplace_back();
            }
        }
    }

    /// Make the sides of the paths edges of the source, and give them their images.
    void add_paths()
    {
        std::unordered_map<std::uint64_t, std::size_t> border_on; // borders so far that are one side
        for (std::size_t k = 0; k < borders_.size(); ++k)
            if (const std::vector<Index>& points = builder()[borders_[k].source].points; points.size() == 2)
                border_on[edge_key(points[0], points[1])] = k;
        std::unordered_map<Index, VertexId> vertex_at;
        for (std::size_t v = 0; v < builder().vertices.size(); ++v)
            vertex_at[builder().vertices[v].point] = VertexId(v);
        for (const PathSide& side : path_)
            if (!vertex_at.contains(side.from)) vertex_at[side.from] = builder().add_void_vertex(side.from);
        std::unordered_map<std::uint64_t, FaceId> face_on; // by its sides
        for (const FaceId face : base_.faces(Role::source))
            for (const Quad& quad : base_.model[face].given_quads)
                for (std::size_t k = 0; k < 4; ++k) face_on[directed_key(quad[k], quad[(k + 1) % 4])] = face;
        for (const PathSide& side : path_) {
            if (const auto known = border_on.find(edge_key(side.from, side.to)); known != border_on.end()) {
                Border& border = borders_[known->second];
                border.image = side.image;
                if (builder()[border.source].points.front() != side.from)
                    std::swap(border.image->from, border.image->to);
                continue;
            }
            const EdgeId edge = builder().add_void_edge(vertex_at[side.from], vertex_at[side.to],
                                                        {side.from, side.to});
            builder()[edge].tag = base_.model[side.image.target].tag;
            builder()[edge].keeps_nodes = true;
            borders_.push_back({edge, side.image});
            new_on_[edge] = face_on.at(directed_key(side.from, side.to));
            split_.insert(new_on_[edge]);
            on_quads_.insert(edge_key(side.from, side.to));
        }
    }

    /// Create edges on the source for those of the target that the source lacks.
    void add_target()
    {
        for (const FlatPiece& piece : pieces_) {
            const EdgeId target = flat_.target[piece.edge].edge;
            const Vec2 middle = piece.line.size() > 2 ? piece.line[piece.line.size() / 2]
                                                      : Vec2((piece.line.front() + piece.line.back()) / 2);
            const FaceId face = map_->on_source(middle).face;
            split_.insert(face);
            not_followed_.insert(face);
            const Edge edge = new_edge(piece, target, face);
            borders_.push_back(
                {EdgeId(builder().edges.size()), EdgeImage{target, piece.from_at, piece.to_at}});
            new_on_[borders_.back().source] = face;
            builder().edges.push_back(edge);
        }
    }

    VertexId vertex_at(std::size_t node, FaceId face)
    {
        if (flat_.vertex[node].valid()) return flat_.vertex[node];
        Vertex vertex{add_point(face, flat_.place[node]), 1, Origin::made_void};
        for (const Vertex& other : builder().vertices) vertex.tag = std::max(vertex.tag, other.tag + 1);
        flat_.vertex[node] = VertexId(builder().vertices.size());
        builder().vertices.push_back(vertex);
        return flat_.vertex[node];
    }

    Index add_point(FaceId face, const Vec2& place)
    {
        const auto point = static_cast<Index>(builder().points.size());
        builder().points.push_back(
            points_at(base_.model, face, std::array{map_->on_face(face, place)}).front());
        set_place(point, place);
        return point;
    }

    Vec2 parameters(FaceId face, const Vec2& place) const
    {
        const FacetPosition at = map_->on_face(face, place);
        const std::array<Vec2, 3>& uv = base_.model[face].uv[static_cast<std::size_t>(at.triangle)];
        return at.barycentric[0] * uv[0] + at.barycentric[1] * uv[1] + at.barycentric[2] * uv[2];
    }

    /// Surface parameters shifted by the period of the face's seam, if that brings them closer to `near`.
    Vec2 unwrapped(FaceId face, Vec2 uv, const Vec2& near)
    {
        const Vec2 range = seam_jump(face);
        for (int k = 0; k < 2; ++k) {
            if (range[k] > 0) uv[k] -= range[k] * std::round((uv[k] - near[k]) / range[k]);
        }
        return uv;
    }

    /// The jump of the surface parameters across a face's seam; zero if the face has no seam.
    Vec2 seam_jump(FaceId face)
    {
        const auto [found, fresh] = seam_jump_.try_emplace(face, Vec2::Zero());
        if (!fresh) return found->second;
        const Face& f = base_.model[face];
        std::set<EdgeId> once;
        bool seam = false;
        for (const EdgeUse& use : uses_of(f)) seam = !once.insert(use.edge).second || seam;
        if (!seam) return found->second;
        Eigen::AlignedBox2d box;
        for (const auto& corners : f.uv) {
            for (const Vec2& c : corners) box.extend(c);
        }
        return found->second = box.sizes();
    }

    /// Mean side length of the facets of a face.
    double facet_side(FaceId face) const
    {
        return std::sqrt(face_area(base_.model, face) /
                         static_cast<double>(base_.model[face].triangles.size()));
    }

    Edge new_edge(const FlatPiece& piece, EdgeId target, FaceId face)
    {
        // A point on a seam has two sets of parameters. At the ends of the edge, take the parameters of a
        // point slightly inside the edge instead.
        const Face& on = base_.model[face];
        std::vector<Vec2> line{piece.line.front()};
        const double step = on.kind == "plane" ? kInfinity : facet_side(face);
        for (std::size_t i = 0; i + 1 < piece.line.size(); ++i) {
            const Vec2 way = piece.line[i + 1] - piece.line[i];
            const int parts = std::max(1, static_cast<int>(std::ceil(way.norm() / step)));
            for (int k = 1; k <= parts; ++k) line.emplace_back(piece.line[i] + way * k / parts);
        }
        Edge edge = builder()[target];
        edge.curve = nullptr;
        edge.params.clear();
        edge.from = vertex_at(piece.from, face);
        edge.to = vertex_at(piece.to, face);
        edge.points = {builder()[edge.from].point};
        for (std::size_t i = 1; i + 1 < line.size(); ++i) edge.points.push_back(add_point(face, line[i]));
        edge.points.push_back(builder()[edge.to].point);
        if (on.surface != nullptr) {
            std::vector<Vec3> points;
            std::vector<Vec2> uv;
            for (std::size_t i = 0; i < line.size(); ++i) {
                const Vec2& inward = line[i == 0 ? 1 : i + 1 == line.size() ? i - 1 : i];
                points.push_back(builder().at(edge.points[i]));
                uv.push_back(parameters(face, line[i] + kFileAccuracy * (inward - line[i])));
                if (i > 0) uv.back() = unwrapped(face, uv.back(), uv[i - 1]);
                edge.params.push_back(static_cast<double>(i));
            }
            edge.curve = std::make_shared<SurfaceCurve>(std::move(points), std::move(uv), on.surface);
        }
        return edge;
    }

    /// For each edge use of the faces of one role, the face to its left.
    std::map<EdgeUse, FaceId> faces_on_left(Role role)
    {
        std::map<EdgeUse, FaceId> left;
        for (const FaceId face : result_.volume->faces(role)) {
            for (const EdgeUse& use : uses_of(builder()[face])) left[use] = face;
        }
        return left;
    }

    /// Collect the chains that divide the plane: the inner edges, and the rim as its border.
    void set_borders()
    {
        source_left_ = faces_on_left(Role::source);
        target_left_ = faces_on_left(Role::target);
        for (const EdgeId edge : flat_.rim) borders_.push_back({edge, {}});
        for (const Border& border : borders_) {
            const Edge& edge = builder()[border.source];
            PlaneChain chain{{}, edge.from.index(), edge.to.index()};
            for (const Index p : edge.points) chain.line.push_back(place_[index(p)]);
            if (!new_on_.contains(border.source)) {
                chain.left = source_left_.contains({border.source, false});
                chain.right = source_left_.contains({border.source, true});
            }
            chains_.push_back(std::move(chain));
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

    /// The target face at the target's rim, opposite to a position of the source's rim.
    FaceId target_over(const LinkingSurface& link, double source_at)
    {
        for (const RimSegment& segment : link.segments) {
            if (source_at > segment.source_to) continue;
            const double f = (source_at - segment.source_from) / (segment.source_to - segment.source_from);
            const double at = segment.target_from + f * (segment.target_to - segment.target_from);
            return target_left_.at(
                opposite(link.target.uses()[link.target.position(link.target.wrapped(at)).use]));
        }
        return {};
    }

    /// The target face to the left of a border. Invalid if the border exists only on the source.
    FaceId target_on_left(const PlaneUse& use)
    {
        const Border& border = borders_[use.chain];
        const auto rim = rim_target_.find(border.source);
        if (rim != rim_target_.end()) return rim->second;
        if (!border.image) return {};
        const bool along = border.image->from < border.image->to;
        // The target's loops have the opposite direction, so the left and right of an edge are exchanged.
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
        // A region whose borders are all edges of the source alone lies inside a target face. Take the target
        // face of a neighbouring region.
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
        result_.target_of.assign(builder().faces.size(), {});
        for (std::size_t r = 0; r < regions.size(); ++r) {
            if (!target[r].valid() || !source[r].valid())
                refuse_imprint(builder(), inner_.front(),
                               "a part of the other end has no counterpart on this one");
            FaceId face = source[r];
            if (!begun.insert(face).second) {
                if (!split_.contains(face)) // an unsplit face is one region
                    refuse_imprint(builder(), inner_.front(), "the edges of both ends cross inconsistently");
                face = FaceId(builder().faces.size());
                builder().faces.push_back(base_.model[source[r]]);
                result_.volume->role.push_back(Role::source);
                result_.source_of.push_back(source[r]);
                result_.target_of.emplace_back();
            }
            result_.target_of[face.index()] = target[r];
            if (!split_.contains(source[r])) continue;
            if (base_.model[source[r]].given_quads.empty())
                make_facets(regions[r], source[r], face);
            else
                take_quads(regions[r], source[r], face);
        }
    }

    void agree(FaceId& known, FaceId found, const PlaneUse& use)
    {
        if (!found.valid()) return;
        if (known.valid() && known != found) {
            const Border& border = borders_[use.chain];
            refuse_imprint(builder(), border.image ? border.image->target : inner_.front(),
                           "there it crosses other edges inconsistently");
        }
        known = found;
    }

    std::vector<Loop> loops_of(const PlaneRegion& region) const
    {
        std::vector<Loop> loops;
        for (const auto& walk : region.loops) {
            Loop& loop = loops.emplace_back();
            for (const PlaneUse& use : walk) loop.uses.push_back({borders_[use.chain].source, use.reversed});
        }
        return loops;
    }

    /// Give the quads of the source face `of` inside a region to the face `face`.
    void take_quads(const PlaneRegion& region, FaceId of, FaceId face)
    {
        std::vector<Loop> loops = loops_of(region);
        const std::vector<Index> rim = loop_points(builder(), loops.front().uses);
        const std::uint64_t inside = directed_key(rim[0], rim[1]);
        std::vector<Face>& parts = parts_[of];
        if (parts.empty()) parts = parts_along(base_.model[of], on_quads_, base_.model.points.size());
        for (Face& part : parts) {
            const bool here = std::ranges::any_of(part.triangles, [&](const Triangle& t) {
                return inside == directed_key(t[0], t[1]) || inside == directed_key(t[1], t[2]) ||
                       inside == directed_key(t[2], t[0]);
            });
            if (!here) continue;
            part.loops = std::move(loops);
            builder()[face] = std::move(part);
            return;
        }
    }

    /// Triangulate a region of the source face `of`, and give the triangles to the face `face`.
    void make_facets(const PlaneRegion& region, FaceId of, FaceId face)
    {
        std::vector<std::vector<Index>> loops;
        std::vector<Index> points;
        std::vector<Vec2> places;
        std::vector<Loop> uses = loops_of(region);
        for (const Loop& own : uses) {
            std::vector<Index>& loop = loops.emplace_back();
            for (const Index p : loop_points(builder(), own.uses)) {
                loop.push_back(static_cast<Index>(points.size()));
                points.push_back(p);
                places.push_back(place_[index(p)]);
            }
        }
        const bool plane = base_.model[of].kind == "plane";
        geometry::TriangulateOptions options;
        options.interior_points = !plane;
        const double side = facet_side(of);
        options.size = [side](const Vec2&) { return side; };
        options.grading = 1;
        auto outcome = attempt<InvalidInput>([&] { return geometry::triangulate(places, loops, options); });
        if (!outcome) {
            const Border& border = borders_[region.loops.front().front().chain];
            const EdgeId edge = border.image ? border.image->target : inner_.front();
            throw NotSweepable(
                Message("surface.not_imprinted",
                        "{} lies inside one end and cannot be imprinted on the other: the part "
                        "that its imprint cuts off on {} has no valid outline",
                        entity_of(builder(), edge), entity_of(base_.model, of))
                    .remedy("choose other faces as source and target")
                    .attempt(*outcome.why));
        }
        const geometry::Triangulation& made = *outcome;
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
        Face& now = builder()[face];
        now.triangles = std::move(triangles);
        now.uv = std::move(uv);
        now.loops = std::move(uses);
    }

    const SizeField& size_;
    Reach reach_ = [this](const Vec2& place) { return kOneEdge * size_(map_->on_source(place).point); };
    std::span<const LinkingSurface> given_links_;
    std::span<const KnownLine> known_;
    std::vector<EdgeId> inner_;
    std::vector<EdgeId> left_;   ///< those that are not represented by `path_`
    std::vector<PathSide> path_; ///< sides of kept quads that represent closed lines of the target
    std::vector<RimPair> pairs_;
    Imprint result_;
    std::optional<ModelBuilder> builder_; ///< builder of `result_.volume->model` while rims are split
    OpenVolume base_;                     ///< the volume after its rims are split, before its faces are split
    std::optional<EndsMap> map_;
    FlatEnds flat_;
    std::vector<FlatPiece> pieces_;   ///< pieces that exist only on the target
    std::vector<Vec2> place_;         ///< plane position of each model point
    std::vector<Border> borders_;     ///< pieces of the source, of the target and of the rim
    std::vector<PlaneChain> chains_;  ///< chain of each border
    std::map<EdgeId, FaceId> new_on_; ///< for each new edge, the source face that it lies on
    std::map<FaceId, Vec2> seam_jump_;
    std::set<FaceId> split_;        ///< source faces with new edges
    std::set<FaceId> not_followed_; ///< those with new edges that do not run along sides of kept quads
    std::unordered_set<std::uint64_t> on_quads_; ///< keys of the sides of kept quads that became edges
    std::map<FaceId, std::vector<Face>> parts_;  ///< parts of faces with kept quads between these sides
    std::map<EdgeUse, FaceId> source_left_, target_left_;
    std::map<EdgeId, FaceId> rim_target_; ///< target face over each edge of the source's rim
};

} // namespace

void refuse_imprint(const Model& model, EdgeId edge, const char* why)
{
    throw NotSweepable(Message("surface.not_imprinted",
                               "{} lies inside one end and cannot be imprinted on the other: {}",
                               entity_of(model, edge), why)
                           .remedy("choose other faces as source and target"));
}

std::vector<EdgeId> inner_edges(const OpenVolume& volume, Role role)
{
    std::vector<EdgeId> result;
    for (std::size_t e = 0; e < volume.model.edges.size(); ++e) {
        const std::span<const FaceUse> uses = volume.model.uses_of_edge(EdgeId(e));
        const bool inner = uses.size() == 2 && uses[0].face != uses[1].face &&
                           volume.role[uses[0].face.index()] == role &&
                           volume.role[uses[1].face.index()] == role;
        if (inner) result.emplace_back(e);
    }
    return result;
}

std::vector<std::vector<EdgeUse>> closed_lines(const OpenVolume& volume, Role end,
                                               std::span<const EdgeId> inner)
{
    const Model& model = volume.model;
    std::map<VertexId, std::vector<EdgeUse>> from; // uses that leave each vertex
    for (const EdgeId edge : inner) {
        from[model[edge].from].push_back({edge, false});
        from[model[edge].to].push_back({edge, true});
    }
    std::set<VertexId> ends; // vertices at which no line goes on
    for (const Rim& rim : rims(model, volume.faces(end)))
        for (const EdgeUse& use : rim.uses) ends.insert(use_from(model, use));
    for (const auto& [vertex, uses] : from)
        if (uses.size() != 2) ends.insert(vertex);
    std::set<EdgeId> done;
    std::vector<std::vector<EdgeUse>> lines;
    for (const EdgeId first : inner) {
        if (done.contains(first)) continue;
        std::vector<EdgeUse> line{{first, false}};
        const VertexId start = model[first].from;
        bool open = ends.contains(start);
        for (VertexId at = model[first].to; at != start && !open; at = use_to(model, line.back())) {
            open = ends.contains(at);
            const std::vector<EdgeUse>& on = from.at(at);
            if (!open) line.push_back(on[on[0].edge == line.back().edge ? 1 : 0]);
        }
        for (const EdgeUse& use : line) done.insert(use.edge);
        if (!open) lines.push_back(std::move(line));
    }
    return lines;
}

std::map<EdgeId, double> image_lengths(const Imprint& imprint)
{
    std::map<EdgeId, double> lengths;
    for (const auto& [edge, image] : imprint.images)
        lengths[edge] = std::abs(image.to - image.from) * edge_length(imprint.volume->model, image.target);
    return lengths;
}

Imprint imprint_target(const OpenVolume& volume, std::span<const LinkingSurface> links, const SizeField& size,
                       std::span<const KnownLine> known, ImprintedLines lines)
{
    return TargetImprinter(volume, links, size, known, lines).run();
}

} // namespace lacuna::surface
