// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/affine.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/geometry/shared/minimal_frame.h>

#include <Eigen/QR>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lacuna::geometry {

namespace {

// A spread below this share of the largest spread cannot be distinguished from a rounding error.
const double kUnresolved = std::sqrt(std::numeric_limits<double>::epsilon());

Vec3 pseudo_normal(const Vec3& area)
{
    const double size = area.norm();
    return size > 0 ? Vec3(area / std::sqrt(size)) : Vec3(Vec3::Zero());
}

/// Complete the images of undetermined directions so that the map is as close to a similarity as possible.
void complete(Eigen::Matrix3d& image, int rank)
{
    if (rank == 0) {
        image.setIdentity();
    } else if (rank == 1) {
        // The columns of `image` are the images of the principal axes. Only that of the first axis, column 0,
        // is known.
        const double length = image.col(0).norm();
        if (length > 0) {
            const Vec3 along = image.col(0);
            image = length * least_turn(Vec3::UnitX(), along);
        }
    } else if (rank == 2) {
        image.col(2) = pseudo_normal(image.col(0).cross(image.col(1)));
    }
}

} // namespace

Vec3 mean_point(std::span<const Vec3> points)
{
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : points) sum += p;
    return points.empty() ? sum : Vec3(sum / static_cast<double>(points.size()));
}

AffineFitter::AffineFitter(std::span<const Vec3> from, const Vec3& from_area)
    : from_(from), centre_(mean_point(from)), has_normal_(from_area.norm() > 0)
{
    const auto count = static_cast<Eigen::Index>(from.size());
    const double share = std::sqrt(static_cast<double>(std::max<std::size_t>(from.size(), 1)));
    Eigen::Matrix<double, Eigen::Dynamic, 3> rows(std::max<Eigen::Index>(count + 1, 3), 3);
    rows.setZero();
    for (Eigen::Index i = 0; i < count; ++i)
        rows.row(i) = (from[static_cast<std::size_t>(i)] - centre_) / share;
    rows.row(count) = pseudo_normal(from_area);

    const Eigen::HouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, 3>> qr(rows);
    const Eigen::Matrix3d triangle = qr.matrixQR().topRows<3>().template triangularView<Eigen::Upper>();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(triangle, Eigen::ComputeFullU | Eigen::ComputeFullV);
    spread_ = svd.singularValues();
    axes_ = svd.matrixV();
    Eigen::Matrix3d turn = svd.matrixU();
    if (axes_.determinant() < 0) {
        axes_.col(2) *= -1;
        turn.col(2) *= -1;
    }
    while (rank_ < 3 && spread_[rank_] > kUnresolved * spread_[0]) ++rank_;

    basis_.setZero(rows.rows(), 3);
    basis_.topRows<3>() = turn;
    basis_.applyOnTheLeft(qr.householderQ());
}

AffineFit AffineFitter::fit(std::span<const Vec3> to, const Vec3& to_area) const
{
    AffineFit result;
    result.from_centre = centre_;
    result.to_centre = mean_point(to);
    result.rank = rank_;

    const double share = std::sqrt(static_cast<double>(std::max<std::size_t>(to.size(), 1)));
    Eigen::Matrix3d image = Eigen::Matrix3d::Zero(); // images of the principal axes, as columns
    for (std::size_t i = 0; i < to.size(); ++i) {
        image += ((to[i] - result.to_centre) / share) * basis_.row(static_cast<Eigen::Index>(i));
    }
    if (has_normal_) image += pseudo_normal(to_area) * basis_.row(static_cast<Eigen::Index>(to.size()));
    for (int k = 0; k < 3; ++k) {
        if (k < rank_) image.col(k) /= spread_[k];
    }
    image = axes_.transpose() * image;
    complete(image, rank_);
    result.linear = axes_ * image * axes_.transpose();

    double sum = 0;
    double worst = 0;
    for (std::size_t i = 0; i < to.size(); ++i) {
        const double squared = (result(from_[i]) - to[i]).squaredNorm();
        sum += squared;
        worst = std::max(worst, squared);
    }
    result.rms = std::sqrt(sum) / share;
    result.max_residual = std::sqrt(worst);
    return result;
}

double AffineFitter::reach(const Vec3& p) const
{
    const Vec3 along = axes_.transpose() * (p - centre_);
    double squared = 0;
    for (int k = 0; k < 3; ++k) {
        if (k < rank_) {
            squared += (along[k] / spread_[k]) * (along[k] / spread_[k]);
        } else if (std::abs(along[k]) > kUnresolved * spread_[0]) {
            return kInfinity;
        }
    }
    return std::sqrt(squared);
}

AffineFit fit_affine(std::span<const Vec3> from, std::span<const Vec3> to, const Vec3& from_area,
                     const Vec3& to_area)
{
    return AffineFitter(from, from_area).fit(to, to_area);
}

RigidFit fit_rigid(std::span<const Vec3> from, std::span<const Vec3> to, bool with_scale)
{
    const Vec3 from_centre = mean_point(from);
    const Vec3 to_centre = mean_point(to);
    Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();
    double spread = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        cross += (to[i] - to_centre) * (from[i] - from_centre).transpose();
        spread += (from[i] - from_centre).squaredNorm();
    }

    RigidFit result;
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Vec3 strength = svd.singularValues();
    if (strength[0] > 0 && strength[1] > kUnresolved * strength[0]) {
        // Choose the sign of the weakest direction such that the determinant is 1.
        const Eigen::Matrix3d turn = svd.matrixU() * svd.matrixV().transpose();
        const Vec3 sign(1, 1, turn.determinant() < 0 ? -1 : 1);
        result.rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
    } else if (strength[0] > 0) {
        result.rotation = least_turn(svd.matrixV().col(0), svd.matrixU().col(0));
    }
    if (with_scale && spread > 0) {
        result.scale = (result.rotation.transpose() * cross).trace() / spread;
    }
    result.translation = to_centre - result.scale * (result.rotation * from_centre);

    double sum = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Vec3 image = to_centre + result.scale * (result.rotation * (from[i] - from_centre));
        sum += (image - to[i]).squaredNorm();
    }
    result.rms = from.empty() ? 0 : std::sqrt(sum / static_cast<double>(from.size()));
    return result;
}

} // namespace lacuna::geometry
