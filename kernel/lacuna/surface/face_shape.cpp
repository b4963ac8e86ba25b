// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/face_shape.h>

#include <lacuna/surface/detail/fine_facets.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <utility>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Maximum distance from the polylines of the face's edges to the exact edges.
double sag_of_edges(const Model& model, FaceId face)
{
    double most = 0;
    for (const EdgeUse& use : uses_of(model[face])) {
        const Edge& edge = model[use.edge];
        if (edge.curve == nullptr) continue;
        std::vector<double> params;
        for (std::size_t i = 0; i + 1 < edge.params.size(); ++i)
            params.push_back((edge.params[i] + edge.params[i + 1]) / 2);
        std::vector<Vec3> middle(params.size());
        edge.curve->evaluate(params, middle);
        for (std::size_t i = 0; i < middle.size(); ++i) {
            const Vec3 chord = (model.at(edge.points[i]) + model.at(edge.points[i + 1])) / 2;
            most = std::max(most, (middle[i] - chord).norm());
        }
    }
    return most;
}

} // namespace

Vec3 FaceShape::bulge_at(std::size_t triangle, const Vec3& w) const
{
    if (bulge.empty()) return Vec3::Zero();
    const std::array<Vec3, 3>& b = bulge[triangle];
    return 4 * (w[0] * w[1] * b[0] + w[1] * w[2] * b[1] + w[2] * w[0] * b[2]);
}

Vec3 FaceShape::normal(std::size_t triangle) const
{
    const Triangle& t = triangles[triangle];
    const Vec3& a = points[index(t[0])];
    return (points[index(t[1])] - a).cross(points[index(t[2])] - a).stableNormalized();
}

double FaceShape::volume_integral(const Vec3& origin) const
{
    double sum = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Triangle& t = triangles[i];
        const Vec3 a = points[index(t[0])] - origin, b = points[index(t[1])] - origin,
                   c = points[index(t[2])] - origin;
        sum += a.dot(b.cross(c)) / 6;
        if (bulge.empty()) continue;
        // The mean over a facet of a quadratic bulge of one side is a third of the bulge at the side's
        // midpoint.
        const Vec3 mean = (bulge[i][0] + bulge[i][1] + bulge[i][2]) / 3;
        sum += mean.dot((b - a).cross(c - a)) / 2;
    }
    return sum;
}

void FaceShape::append(const FaceShape& other)
{
    const auto first = static_cast<Index>(points.size());
    const std::array<Vec3, 3> flat{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    if (!bulge.empty() || !other.bulge.empty()) {
        bulge.resize(triangles.size(), flat);
        bulge.insert(bulge.end(), other.bulge.begin(), other.bulge.end());
        bulge.resize(triangles.size() + other.triangles.size(), flat);
    }
    points.insert(points.end(), other.points.begin(), other.points.end());
    for (const Triangle& t : other.triangles) triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    slack = std::max(slack, other.slack);
}

FaceShape face_shape(const Model& model, FaceId face, const SizeField& size)
{
    FineFacets fine = fine_facets(model, face, size, true);
    FaceShape shape{std::move(fine.points), std::move(fine.triangles), std::move(fine.bulge)};
    if (fine.surface == nullptr) shape.slack = sag_of_edges(model, face);
    return shape;
}

} // namespace lacuna::surface
