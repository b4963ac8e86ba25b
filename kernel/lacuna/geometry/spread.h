// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <Eigen/Core>

#include <span>

namespace lacuna::geometry {

/// How points, or unit normals, are spread: the axes of their second moments.
struct Spread {
    Vec3 centre{0, 0, 0}; ///< they are spread about
    Vec3 square{0, 0, 0}; ///< mean squared distance from the centre along each axis, rising [length²]
    Eigen::Matrix3d axis = Eigen::Matrix3d::Identity(); ///< unit columns, in the order of `square`
};

/// About their mean.
/// @param weights  one for each point, with a sum above 0; none: all count alike.
/// @pre `points` is not empty
Spread spread_of(std::span<const Vec3> points, std::span<const double> weights = {});

/// About a place of the caller's.
Spread spread_about(const Vec3& centre, std::span<const Vec3> points, std::span<const double> weights = {});

} // namespace lacuna::geometry
