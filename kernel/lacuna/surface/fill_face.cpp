// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/fill_face.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/flatten.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/tips.h>
#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/surface/detail/fine_facets.h>
#include <lacuna/surface/detail/plane_loops.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/surface/shared/projector.h>
#include <lacuna/topology/open_volume.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace lacuna::surface {

using namespace topology;

namespace {

using Loops = std::vector<std::vector<Index>>;

/// A planar face, mapped to its own plane.
class PlaneFace {
public:
    PlaneFace(const geometry::Plane& plane, std::span<const RimNode> rim) : plane_(plane)
    {
        for (const RimNode& node : rim) box_.extend(geometry::to_plane(plane, node.point));
    }

    [[nodiscard]] std::vector<Vec2> lay(std::span<const RimNode> rim) const
    {
        std::vector<Vec2> flat;
        for (const RimNode& node : rim) flat.push_back(geometry::to_plane(plane_, node.point));
        return flat;
    }

    /// The size at a position, clamped to the bounding box of the rim: before smoothing, nodes of the mesher
    /// may lie outside the face, where the size is undefined.
    [[nodiscard]] double size_at(const Vec2& p, const SizeField& size) const
    {
        return size(geometry::from_plane(plane_, p.cwiseMax(box_.min()).cwiseMin(box_.max())));
    }

    [[nodiscard]] static std::vector<Vec2> tips() { return {}; }

    static void require_one_to_one(std::span<const Vec2> /*flat*/, const Loops& /*loops*/) {}

    [[nodiscard]] std::vector<Vec3> lift(std::span<const Vec2> points) const
    {
        std::vector<Vec3> lifted;
        for (const Vec2& p : points) lifted.push_back(geometry::from_plane(plane_, p));
        return lifted;
    }

private:
    geometry::Plane plane_;
    Eigen::AlignedBox2d box_; ///< bounding box of the rim
};

Message not_flat(const Model& model, FaceId face, const char* why)
{
    const bool open = model[face].origin == Origin::made_void;
    return Message("surface.not_flat", "{} cannot be flattened for paving: its facets {}",
                   entity_of(model, face), why)
        .remedy("{}", open ? "add the missing face there, or choose source and target so that the sweep has "
                             "another direction"
                           : "split it into simpler faces");
}

/// The facets of a face, flattened.
geometry::Flattened laid_flat(const Model& model, FaceId face, const FineFacets& fine)
{
    auto flat = attempt<InvalidInput>(
        [&] { return geometry::flatten(fine.points, fine.triangles, {.settled = kVisible}); });
    if (flat) return std::move(*flat);
    throw InvalidInput( // the error of `flatten()` names facets but not the face
        not_flat(model, face, "are in several parts, closed or have a handle").attempt(*flat.why));
}

/// A curved face and its flat image.
class FlatFace {
public:
    FlatFace(const Model& model, FaceId face, const SizeField& size)
        : model_(model),
          face_(face),
          fine_(fine_facets(model, face, size)),
          flat_(laid_flat(model, face, fine_))
    {
        if (flat_.folded) throw NotSweepable(not_flat(model, face, "fold"));
        locator_ = geometry::PlanarLocator(flat_);
        measure_stretch();
    }

    [[nodiscard]] std::vector<Vec2> lay(std::span<const RimNode> rim) const
    {
        std::map<EdgeId, std::vector<double>> arcs;
        std::vector<Vec2> places;
        for (const RimNode& node : rim) {
            std::vector<double>& arc = arcs[node.edge];
            if (arc.empty()) arc = geometry::arc_lengths(edge_line(model_, node.edge));
            const geometry::PolylinePlace at = geometry::place_at(arc, node.fraction * arc.back());
            places.push_back(place_on(node.edge, static_cast<double>(at.segment) + at.fraction));
        }
        return places;
    }

    /// The size on the face, scaled to the plane.
    [[nodiscard]] double size_at(const Vec2& p, const SizeField& size) const
    {
        const auto at = locator_.locate(p);
        const auto number = static_cast<std::size_t>(at.triangle);
        const Triangle &t = fine_.triangles[number], &f = flat_.triangles[number];
        Vec3 on_face = Vec3::Zero();
        double by = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double weight = at.barycentric[static_cast<int>(k)];
            on_face += weight * fine_.points[static_cast<std::size_t>(t[k])];
            by += weight * stretch_[static_cast<std::size_t>(f[k])];
        }
        return size(on_face) * by;
    }

    /// @param flat, loops  the rim's nodes in the plane, the outer loop first
    /// @throw NotSweepable  the chords between the nodes cross, or loops are not nested, as where a hole in
    ///        the side of a tube becomes a crescent
    void require_one_to_one(std::span<const Vec2> flat, const Loops& loops) const
    {
        bool fits = !geometry::find_crossing(flat, loops);
        for (std::size_t l = 0; l < loops.size(); ++l)
            fits = fits && (signed_area(flat, loops[l]) > 0) == (l == 0);
        if (!fits) throw NotSweepable(not_flat(model_, face_, "fold"));
    }

    /// Positions of the face's tips in the plane.
    [[nodiscard]] std::vector<Vec2> tips() const
    {
        std::vector<Vec2> tips;
        for (const Index p : geometry::find_tips(fine_.points, fine_.triangles)) tips.push_back(position(p));
        return tips;
    }

    [[nodiscard]] std::vector<Vec3> lift(std::span<const Vec2> points) const
    {
        std::vector<FacetPosition> places;
        for (const Vec2& p : points) {
            const auto found = locator_.locate(p);
            places.push_back({found.triangle, found.barycentric});
        }
        return points_at({fine_.points, fine_.triangles, fine_.uv, fine_.surface.get()}, places);
    }

private:
    /// The position in the plane of a point on an edge. @param at  position on the edge, as in
    /// `FineFacets::OnEdge::at`
    [[nodiscard]] Vec2 place_on(EdgeId edge, double at) const
    {
        const std::vector<FineFacets::OnEdge>& chain = fine_.edges.at(edge);
        auto after = std::upper_bound(chain.begin(), chain.end(), at,
                                      [](double a, const FineFacets::OnEdge& b) { return a < b.at; });
        after = std::clamp(after, chain.begin() + 1, chain.end() - 1);
        const auto before = after - 1;
        const double share = (at - before->at) / (after->at - before->at);
        return (1 - share) * position(before->point) + share * position(after->point);
    }

    [[nodiscard]] const Vec2& position(Index point) const
    {
        const auto found = std::lower_bound(flat_.used.begin(), flat_.used.end(), point);
        return flat_.position[static_cast<std::size_t>(found - flat_.used.begin())];
    }

    /// Compute the local scale between plane and face at each point: the square root of the ratio of the
    /// areas of the facets around the point.
    void measure_stretch()
    {
        std::vector<double> plane(flat_.used.size(), 0.0), space(flat_.used.size(), 0.0);
        for (std::size_t i = 0; i < flat_.triangles.size(); ++i) {
            const Triangle &f = flat_.triangles[i], &t = fine_.triangles[i];
            const auto at = [&](std::size_t k) { return fine_.points[static_cast<std::size_t>(t[k])]; };
            const double flat_area = std::abs(signed_area(flat_.position, f));
            const double area = (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
            for (const Index p : f) {
                plane[static_cast<std::size_t>(p)] += flat_area;
                space[static_cast<std::size_t>(p)] += area;
            }
        }
        for (std::size_t p = 0; p < plane.size(); ++p)
            stretch_.push_back(space[p] > 0 ? std::sqrt(plane[p] / space[p]) : 1);
    }

    const Model& model_;
    FaceId face_;
    FineFacets fine_;
    geometry::Flattened flat_;
    geometry::PlanarLocator locator_;
    std::vector<double> stretch_;
};

/// For each tip of the face (`geometry::find_tips()`), move the nearest node onto the tip, so that no quad
/// cuts the tip off. If the move would make quads poor, the node stays.
void meet_tips(quads::PlanarQuads& filling, std::size_t rim, const std::vector<Vec2>& tips)
{
    for (const Vec2& tip : tips) {
        std::size_t nearest = rim;
        for (std::size_t i = rim; i < filling.points.size(); ++i) {
            if ((filling.points[i] - tip).squaredNorm() < (filling.points[nearest] - tip).squaredNorm())
                nearest = i;
        }
        if (nearest >= filling.points.size()) continue;
        std::vector<Quad> around;
        std::ranges::copy_if(filling.quads, std::back_inserter(around), [&](const Quad& quad) {
            return std::ranges::find(quad, static_cast<Index>(nearest)) != quad.end();
        });
        const double before = quads::least_scaled_jacobian(filling.points, around);
        const Vec2 old = std::exchange(filling.points[nearest], tip);
        if (quads::least_scaled_jacobian(filling.points, around) < std::min(kFlatQuad, before))
            filling.points[nearest] = old;
    }
}

/// Fill a face in its flat image.
/// @tparam Image  `PlaneFace` or `FlatFace`.
template <class Image>
FaceQuads fill_flat(const Image& image, std::span<const RimNode> rim, Loops loops, const SizeFields& sizes,
                    const quads::PlanarQuadMesher& mesher, const quads::BoundaryRows* rows,
                    const RunContext& context)
{
    const auto there = [&](const SizeField& field) -> std::function<double(const Vec2&)> {
        if (!field) return {};
        return [&](const Vec2& p) { return image.size_at(p, field); };
    };
    std::vector<Vec2> flat = image.lay(rim);
    sort_outer_first(flat, loops);
    image.require_one_to_one(flat, loops);
    const quads::PlanarRegion region{std::move(flat), std::move(loops), there(sizes.edge), there(sizes.row)};
    auto [filling, finding] = rows == nullptr ? quads::RowsFilling{mesher(region, context), {}}
                                              : quads::fill_with_rows(region, *rows, mesher, context);
    if (finding) return {{}, {}, {}, finding};
    meet_tips(filling, rim.size(), image.tips());
    FaceQuads result{{}, std::move(filling.quads), std::move(filling.how)};
    for (const RimNode& node : rim) result.points.push_back(node.point);
    const std::vector<Vec3> inside = image.lift(std::span<const Vec2>(filling.points).subspan(rim.size()));
    result.points.insert(result.points.end(), inside.begin(), inside.end());
    return result;
}

} // namespace

FaceQuads fill_face(const Model& model, FaceId face, std::span<const RimNode> rim, const Loops& loops,
                    const SizeFields& sizes, const quads::PlanarQuadMesher& mesher,
                    const quads::BoundaryRows* rows, const RunContext& context)
{
    const Vec3 normal = face_area_vector(model, face).stableNormalized();
    const Vec3 origin = face_centroid(model, face);
    double bulge = 0;
    for (const Triangle& t : model[face].triangles) {
        for (const Index p : t) bulge = std::max(bulge, std::abs((model.at(p) - origin).dot(normal)));
    }
    if (bulge <= model.tolerance) {
        const PlaneFace flat(geometry::plane_across(origin, normal), rim);
        return fill_flat(flat, rim, loops, sizes, mesher, rows, context);
    }
    const FlatFace flat(model, face, sizes.edge);
    std::optional<quads::BoundaryRows> scaled;
    if (rows != nullptr) {
        scaled = *rows;
        scaled->scale = [&](const Vec2& p) { return flat.size_at(p, [](const Vec3&) { return 1.0; }); };
    }
    return fill_flat(flat, rim, loops, sizes, mesher, scaled ? &*scaled : nullptr, context);
}

} // namespace lacuna::surface
