// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/newell.h>
#include <lacuna/topology/model.h>

#include <Eigen/Core>

#include <vector>

namespace lacuna::closure {

/// The surface of least bending through a rim, as heights over a plane: a thin-plate spline, a sum of
/// r² log r round places on the rim, and a plane. A membrane is the surface of least stretching. Both are as
/// smooth as their rim, and where they differ the rim leaves open how the inside bends.
struct ThinPlate {
    std::vector<Vec2> places; ///< divided by `unit`
    double unit = 1;          ///< [model length]
    Eigen::VectorXd weight;   ///< of each place, then of 1, x and y

    /// Over a place of the plane [model length].
    [[nodiscard]] double height(const Vec2& place) const;
};

/// The plate through places on some loops.
ThinPlate plate_over(const geometry::Plane& plane, const topology::Model& model,
                     const std::vector<topology::Loop>& loops);

} // namespace lacuna::closure
