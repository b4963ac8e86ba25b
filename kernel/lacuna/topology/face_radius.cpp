// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/face_radius.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/dense_solve.h>
#include <lacuna/geometry/shared/spread.h>
#include <lacuna/topology/shared/cone_shape.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lacuna::topology {
namespace {

struct Round {
    double radius = 0;
    Eigen::VectorXd centre;
};

/// The circle or sphere through points, one per row, if all lie on it.
std::optional<Round> fitted(const Eigen::MatrixXd& points)
{
    // |p|² = 2 c·p + (r² - |c|²) is linear in the unknowns.
    const Eigen::Index n = points.cols();
    const Eigen::RowVectorXd mean = points.colwise().mean();
    const Eigen::MatrixXd at = points.rowwise() - mean;
    Eigen::MatrixXd left(points.rows(), n + 1);
    left << 2 * at, Eigen::VectorXd::Ones(points.rows());
    const Eigen::VectorXd found = geometry::least_squares(left, at.rowwise().squaredNorm());
    const Eigen::VectorXd centre = found.head(n);
    const double radius = std::sqrt(std::max(0.0, found[n] + centre.squaredNorm()));
    if (!(radius > 0) || !std::isfinite(radius)) return {};
    const Eigen::VectorXd distance = (at.rowwise() - centre.transpose()).rowwise().norm();
    if ((distance.array() - radius).abs().maxCoeff() > kAlikeSizes * radius) return {};
    return Round{radius, centre + mean.transpose()};
}

/// Whether facets are too few for the shape, so that the angle between neighbouring facets is that of a
/// corner. Example: the facets of a cube, whose corners lie on a sphere.
bool is_angular(const Model& model, const Face& face, const RoundShape& shape)
{
    const double least = std::cos(kBendBelow / 2 * std::numbers::pi / 180);
    return std::ranges::any_of(face.triangles, [&](const Triangle& t) {
        const Vec3 n = (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0]));
        return std::ranges::any_of(t, [&](Index corner) {
            Vec3 out = model.at(corner) - shape.centre;
            if (shape.axis) out -= out.dot(*shape.axis) * *shape.axis;
            return std::abs(n.dot(out)) < least * n.norm() * out.norm();
        });
    });
}

} // namespace

std::optional<double> face_radius(const Model& model, FaceId id)
{
    const auto shape = round_shape(model, id);
    return shape ? std::optional(shape->radius) : std::nullopt;
}

std::optional<RoundShape> round_shape(const Model& model, FaceId id)
{
    const Face& face = model[id];
    // The CAD file declares the kind. A small piece of such a face may look like a cylinder or sphere.
    for (const char* other : {"plane", "cone", "torus"})
        if (face.kind == other) return {};
    const auto [normals, areas] = facet_normals(model, id);
    if (normals.empty()) return {};
    const std::vector<Index> used = corner_points(face);
    Eigen::MatrixXd points(static_cast<Eigen::Index>(used.size()), 3);
    for (std::size_t p = 0; p < used.size(); ++p)
        points.row(static_cast<Eigen::Index>(p)) = model.at(used[p]).transpose();
    const geometry::Spread looks = geometry::spread_about(Vec3::Zero(), normals, areas);
    if (looks.square[1] < kAlikeSizes * kAlikeSizes) return {}; // all normals are equal
    if (looks.square[0] >= kAlikeSizes) {
        const auto sphere = fitted(points);
        // The corners of one row of facets round a cone lie on a sphere too.
        if (!sphere || cone_shape(model, id)) return {};
        const RoundShape shape{sphere->radius, sphere->centre, {}};
        return is_angular(model, face, shape) ? std::nullopt : std::optional(shape);
    }
    const Eigen::Matrix<double, 3, 2> across = looks.axis.rightCols<2>();
    const auto circle = fitted(points * across);
    if (!circle) return {};
    const Vec3 axis = looks.axis.col(0);
    const Eigen::VectorXd along = points * axis;
    const Vec3 centre = across * circle->centre + axis * (along.minCoeff() + along.maxCoeff()) / 2;
    const RoundShape shape{circle->radius, centre, axis};
    return is_angular(model, face, shape) ? std::nullopt : std::optional(shape);
}

} // namespace lacuna::topology
