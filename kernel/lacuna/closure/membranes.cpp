// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/membranes.h>

#include <lacuna/geometry/newell.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lacuna::closure {

using namespace topology;

namespace {

/// A face no further off its plane than this share of its extent is about flat. A choice, not a measurement.
constexpr double kFlat = 0.02;
/// Share of the bulge that a face may be off a quadratic height: what closing takes as lying on one.
constexpr double kOnIt = 0.03;

/// Corners of a face's facets as places on its plane and heights above it.
struct Heights {
    Eigen::Matrix2Xd place;
    Eigen::VectorXd height;
};

Heights heights_of(const Model& model, FaceId face)
{
    const std::vector<Triangle>& facets = model[face].triangles;
    const geometry::Plane plane = geometry::plane_across(face_centroid(model, face),
                                                         face_area_vector(model, face));
    Heights result{Eigen::Matrix2Xd(2, 3 * facets.size()), Eigen::VectorXd(3 * facets.size())};
    Eigen::Index i = 0;
    for (const Triangle& t : facets) {
        for (const Index p : t) {
            result.place.col(i) = geometry::to_plane(plane, model.at(p));
            result.height(i++) = geometry::height(plane, model.at(p));
        }
    }
    return result;
}

/// How far heights are off the quadratic one that fits them best [model length].
double off_quadratic(const Heights& heights, double extent)
{
    Eigen::MatrixXd powers(heights.height.size(), 6);
    for (Eigen::Index i = 0; i < powers.rows(); ++i) {
        const Vec2 p = heights.place.col(i) / extent;
        powers.row(i) << 1, p.x(), p.y(), p.x() * p.x(), p.x() * p.y(), p.y() * p.y();
    }
    const Eigen::MatrixXd normal = powers.transpose() * powers;
    const Eigen::VectorXd fit = normal.ldlt().solve(powers.transpose() * heights.height);
    return (powers * fit - heights.height).cwiseAbs().maxCoeff();
}

bool is_membrane(const Model& model, FaceId face)
{
    if (model[face].geometry == Geometry::minimal) return true;
    if (model[face].geometry != Geometry::newell || !(face_area_vector(model, face).norm() > 0)) return false;
    const Heights heights = heights_of(model, face);
    const double extent = (heights.place.rowwise().maxCoeff() - heights.place.rowwise().minCoeff()).norm();
    const double bulge = (heights.height.maxCoeff() - heights.height.minCoeff()) / 2;
    return bulge > kFlat * extent && off_quadratic(heights, extent) > kOnIt * bulge;
}

} // namespace

std::vector<FaceId> membranes(const Model& model, const std::vector<FaceId>& void_faces)
{
    std::vector<FaceId> found;
    for (const FaceId face : void_faces)
        if (is_membrane(model, face)) found.push_back(face);
    return found;
}

} // namespace lacuna::closure
