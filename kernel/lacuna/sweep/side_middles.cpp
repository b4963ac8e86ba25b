// SPDX-License-Identifier: MIT
#include <lacuna/sweep/shared/side_middles.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/surface/shared/projector.h>
#include <lacuna/sweep/detail/compare_face.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// The edges of a model as curves, to find positions on them.
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
    /// The point of an edge halfway between the two ends of a side. Empty if the two faces have no common
    /// edge, or if the side does not lie on such an edge.
    std::optional<Place> half_way(FaceId one, FaceId other, const Vec3& from, const Vec3& to)
    {
        const auto found = between_.find(std::minmax(one, other));
        if (found == between_.end()) return std::nullopt;
        const double length = (to - from).norm();
        // All edges between the two faces are in one tree; the closest segment shows which edge it is.
        const Curve& all = curve_of(found->second);
        const geometry::FacetTree::Hit hit = all.tree.closest((from + to) / 2);
        if (hit.triangle < 0) return std::nullopt;
        const EdgeId edge = all.edge[index(hit.triangle)];
        const Curve& curve = curve_of({edge});
        const double whole = curve.arc.back();
        const auto [a, off_a] = position(curve, from);
        auto [b, off_b] = position(curve, to);
        // Nodes on a curved edge may be off the chords of the edge by the sag of these chords.
        const double near = kFollowsFace * length;
        if (!(off_a < near && off_b < near && whole > 0)) return std::nullopt;
        const Edge& e = model_[edge];
        const bool closed = e.points.front() == e.points.back();
        if (closed && std::abs(b - a) > whole / 2) b += b < a ? whole : -whole;
        double middle = (a + b) / 2;
        if (middle < 0) middle += whole;
        if (middle > whole) middle -= whole;
        return Place{edge, middle / whole};
    }

private:
    struct Curve {
        geometry::FacetTree tree;
        std::vector<EdgeId> edge; ///< edge of each side in the tree
        std::vector<double> arc;  ///< for each edge, the running length at its start
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

/// The position `at`, or exactly the side's midpoint if the two differ only by rounding.
Vec3 settled(const SideOfSkin& side, const Vec3& at)
{
    const Vec3 straight = (side.from + side.to) / 2;
    return (at - straight).norm() < kRoundoff * (side.to - side.from).norm() ? straight : at;
}

/// Place the middles of the sides `members` on a face.
void place_on_face(const Model& model, FaceId face, std::span<const SideOfSkin> sides,
                   const std::vector<std::size_t>& members, std::vector<std::optional<Vec3>>& middles,
                   SkinCounts& counts, const RunContext& context)
{
    const bool exact = model[face].surface != nullptr;
    std::vector<std::size_t> on;
    if (exact) {
        on = members;
    } else {
        const geometry::FacetTree tree(model.points, model[face].triangles);
        for (const std::size_t i : members) {
            const double near = kFileAccuracy * (sides[i].to - sides[i].from).norm();
            const auto is_on = [&](const Vec3& p) { return tree.closest(p, near * near).triangle >= 0; };
            if (is_on(sides[i].from) && is_on(sides[i].to)) on.push_back(i);
        }
    }
    if (on.empty()) return;
    std::vector<Vec3> points;
    for (const std::size_t i : on) points.push_back(sides[i].near);
    surface::Projector(model, {face}).project(points, context);
    for (std::size_t k = 0; k < on.size(); ++k) middles[on[k]] = settled(sides[on[k]], points[k]);
    (exact ? counts.exact : counts.facets) += on.size();
}

} // namespace

std::vector<std::optional<Vec3>> middles_on_edges(const Model& model, std::span<const SideOfSkin> sides,
                                                  SkinCounts& counts, const RunContext& context)
{
    std::vector<std::optional<Vec3>> middles(sides.size());
    EdgeFinder finder(model);
    std::map<EdgeId, std::vector<std::pair<double, std::size_t>>> on_edge;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const SideOfSkin& side = sides[i];
        const auto found = finder.half_way(side.face, side.other, side.from, side.to);
        if (found) on_edge[found->edge].emplace_back(found->fraction, i);
    }
    // One call for all sides of an edge, because exact curves are evaluated in bulk.
    for (const auto& [edge, members] : on_edge) {
        check_cancelled(context);
        std::vector<double> fractions;
        for (const auto& [fraction, side] : members) fractions.push_back(fraction);
        const std::vector<Vec3> points = surface::edge_points(model, edge, fractions);
        for (std::size_t k = 0; k < members.size(); ++k) {
            const std::size_t i = members[k].second;
            middles[i] = settled(sides[i], points[k]);
        }
        (model[edge].curve != nullptr ? counts.exact : counts.facets) += members.size();
    }
    return middles;
}

std::vector<std::optional<Vec3>> middles_on_faces(const Model& model, std::span<const SideOfSkin> sides,
                                                  SkinCounts& counts, const RunContext& context)
{
    std::vector<std::optional<Vec3>> middles(sides.size());
    std::map<FaceId, std::vector<std::size_t>> of_face;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        // A side may lie between two faces that have no common edge. Such a side is projected onto the face
        // that has an exact surface.
        const bool other = model[sides[i].face].surface == nullptr &&
                           model[sides[i].other].surface != nullptr;
        of_face[other ? sides[i].other : sides[i].face].push_back(i);
    }
    for (const auto& [face, members] : of_face)
        place_on_face(model, face, sides, members, middles, counts, context);
    return middles;
}

} // namespace lacuna::sweep
