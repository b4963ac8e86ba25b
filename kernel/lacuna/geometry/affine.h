// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <Eigen/Core>

#include <span>

namespace lacuna::geometry {

/// An affine map p ↦ to_centre + linear · (p − from_centre), fitted to pairs of points.
struct AffineFit {
    Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
    Vec3 from_centre{0, 0, 0};
    Vec3 to_centre{0, 0, 0};
    double rms = 0;          ///< root mean square distance of the images from their places [model length]
    double max_residual = 0; ///< largest such distance [model length]
    int rank = 3;            ///< directions the data decided, 0…3; the rest were completed

    [[nodiscard]] Vec3 operator()(const Vec3& p) const { return to_centre + linear * (p - from_centre); }
};

/// Least-squares affine fits from one set of points to several others: the set-up is done once.
///
/// Mean |y − (L x + c)|² is minimised, plus |n′ − L n|² for a pair of pseudo-normals where area vectors are
/// given
/// @cite roca_2010_sweep. A pseudo-normal is n·√|area|, as long as the rim is wide, so that a rotation with
/// a uniform scale maps one onto the other. It decides what a planar rim leaves open: the map then has full
/// rank, keeps right-handedness, and neither flattens nor flips what bulges out of the plane.
///
/// A direction in which the points spread less than √ε of their widest is not in the data. It is completed:
/// the third as the normal of the images of the other two, as long as keeps the shape; the last two by the
/// smallest turn. Orthogonal factors throughout (no normal equations): the error is of order ε times the
/// spread's condition.
class AffineFitter {
public:
    /// @param from       referred to, not copied: must outlive the fitter.
    /// @param from_area  Newell area vector of the rim the points are on, summed over its loops; zero: none.
    explicit AffineFitter(std::span<const Vec3> from, const Vec3& from_area = Vec3::Zero());

    /// @pre to.size() is that of the points fitted from.
    [[nodiscard]] AffineFit fit(std::span<const Vec3> to, const Vec3& to_area = Vec3::Zero()) const;

    /// Root mean square spread along the three principal directions, widest first; with the pseudo-normal's
    /// [model length].
    [[nodiscard]] const Vec3& spread() const { return spread_; }
    /// How many spreads it takes, in the direction of p, to reach p from the centre (Mahalanobis); infinite
    /// out of the data.
    [[nodiscard]] double reach(const Vec3& p) const;
    /// Directions the data decides, 0…3.
    [[nodiscard]] int rank() const { return rank_; }

private:
    std::span<const Vec3> from_;
    Vec3 centre_{0, 0, 0};
    bool has_normal_ = false;
    int rank_ = 0;
    Vec3 spread_{0, 0, 0};
    Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity(); ///< principal directions, columns, right-handed
    Eigen::Matrix<double, Eigen::Dynamic, 3> basis_; ///< orthonormal columns: (row − centre) · axes / spread
};

/// One fit of a fitter. An area vector of zero gives no pseudo-normal.
AffineFit fit_affine(std::span<const Vec3> from, std::span<const Vec3> to,
                     const Vec3& from_area = Vec3::Zero(), const Vec3& to_area = Vec3::Zero());

/// A rotation, a uniform scale and a translation: p ↦ scale · rotation · p + translation.
struct RigidFit {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity(); ///< proper: determinant 1
    double scale = 1;
    Vec3 translation{0, 0, 0};
    double rms = 0; ///< root mean square distance of the images from their places [model length]

    [[nodiscard]] Vec3 operator()(const Vec3& p) const { return scale * (rotation * p) + translation; }
};

/// Least-squares rigid fit (Kabsch, Umeyama 1991), never a reflection.
///
/// Where the points leave a turn open (all on a line, or all in one place) the smallest is taken.
/// @pre from.size() == to.size(), not 0.
RigidFit fit_rigid(std::span<const Vec3> from, std::span<const Vec3> to, bool with_scale);

/// Mean of the points; zero for none.
Vec3 mean_point(std::span<const Vec3> points);

} // namespace lacuna::geometry
