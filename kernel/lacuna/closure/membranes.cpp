// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/membranes.h>

#include <lacuna/closure/detail/rim_quadrics.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/dense_solve.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/use_places.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace lacuna::closure {

using namespace topology;

namespace {

/// A face is about flat if half the range of its heights over its plane is within this share of its extent.
/// A lower value counts roughness as a bend; a higher one overlooks shallow bends.
constexpr double kFlat = 0.02;
/// Tolerance for the inside of a face on the quadric of its rim, as a share of its bulge. Bounded from above
/// by a membrane between two planes, which is further off both; a lower value rejects coarse facets.
constexpr double kNearIt = 0.2;

/// Corners of a face's facets as positions in its plane and heights above it.
struct Heights {
    Eigen::Matrix2Xd place;
    Eigen::VectorXd height;

    /// Extent in the plane [model length].
    [[nodiscard]] double extent() const
    {
        return (place.rowwise().maxCoeff() - place.rowwise().minCoeff()).norm();
    }
    /// Half the height range [model length].
    [[nodiscard]] double bulge() const { return (height.maxCoeff() - height.minCoeff()) / 2; }
};

Heights heights_of(const Model& model, FaceId face)
{
    const auto corners = static_cast<Eigen::Index>(3 * model[face].triangles.size());
    const geometry::Plane plane = mean_plane(model, face);
    Heights result{Eigen::Matrix2Xd(2, corners), Eigen::VectorXd(corners)};
    for (Eigen::Index i = 0; const Index p : corners_of(model[face])) {
        result.place.col(i) = geometry::to_plane(plane, model.at(p));
        result.height(i++) = geometry::height(plane, model.at(p));
    }
    return result;
}

/// Largest distance of heights from their best quadratic fit [model length].
double off_quadratic(const Heights& heights, double extent)
{
    Eigen::MatrixXd powers(heights.height.size(), 6);
    for (Eigen::Index i = 0; i < powers.rows(); ++i) {
        const Vec2 p = heights.place.col(i) / extent;
        powers.row(i) << 1, p.x(), p.y(), p.x() * p.x(), p.x() * p.y(), p.y() * p.y();
    }
    const Eigen::MatrixXd normal = powers.transpose() * powers;
    const Eigen::VectorXd right = powers.transpose() * heights.height;
    const Eigen::VectorXd fit = geometry::solve_symmetric(normal, right);
    return (powers * fit - heights.height).cwiseAbs().maxCoeff();
}

/// Whether a face lies on a sheet given by its rim.
bool lies_as_told(const Model& model, FaceId face)
{
    if (model[face].geometry != Geometry::newell || !(face_area_vector(model, face).norm() > 0)) return false;
    const geometry::Plane plane = mean_plane(model, face);
    const double off = kOnQuadratic * heights_of(model, face).bulge();
    const RimShapes shapes = shapes_of_rim(model, model[face].loops, plane);
    return std::ranges::any_of(shapes.told, [&](const QuadricSheet& sheet) {
        return std::ranges::all_of(corners_of(model[face]), [&](Index p) {
            const auto told = sheet.height(geometry::to_plane(plane, model.at(p)));
            return told && std::abs(*told - geometry::height(plane, model.at(p))) <= off;
        });
    });
}

} // namespace

bool is_about_flat(const Model& model, FaceId face)
{
    const Heights heights = heights_of(model, face);
    return heights.bulge() <= kFlat * heights.extent();
}

bool bends_off_quadratic(const Model& model, FaceId face)
{
    if (model[face].geometry != Geometry::newell || !(face_area_vector(model, face).norm() > 0)) return false;
    const Heights heights = heights_of(model, face);
    return off_quadratic(heights, heights.extent()) > kOnQuadratic * heights.bulge();
}

bool bends_as_rim(const Model& model, FaceId face)
{
    if (lies_as_told(model, face)) return true;
    const Heights heights = heights_of(model, face);
    const double extent = heights.extent(), bulge = heights.bulge();
    if (!(extent > 0)) return false;
    const Vec3 middle = face_centroid(model, face);
    const auto powers_at = [&](const Vec3& at) {
        const Vec3 p = (at - middle) / extent;
        Eigen::Vector<double, 10> powers;
        powers << 1, p, p.cwiseAbs2(), p.x() * p.y(), p.y() * p.z(), p.z() * p.x();
        return powers;
    };
    // Sample straight edges as densely as curved ones.
    constexpr int kOnEdge = 16;
    std::vector<Vec3> rim;
    for (const EdgeUse& use : uses_of(model[face])) {
        const std::vector<Vec3> along = geometry::even_places(use_places(model, use), kOnEdge);
        rim.insert(rim.end(), along.begin(), along.end() - 1);
    }
    Eigen::Matrix<double, 10, 10> sum = Eigen::Matrix<double, 10, 10>::Zero();
    for (const Vec3& p : rim) sum += powers_at(p) * powers_at(p).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 10, 10>> fit(sum);
    const Eigen::Vector<double, 10> q = fit.eigenvectors().col(0);
    const auto off = [&](const Vec3& at) {
        const Vec3 p = (at - middle) / extent;
        const Vec3 slope(q[1] + 2 * q[4] * p.x() + q[7] * p.y() + q[9] * p.z(),
                         q[2] + 2 * q[5] * p.y() + q[7] * p.x() + q[8] * p.z(),
                         q[3] + 2 * q[6] * p.z() + q[8] * p.y() + q[9] * p.x());
        return std::abs(powers_at(at).dot(q)) / slope.norm() * extent; // to first order
    };
    return std::ranges::all_of(rim, [&](const Vec3& p) { return off(p) <= kOnQuadratic * bulge; }) &&
           std::ranges::all_of(corners_of(model[face]),
                               [&](Index p) { return off(model.at(p)) <= kNearIt * bulge; });
}

bool is_membrane(const Model& model, FaceId face)
{
    return bends_off_quadratic(model, face) && !is_about_flat(model, face) && !lies_as_told(model, face);
}

std::vector<FaceId> membranes(const Model& model, const std::vector<FaceId>& void_faces)
{
    std::vector<FaceId> found;
    for (const FaceId face : void_faces)
        if (is_membrane(model, face)) found.push_back(face);
    return found;
}

} // namespace lacuna::closure
