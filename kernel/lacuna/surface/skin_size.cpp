// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/skin_size.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/surface/detail/edge_turning.h>
#include <lacuna/surface/detail/facet_curvature.h>
#include <lacuna/surface/detail/width_sizes.h>
#include <lacuna/surface/shared/wall_columns.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/facet_area.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <ranges>
#include <utility>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Minimum size in narrow places, as a share of the requested size. A smaller value gives more triangles
/// along the rims, in inverse proportion. Faces that are too narrow for this size get flat triangles.
constexpr double kLeastShare = 0.1;

/// For each face that is meshed, the curvature at its points.
using Curvatures = std::vector<std::vector<PointCurvature>>;

double size_on(const PointCurvature& at, int per_turn)
{
    return at.most > 0 ? std::max(kFullTurn / (at.most * per_turn), at.least_size) : kInfinity;
}

/// Number of sides for a full turn with which the skin loses no more volume than allowed.
int sides_per_turn(const Model& model, const Curvatures& curvatures, const SizeField& size)
{
    const double allowed = kSameVolume / 2 * std::abs(volume_integral(model, all_faces(model)));
    // Points, and the requested size at each of them.
    std::vector<std::pair<const PointCurvature*, double>> points;
    for (const std::vector<PointCurvature>& face : curvatures)
        for (const PointCurvature& at : face) points.emplace_back(&at, size(at.point));
    const auto lost = [&](int count) { // the lost volume decreases when the count increases
        double sum = 0;
        for (const auto& [at, most] : points) {
            const double side = std::min(most, size_on(*at, count));
            sum += at->area * at->sum * side * side / 12;
        }
        return sum;
    };
    // Neighbouring triangles form a smaller angle than at a crease.
    const auto least = static_cast<int>(kDegreesPerTurn / kCreaseAngle);
    const auto counts = std::views::iota(least, kMostPerTurn);
    const auto first = std::ranges::partition_point(counts, [&](int count) { return lost(count) > allowed; });
    return first == counts.end() ? kMostPerTurn : *first;
}

/// Add sizes along the sides of the facets of curved faces. A facet side may be so long that the sizes at its
/// ends do not limit the size at its middle.
void add_curved(const Face& face, std::span<const PointCurvature> at, int per_turn, const SizeField& size,
                std::vector<PointSize>& sizes)
{
    if (at.empty()) return;
    const std::vector<Index> points = corner_points(face);
    const auto place = [&](Index p) -> const PointCurvature& {
        return at[static_cast<std::size_t>(std::ranges::lower_bound(points, p) - points.begin())];
    };
    for (const Triangle& t : face.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const PointCurvature &a = place(t[k]), &b = place(t[(k + 1) % 3]);
            const double first = std::min(size_on(a, per_turn), size(a.point));
            const double last = std::min(size_on(b, per_turn), size(b.point));
            const double wanted = std::ceil((b.point - a.point).norm() / (kApart * std::min(first, last)));
            const auto count = static_cast<int>(std::clamp(wanted, 1.0, kMostSamples));
            for (int i = 0; i < count; ++i) {
                const double share = static_cast<double>(i) / count;
                const Vec3 p = (1 - share) * a.point + share * b.point;
                const double own = (1 - share) * first + share * last;
                if (own < size(p)) sizes.push_back({p, own});
            }
        }
    }
}

/// Add the sizes that the distance to the opposite skin requires on curved faces, both inside and outside.
void add_gaps(const Model& model, const Curvatures& curvatures, const SizeField& size,
              std::vector<PointSize>& sizes, const RunContext& context)
{
    const std::vector<Triangle> facets = facets_of(model, all_faces(model));
    const geometry::FacetTree tree(model.points, facets, context);
    Index number = 0;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        if (curvatures[f].empty()) {
            number += static_cast<Index>(model.faces[f].triangles.size());
            continue;
        }
        const std::vector<Index> points = corner_points(model.faces[f]);
        for (const Triangle& t : model.faces[f].triangles) {
            check_cancelled(context);
            const Index own = number++;
            double curvature = 0;
            for (const Index p : t) {
                const auto place = std::ranges::lower_bound(points, p) - points.begin();
                curvature = std::max(curvature, curvatures[f][static_cast<std::size_t>(place)].most);
            }
            if (!(curvature > 0)) continue;
            const Vec3 middle = (model.at(t[0]) + model.at(t[1]) + model.at(t[2])) / 3;
            const Vec3 normal = facet_area_vector(model, t).stableNormalized();
            for (const double direction : {-1.0, 1.0}) {
                const Vec3 way = direction * normal;
                const auto hit = tree.first_along(middle + model.tolerance * way, way);
                if (hit.triangle < 0 || hit.triangle == own) continue;
                const Vec3 other = facet_area_vector(model, facets[index(hit.triangle)]).stableNormalized();
                if (-normal.dot(other) < kFacing) continue;
                const double most = std::sqrt(8 * kSagOfWidth * (hit.t + model.tolerance) / curvature);
                if (most < size(middle)) sizes.push_back({middle, most});
            }
        }
    }
}

} // namespace

SizeField skin_sizes(const Model& model, std::span<const SkinLine> lines, std::vector<PointSize> given,
                     const SizeField& size, const RunContext& context)
{
    Curvatures curvatures;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        check_cancelled(context);
        curvatures.push_back(keeps_cells(model.faces[f])
                                 ? std::vector<PointCurvature>{}
                                 : facet_curvature(model, FaceId(f), kCreaseAngle * kDegree));
    }
    const int per_turn = sides_per_turn(model, curvatures, size);
    std::vector<PointSize> sizes;
    for (std::size_t f = 0; f < curvatures.size(); ++f) {
        add_curved(model.faces[f], curvatures[f], per_turn, size, sizes);
        check_cancelled(context);
        if (!keeps_cells(model.faces[f]))
            add_width_sizes(model, FaceId(f), size, {per_turn, 1}, kLeastShare, sizes);
    }
    add_gaps(model, curvatures, size, sizes, context);
    for (const SkinLine& line : lines) {
        if (line.kept) continue;
        const double length = line.arc.back();
        const Vec3 &start = model.at(line.points.front()), &end = model.at(line.points.back());
        if (length < size(start)) sizes.push_back({start, length});
        if (length < size(end)) sizes.push_back({end, length});
        if (!line.edge.valid()) continue;
        const EdgeTurning turning(model, line.edge);
        for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
            const double turn = turning.between(line.arc[i], line.arc[i + 1]);
            const double side = line.arc[i + 1] - line.arc[i];
            double own = side * kFullTurn / (turn * per_turn);
            if (model[line.edge].curve == nullptr) own = std::max(own, side / 2);
            const Vec3 middle = (model.at(line.points[i]) + model.at(line.points[i + 1])) / 2;
            if (turn > 0 && own < size(middle)) sizes.push_back({middle, own});
        }
    }

    // Given sides may be longer than the requested size. The size then decreases with the distance from them:
    // it is the maximum of (length of the given side) - kGrading · distance. `GradedPoints` computes a
    // minimum, so it gets the negative lengths.
    std::vector<PointSize> coarse;
    for (const PointSize& side : given) {
        sizes.push_back(side);
        if (side.size > size(side.point)) coarse.push_back({side.point, -side.size});
    }
    return [size, fine = std::make_shared<const GradedPoints>(std::move(sizes), kGrading),
            coarse = std::make_shared<const GradedPoints>(std::move(coarse), kGrading)](const Vec3& p) {
        return std::max(fine->at(p, size(p)), -coarse->at(p, 0));
    };
}

} // namespace lacuna::surface
