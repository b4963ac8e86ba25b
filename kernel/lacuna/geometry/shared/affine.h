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
    double rms = 0;          ///< root mean square distance of images from targets [model length]
    double max_residual = 0; ///< largest such distance [model length]
    int rank = 3; ///< number of directions whose images the data determine, 0…3; see `AffineFitter`

    [[nodiscard]] Vec3 operator()(const Vec3& p) const { return to_centre + linear * (p - from_centre); }
};

/// Least-squares affine fits from one set of points to several others; the factorisation is reused.
///
/// For points x and their images y, the map p ↦ L p + c minimises the mean of |y − (L x + c)|². If area
/// vectors are given, the term |n′ − L n|² is added, where n and n′ are the pseudo-normals of both rims @cite
/// roca_2010_sweep. Pseudo-normal: unit normal times √|area|. Its length scales with the width of the rim, so
/// a rotation with a uniform scale maps one pseudo-normal onto the other. Points on a planar rim do not
/// determine the image of the direction normal to their plane; the pseudo-normals do. The map then has full
/// rank, preserves orientation, and does not flatten or flip points outside the plane.
///
/// A direction is undetermined if the spread of the data along it is below √ε of the largest spread.
/// - One undetermined direction: its image is normal to the images of the other two directions, and its
///   length is the square root of the area that these two images span.
/// - Two undetermined directions: their images follow from the smallest rotation of the determined
///   direction, with the same scale.
///
/// Only orthogonal factorisations are used (no normal equations), so the error is ε times the condition
/// number of the spread.
class AffineFitter {
public:
    /// @param from       kept by reference: must outlive the fitter.
    /// @param from_area  Newell area vector of the rim of the points, summed over its loops; zero: none.
    explicit AffineFitter(std::span<const Vec3> from, const Vec3& from_area = Vec3::Zero());

    /// @pre to.size() equals from.size()
    [[nodiscard]] AffineFit fit(std::span<const Vec3> to, const Vec3& to_area = Vec3::Zero()) const;

    /// Distance of p from the centre, measured in units of the spread in each direction (Mahalanobis
    /// distance). Infinite for directions in which the data have no spread.
    [[nodiscard]] double reach(const Vec3& p) const;
    /// Number of directions determined by the data, 0…3.
    [[nodiscard]] int rank() const { return rank_; }

private:
    std::span<const Vec3> from_;
    Vec3 centre_{0, 0, 0};
    bool has_normal_ = false;
    int rank_ = 0;
    /// Root mean square spread along the axes, pseudo-normal included, largest first [model length].
    Vec3 spread_{0, 0, 0};
    Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity(); ///< principal directions as columns, right-handed
    Eigen::Matrix<double, Eigen::Dynamic, 3> basis_; ///< orthonormal columns: (row − centre) · axes / spread
};

/// Fit one affine map. Zero area vectors: no pseudo-normals are used.
AffineFit fit_affine(std::span<const Vec3> from, std::span<const Vec3> to,
                     const Vec3& from_area = Vec3::Zero(), const Vec3& to_area = Vec3::Zero());

/// A rotation, a uniform scale and a translation: p ↦ scale · rotation · p + translation.
struct RigidFit {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity(); ///< determinant 1
    double scale = 1;
    Vec3 translation{0, 0, 0};
    double rms = 0; ///< root mean square distance of the mapped points from their targets [model length]

    [[nodiscard]] Vec3 operator()(const Vec3& p) const { return scale * (rotation * p) + translation; }
};

/// Least-squares rigid fit (Kabsch, Umeyama 1991), never a reflection.
///
/// If the rotation is not unique (points on a line, or all coincident), the smallest one is returned.
/// @pre from.size() == to.size(), not 0.
RigidFit fit_rigid(std::span<const Vec3> from, std::span<const Vec3> to, bool with_scale);

/// Mean of the points; zero for none.
Vec3 mean_point(std::span<const Vec3> points);

} // namespace lacuna::geometry
