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
#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/surface/detail/alike_ends.h>
#include <lacuna/surface/detail/flat_ends.h>
#include <lacuna/surface/detail/imprint_rims.h>
#include <lacuna/surface/detail/imprint_rules.h>
#include <lacuna/surface/detail/plane_regions.h>
#include <lacuna/surface/detail/surface_curve.h>
#include <lacuna/topology/shared/split_edge.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

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
                    std::span<const KnownLine> known)
        : size_(size), given_links_(links), known_(known), inner_(inner_edges(volume, Role::target))
    {
        result_.volume = std::make_unique<OpenVolume>(volume);
        for (std::size_t f = 0; f < volume.model.faces.size(); ++f) result_.source_of.emplace_back(f);
    }

    Imprint run()
    {
        if (match_alike()) return std::move(result_);
        pairs_ = pair_rims(model(), given_links_, inner_, size_);
        result_.links = link_anew(*result_.volume, given_links_, pairs_);
        base_ = *result_.volume;
        map_.emplace(base_, result_.links, known_);
        if (!map_->one_to_one()) {
            refuse_imprint(model(), inner_.front(),
                           "source and target cannot be mapped onto each other one to one");
        }
        flat_ = lay_flat(base_, *map_, pairs_, inner_, reach_);
        cut_source();
        builder_.emplace(model());
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
        for (const FaceId face : split_) {
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
        for (std::size_t p = 0; p < base_.model.points.size(); ++p)
            set_place(static_cast<Index>(p), map_->source(static_cast<Index>(p)));
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

    /// Create edges on the source for those of the target that the source lacks.
    void add_target()
    {
        for (const FlatPiece& piece : pieces_) {
            const EdgeId target = flat_.target[piece.edge].edge;
            const Vec2 middle = piece.line.size() > 2 ? piece.line[piece.line.size() / 2]
                                                      : Vec2((piece.line.front() + piece.line.back()) / 2);
            const FaceId face = map_->on_source(middle).face;
            split_.insert(face);
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
            if (split_.contains(source[r])) make_facets(regions[r], source[r], face);
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

    /// Triangulate a region of the source face `of`, and give the triangles to the face `face`.
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
                const std::vector<Index> along = use_points(builder(), own.uses.back());
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
    std::set<FaceId> split_; ///< source faces with new edges
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
    return TargetImprinter(volume, links, size, known).run();
}

} // namespace lacuna::surface
