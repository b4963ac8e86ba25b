// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/middle_skin.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/surface/shared/projector.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// A side of the skin, and the patches of the two quads adjacent to it.
struct SkinSide {
    std::size_t place = 0; ///< index of its middle node
    Index from = 0, to = 0;
    Index patch = -1, other = -1;
};

std::vector<SkinSide> skin_sides(const mesh::HexMesh& mesh)
{
    std::vector<SkinSide> all;
    all.reserve(4 * mesh.skin_count());
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::CellNodes nodes = mesh::skin_nodes(mesh, i);
        const Index patch = mesh::skin_quad(mesh, i).patch;
        for (std::size_t k = 0; k < 4; ++k) {
            const Index a = nodes.node[k], b = nodes.node[(k + 1) % 4];
            all.push_back({index(nodes.node[4 + k]) - corner_count(mesh), std::min(a, b), std::max(a, b),
                           patch, patch});
        }
    }
    std::ranges::stable_sort(all, {}, &SkinSide::place);
    std::vector<SkinSide> sides;
    sides.reserve(all.size() / 2);
    for (const SkinSide& side : all) {
        if (!sides.empty() && sides.back().place == side.place)
            sides.back().other = side.patch;
        else
            sides.push_back(side);
    }
    return sides;
}

/// The edges of a model as curves, for finding positions on them.
class EdgeFinder {
public:
    explicit EdgeFinder(const Model& model) : model_(model)
    {
        for (std::size_t e = 0; e < model.edges.size(); ++e) {
            const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
            if (uses.size() != 2) continue;
            const FaceId a = uses[0].face, b = uses[1].face;
            if (a != b) between_[std::minmax(a, b)].push_back(EdgeId(static_cast<Index>(e)));
        }
    }

    struct Place {
        EdgeId edge;
        double fraction = 0; ///< share of its length
    };
    /// The position halfway between two points on the edges between two faces; empty if there is no such
    /// edge, or if the side does not lie on it.
    std::optional<Place> half_way(FaceId one, FaceId other, const Vec3& from, const Vec3& to)
    {
        const auto found = between_.find(std::minmax(one, other));
        if (found == between_.end()) return std::nullopt;
        const double length = (to - from).norm();
        // One tree of all edges between the two faces finds the edge.
        const Curve& all = curve_of(found->second);
        const geometry::FacetTree::Hit hit = all.tree.closest((from + to) / 2);
        if (hit.triangle < 0) return std::nullopt;
        const EdgeId edge = all.edge[index(hit.triangle)];
        const Curve& curve = curve_of({edge});
        const double whole = curve.arc.back();
        const auto [a, off_a] = position(curve, from);
        auto [b, off_b] = position(curve, to);
        if (!(off_a < kNear * length && off_b < kNear * length && whole > 0)) return std::nullopt;
        const Edge& e = model_[edge];
        const bool closed = e.points.front() == e.points.back();
        if (closed && std::abs(b - a) > whole / 2) b += b < a ? whole : -whole;
        double middle = (a + b) / 2;
        if (middle < 0) middle += whole;
        if (middle > whole) middle -= whole;
        return Place{edge, middle / whole};
    }

private:
    /// Nodes of an edge lie on it, and deviate from its chords by no more than their sag.
    static constexpr double kNear = 0.1;

    struct Curve {
        geometry::FacetTree tree;
        std::vector<EdgeId> edge; ///< for each side
        std::vector<double> arc;  ///< of the edge's start, for each edge
    };

    Curve& curve_of(const std::vector<EdgeId>& edges)
    {
        const auto [at, fresh] = curves_.try_emplace(edges);
        Curve& curve = at->second;
        if (!fresh) return curve;
        std::vector<Triangle> thin;
        for (const EdgeId edge : edges) {
            const std::vector<Index>& points = model_[edge].points;
            for (std::size_t i = 0; i + 1 < points.size(); ++i)
                thin.push_back({points[i], points[i + 1], points[i + 1]});
            curve.edge.resize(thin.size(), edge);
        }
        curve.tree = geometry::FacetTree(model_.points, thin);
        curve.arc = geometry::arc_lengths(surface::edge_line(model_, edges.front()));
        return curve;
    }
    /// Running length of the closest point, and its distance.
    static std::pair<double, double> position(const Curve& curve, const Vec3& point)
    {
        const geometry::FacetTree::Hit hit = curve.tree.closest(point);
        const std::size_t i = index(hit.triangle);
        const double share = 1 - hit.barycentric[0];
        return {(1 - share) * curve.arc[i] + share * curve.arc[i + 1], std::sqrt(hit.distance2)};
    }

    const Model& model_;
    std::map<std::pair<FaceId, FaceId>, std::vector<EdgeId>> between_;
    std::map<std::vector<EdgeId>, Curve> curves_;
};

/// Whether the given quads of a face are those of the skin.
bool keeps_quads(const Face& face) { return face.keeps_nodes && !face.given_quads.empty(); }

class SkinPlacer {
public:
    SkinPlacer(const OpenVolume& volume, const mesh::SkinNodes& corners, const std::vector<FaceId>& faces,
               const SecondOrderOptions& options, const RunContext& context)
        : model_(volume.model), corners_(corners), faces_(faces), options_(options), context_(context)
    {
    }

    PlacedSkin place()
    {
        for (const SkinSide& side : sides_) middle(side) = straight(side);
        take_given();
        place_on_edges();
        keep_straight();
        const LevelBlend blend(mesh_);
        for (const int level : {0, mesh_.layers}) blend_end(level, blend);
        project(true);
        blend_rows();
        bend_columns();
        project(false);
        for (const SkinSide& side : sides_)
            if (skin_.state(side.place) == Middle::open) skin_.set(side.place, Middle::loose);
        if (mesh_.middles.full) place_centres();
        return {std::move(skin_), counts_};
    }

private:
    [[nodiscard]] FaceId face(Index patch) const { return faces_[index(patch)]; }
    [[nodiscard]] Vec3& middle(const SkinSide& side) { return skin_.node(side.place); }
    [[nodiscard]] Vec3 straight(const SkinSide& side) const
    {
        return (corners_[side.from] + corners_[side.to]) / 2;
    }
    [[nodiscard]] double length(const SkinSide& side) const
    {
        return (corners_[side.to] - corners_[side.from]).norm();
    }
    /// If a position differs from the straight side's midpoint by rounding only, the side is exactly
    /// straight.
    void settle(const SkinSide& side, const Vec3& at)
    {
        const Vec3 between = straight(side);
        middle(side) = (at - between).norm() < kRoundoff * length(side) ? between : at;
        skin_.set(side.place, Middle::settled);
    }

    void take_given()
    {
        if (!options_.given) return;
        std::vector<const SkinSide*> asked;
        std::vector<Vec3> from, to;
        for (const SkinSide& side : sides_) {
            if (!options_.given_all_over && !model_[face(side.patch)].keeps_nodes &&
                !model_[face(side.other)].keeps_nodes)
                continue;
            asked.push_back(&side);
            from.push_back(corners_[side.from]);
            to.push_back(corners_[side.to]);
        }
        const std::vector<Vec3> given = options_.given(from, to);
        for (std::size_t i = 0; i < asked.size(); ++i) {
            if (!given[i].allFinite()) continue;
            middle(*asked[i]) = given[i];
            skin_.set(asked[i]->place, Middle::settled);
            ++counts_.given;
        }
    }

    void place_on_edges()
    {
        EdgeFinder finder(model_);
        std::map<EdgeId, std::vector<std::pair<double, const SkinSide*>>> on_edge;
        for (const SkinSide& side : sides_) {
            if (skin_.state(side.place) != Middle::open || face(side.patch) == face(side.other)) continue;
            const auto found = finder.half_way(face(side.patch), face(side.other), corners_[side.from],
                                               corners_[side.to]);
            if (found) on_edge[found->edge].emplace_back(found->fraction, &side);
        }
        for (const auto& [edge, members] : on_edge) { // one call per edge: exact curves are evaluated in bulk
            check_cancelled(context_);
            std::vector<double> fractions;
            for (const auto& [fraction, side] : members) fractions.push_back(fraction);
            const std::vector<Vec3> points = surface::edge_points(model_, edge, fractions);
            for (std::size_t i = 0; i < members.size(); ++i) settle(*members[i].second, points[i]);
            (model_[edge].curve != nullptr ? counts_.exact : counts_.facets) += members.size();
        }
    }

    /// Keep the sides of a given mesh of order 1 straight.
    void keep_straight()
    {
        for (const SkinSide& side : sides_)
            if (skin_.state(side.place) == Middle::open &&
                (keeps_quads(model_[face(side.patch)]) || keeps_quads(model_[face(side.other)])))
                skin_.set(side.place, Middle::settled);
    }

    /// A corner by its level and source node.
    [[nodiscard]] Vec3 corner(int level, Index node) const
    {
        return corners_[level * mesh_.nodes_per_layer + node];
    }

    void blend_end(int l, const LevelBlend& blend)
    {
        const std::size_t count = mesh_.middles.sides.size();
        std::vector<std::uint8_t> known(count, 0);
        std::vector<Vec3> bends(count, Vec3::Zero());
        std::vector<Vec3> nodes(index(mesh_.nodes_per_layer));
        for (Index n = 0; n < mesh_.nodes_per_layer; ++n) nodes[index(n)] = corner(l, n);
        const auto between = [&](std::size_t s) {
            const Segment& side = mesh_.middles.sides[s];
            return Vec3((nodes[index(side[0])] + nodes[index(side[1])]) / 2);
        };
        const auto place = [&](std::size_t s) { return places_.side(index(l), static_cast<Index>(s)); };
        for (std::size_t s = 0; s < count; ++s) {
            known[s] = skin_.state(place(s)) == Middle::settled ? 1 : 0;
            if (known[s] == 0) continue;
            bends[s] = skin_.node(place(s)) - between(s);
            const Segment& side = mesh_.middles.sides[s];
            const double length = (nodes[index(side[1])] - nodes[index(side[0])]).norm();
            if (bends[s].norm() < kSamePlace * length) bends[s].setZero(); // rounding
        }
        blend.blend(nodes.data(), known, bends);
        for (std::size_t s = 0; s < count; ++s)
            if (known[s] == 0) skin_.node(place(s)) = between(s) + bends[s];
    }

    /// Sides along the rows of walls: blend the bends of known rows above and below, in frames that rotate
    /// with the wall.
    void blend_rows()
    {
        const auto levels = index(mesh_.layers) + 1;
        std::vector<Vec3> at(levels), local(levels);
        for (std::size_t r = 0; r < mesh_.rim.size(); ++r) {
            const Segment& side = mesh_.rim[r];
            const auto place = [&](std::size_t l) { return places_.side(l, mesh_.middles.rim_side[r]); };
            const auto node = [&](std::size_t l, std::size_t end) {
                return corner(static_cast<int>(l), side[end]);
            };
            for (std::size_t l = 0; l < levels; ++l) at[l] = (node(l, 0) + node(l, 1)) / 2;
            const auto frame = [&](std::size_t l) {
                return SideFrame(node(l, 0), node(l, 1),
                                 at[std::min(l + 1, levels - 1)] - at[l - (l > 0 ? 1 : 0)]);
            };
            const auto bend = [&](std::size_t l) { return frame(l).local(skin_.node(place(l)) - at[l]); };
            for (std::size_t low = 0; low + 1 < levels;) {
                std::size_t high = low + 1;
                while (high + 1 < levels && skin_.state(place(high)) == Middle::open) ++high;
                if (high == low + 1) {
                    low = high;
                    continue;
                }
                const Vec3 below = bend(low), above = bend(high);
                double whole = 0, way = 0;
                for (std::size_t l = low; l < high; ++l) whole += (at[l + 1] - at[l]).norm();
                if (below.norm() + above.norm() > kFileAccuracy * kFileAccuracy && whole > 0) {
                    for (std::size_t l = low + 1; l < high; ++l) {
                        way += (at[l] - at[l - 1]).norm();
                        const Vec3 between = (1 - way / whole) * below + (way / whole) * above;
                        skin_.node(place(l)) = at[l] + frame(l).world(between);
                    }
                }
                low = high;
            }
        }
    }

    void bend_columns()
    {
        for (int l = 0; l < mesh_.layers; ++l)
            for (const Segment& side : mesh_.rim) {
                const std::size_t place = places_.upright(index(l), side[0]);
                if (skin_.state(place) != Middle::open) continue;
                const Vec3 bend = rim_bend(corners_, side[0], l);
                const double length = (corner(l + 1, side[0]) - corner(l, side[0])).norm();
                if (bend.norm() > kSamePlace * length) skin_.node(place) += bend;
            }
    }

    /// @param ends  true: faces of source and target; false: walls.
    void project(bool ends)
    {
        std::map<FaceId, std::vector<const SkinSide*>> of_face;
        const std::size_t first_on_walls = places_.upright(0, 0);
        const std::size_t target = places_.side(index(mesh_.layers), 0);
        for (const SkinSide& side : sides_) {
            if (skin_.state(side.place) != Middle::open) continue;
            const bool on_end = side.place < first_on_walls || side.place >= target;
            if (on_end != ends) continue;
            // A side between two faces without an edge is projected onto the face that has a surface.
            const bool other = model_[face(side.patch)].surface == nullptr &&
                               model_[face(side.other)].surface != nullptr;
            of_face[face(other ? side.other : side.patch)].push_back(&side);
        }
        for (const auto& [id, members] : of_face) project_on(id, members);
    }

    void project_on(FaceId id, const std::vector<const SkinSide*>& members)
    {
        const bool exact = model_[id].surface != nullptr;
        std::vector<const SkinSide*> sides;
        if (exact) {
            sides = members;
        } else {
            const geometry::FacetTree tree(model_.points, model_[id].triangles);
            for (const SkinSide* side : members) {
                const Vec3 a = corners_[side->from], b = corners_[side->to];
                const double near = kFileAccuracy * (b - a).norm();
                const auto on = [&](const Vec3& p) { return tree.closest(p, near * near).triangle >= 0; };
                if (on(a) && on(b)) sides.push_back(side);
            }
        }
        if (sides.empty()) return;
        std::vector<Vec3> points;
        for (const SkinSide* side : sides) points.push_back(middle(*side));
        surface::Projector(model_, {id}).project(points, context_);
        for (std::size_t i = 0; i < sides.size(); ++i) settle(*sides[i], points[i]);
        (exact ? counts_.exact : counts_.facets) += sides.size();
    }

    /// The given centres of the skin's quads; NaN where none is given.
    [[nodiscard]] std::vector<Vec3> given_centres() const
    {
        std::vector<Vec3> found(mesh_.skin_count(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
        if (!options_.given_centres) return found;
        std::vector<std::array<Vec3, 4>> corners;
        std::vector<std::size_t> quads;
        for (std::size_t i = 0; i < mesh_.skin_count(); ++i) {
            const mesh::SkinQuad quad = mesh::skin_quad(mesh_, i);
            if (!options_.given_all_over && !keeps_quads(model_[face(quad.patch)])) continue;
            quads.push_back(i);
            std::array<Vec3, 4>& own = corners.emplace_back();
            for (std::size_t k = 0; k < 4; ++k) own[k] = corners_[quad.nodes[k]];
        }
        const std::vector<Vec3> given = options_.given_centres(corners);
        for (std::size_t i = 0; i < quads.size(); ++i) found[quads[i]] = given[i];
        return found;
    }

    /// Place the centres of the skin's quads: as given, or from the middles of their sides, projected if the
    /// face requires it.
    void place_centres()
    {
        const std::vector<Vec3> given = given_centres();
        std::map<FaceId, std::vector<std::size_t>> of_face;
        for (std::size_t i = 0; i < mesh_.skin_count(); ++i) {
            const FaceId face = faces_[index(mesh::skin_quad(mesh_, i).patch)];
            const mesh::CellNodes nodes = mesh::skin_nodes(mesh_, i);
            const auto place = [&](std::size_t n) { return index(nodes.node[n]) - corner_count(mesh_); };
            if (given[i].allFinite()) {
                skin_.node(place(8)) = given[i];
                skin_.set(place(8), Middle::settled);
                ++counts_.given;
                continue;
            }
            std::array<Vec3, 4> sides, corners;
            for (std::size_t k = 0; k < 4; ++k) {
                sides[k] = skin_.node(place(4 + k));
                corners[k] = corners_[nodes.node[k]];
            }
            skin_.node(place(8)) = middle_of_quad(sides, corners);
            skin_.set(place(8), Middle::loose);
            if (model_[face].surface != nullptr && !keeps_quads(model_[face]))
                of_face[face].push_back(place(8));
        }
        for (const auto& [face, places] : of_face) {
            check_cancelled(context_);
            std::vector<Vec3> points;
            for (const std::size_t place : places) points.push_back(skin_.node(place));
            surface::Projector(model_, {face}).project(points, context_);
            for (std::size_t i = 0; i < places.size(); ++i) {
                constexpr double kRounding = 1e-14; // of the model; below it, flat quads stay exactly flat
                Vec3& at = skin_.node(places[i]);
                if ((points[i] - at).norm() > kRounding * model_.diagonal) at = points[i];
                skin_.set(places[i], Middle::settled);
            }
        }
    }

    const Model& model_;
    const mesh::SkinNodes& corners_;
    const mesh::HexMesh& mesh_ = corners_.mesh;
    const mesh::MiddlePlaces places_{mesh_};
    const std::vector<FaceId>& faces_;
    const SecondOrderOptions& options_;
    const RunContext& context_;
    const std::vector<SkinSide> sides_ = skin_sides(mesh_);
    SkinMiddles skin_{mesh_};
    SkinCounts counts_;
};

} // namespace

PlacedSkin place_skin(const OpenVolume& volume, const mesh::SkinNodes& corners,
                      const std::vector<FaceId>& faces, const SecondOrderOptions& options,
                      const RunContext& context)
{
    return SkinPlacer(volume, corners, faces, options, context).place();
}

} // namespace lacuna::sweep
