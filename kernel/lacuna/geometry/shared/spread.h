// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <Eigen/Core>

#include <span>

namespace lacuna::geometry {

/// Principal axes of a distribution of points or of unit normals (eigenvectors of the second moments).
struct Spread {
    Vec3 centre{0, 0, 0}; ///< reference point of the moments
    Vec3 square{0, 0, 0}; ///< mean squared distance from the centre along each axis, ascending [length²]
    Eigen::Matrix3d axis = Eigen::Matrix3d::Identity(); ///< unit vectors as columns, in the order of `square`
};

/// Moments about the mean.
/// @param weights  one for each point, with a sum above 0; empty: equal weights.
/// @pre `points` is not empty
Spread spread_of(std::span<const Vec3> points, std::span<const double> weights = {});

/// Moments about a given point.
Spread spread_about(const Vec3& centre, std::span<const Vec3> points, std::span<const double> weights = {});

} // namespace lacuna::geometry
