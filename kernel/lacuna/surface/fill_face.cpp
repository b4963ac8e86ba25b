// SPDX-License-Identifier: MIT
#include <lacuna/surface/fill_face.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/flatten.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/polyline.h>
#include <lacuna/surface/projector.h>
#include <lacuna/topology/open_volume.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

namespace lacuna::surface {

using namespace topology;

namespace {

using Loops = std::vector<std::vector<Index>>;

double area_of(const std::vector<Vec2>& points, std::span<const Index> loop)
{
    double sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2& a = points[static_cast<std::size_t>(loop[i])];
        const Vec2& b = points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
        sum += a.x() * b.y() - a.y() * b.x();
    }
    return sum / 2;
}

/// The outer loop first, as the planar meshers want it.
PlanarRegion region_of(std::vector<Vec2> points, Loops loops, std::function<double(const Vec2&)> size)
{
    std::stable_sort(loops.begin(), loops.end(),
                     [&](const auto& a, const auto& b) { return area_of(points, a) > area_of(points, b); });
    return {std::move(points), std::move(loops), std::move(size)};
}

/// The points a filling has added.
std::span<const Vec2> inside_of(const PlanarQuads& filling, std::size_t rim)
{
    return std::span(filling.points).subspan(rim);
}

FaceQuads lifted(PlanarQuads filling, std::span<const RimNode> rim, const std::vector<Vec3>& inside)
{
    FaceQuads result;
    for (const RimNode& node : rim) result.points.push_back(node.point);
    result.points.insert(result.points.end(), inside.begin(), inside.end());
    result.quads = std::move(filling.quads);
    result.how = std::move(filling.how);
    return result;
}

FaceQuads fill_plane(const geometry::Plane& plane, std::span<const RimNode> rim, const Loops& loops,
                     const SizeField& size, const PlanarQuadMesher& mesher, const RunContext& context)
{
    std::vector<Vec2> flat;
    for (const RimNode& node : rim) flat.push_back(geometry::to_plane(plane, node.point));
    const auto size_there = [&](const Vec2& p) { return size(geometry::from_plane(plane, p)); };
    PlanarQuads filling = mesher(region_of(std::move(flat), loops, size_there), context);
    std::vector<Vec3> inside;
    for (const Vec2& p : inside_of(filling, rim.size())) inside.push_back(geometry::from_plane(plane, p));
    return lifted(std::move(filling), rim, inside);
}

/// A curved face, laid flat.
class FlatFace {
public:
    FlatFace(const Model& model, FaceId face)
        : model_(model),
          face_(face),
          flat_(geometry::flatten(model.points, model[face].triangles)),
          locator_(flat_)
    {
        if (flat_.folded) {
            throw NotSweepable("surface.not_flat",
                               name_of(model, face) +
                                   " cannot be laid flat without folding; split it into simpler faces");
        }
        measure_stretch();
    }

    [[nodiscard]] std::vector<Vec2> lay(std::span<const RimNode> rim) const
    {
        std::unordered_map<Index, Vec2> position;
        for (std::size_t i = 0; i < flat_.used.size(); ++i) position[flat_.used[i]] = flat_.position[i];
        std::map<EdgeId, std::vector<double>> arcs;
        std::vector<Vec2> places;
        for (const RimNode& node : rim) {
            const std::vector<Index>& chain = model_[node.edge].points;
            std::vector<double>& arc = arcs[node.edge];
            if (arc.empty()) {
                std::vector<Vec3> line;
                for (const Index p : chain) line.push_back(model_.at(p));
                arc = geometry::arc_lengths(line);
            }
            const geometry::PolylinePlace at = geometry::place_at(arc, node.fraction * arc.back());
            places.emplace_back((1 - at.fraction) * position.at(chain[at.segment]) +
                                at.fraction * position.at(chain[at.segment + 1]));
        }
        return places;
    }

    /// The size asked for on the face, as long as it is in the plane.
    [[nodiscard]] double size_at(const Vec2& p, const SizeField& size) const
    {
        const FacetPlace at = place(p);
        const auto number = static_cast<std::size_t>(at.triangle);
        const Triangle &t = model_[face_].triangles[number], &f = flat_.triangles[number];
        Vec3 on_face = Vec3::Zero();
        double by = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double weight = at.barycentric[static_cast<int>(k)];
            on_face += weight * model_.at(t[k]);
            by += weight * stretch_[static_cast<std::size_t>(f[k])];
        }
        return size(on_face) * by;
    }

    [[nodiscard]] std::vector<Vec3> lift(std::span<const Vec2> points) const
    {
        std::vector<FacetPlace> places;
        for (const Vec2& p : points) places.push_back(place(p));
        return points_at(model_, face_, places);
    }

private:
    [[nodiscard]] FacetPlace place(const Vec2& p) const
    {
        const auto found = locator_.locate(p);
        return {found.triangle, found.barycentric};
    }

    /// Lengths in the plane over those on the face, at each point used: the square root of the areas round it.
    void measure_stretch()
    {
        std::vector<double> plane(flat_.used.size(), 0.0), space(flat_.used.size(), 0.0);
        for (std::size_t i = 0; i < flat_.triangles.size(); ++i) {
            const Triangle &f = flat_.triangles[i], &t = model_[face_].triangles[i];
            const double flat_area = std::abs(area_of(flat_.position, f));
            const double area =
                (model_.at(t[1]) - model_.at(t[0])).cross(model_.at(t[2]) - model_.at(t[0])).norm() / 2;
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
    geometry::Flattened flat_;
    geometry::PlanarLocator locator_;
    std::vector<double> stretch_;
};

} // namespace

FaceQuads fill_face(const Model& model, FaceId face, std::span<const RimNode> rim, const Loops& loops,
                    const SizeField& size, const PlanarQuadMesher& mesher, const RunContext& context)
{
    const Vec3 normal = face_area_vector(model, face).stableNormalized();
    const Vec3 origin = face_centroid(model, face);
    double bulge = 0;
    for (const Triangle& t : model[face].triangles) {
        for (const Index p : t) bulge = std::max(bulge, std::abs((model.at(p) - origin).dot(normal)));
    }
    if (bulge <= model.tolerance)
        return fill_plane(geometry::plane_across(origin, normal), rim, loops, size, mesher, context);
    const FlatFace flat(model, face);
    const auto size_there = [&](const Vec2& p) { return flat.size_at(p, size); };
    PlanarQuads filling = mesher(region_of(flat.lay(rim), loops, size_there), context);
    const std::vector<Vec3> inside = flat.lift(inside_of(filling, rim.size()));
    return lifted(std::move(filling), rim, inside);
}

} // namespace lacuna::surface
