// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/newell.h>
#include <lacuna/topology/model.h>

#include <Eigen/Core>

#include <vector>

namespace lacuna::closure {

/// The surface of least bending energy through a rim, as heights over a plane. It is a thin-plate spline: a
/// plane plus r² log r terms, where r is the distance from a point of the rim. It serves as the alternative
/// to a membrane, which minimises area: where the two surfaces differ, the rim does not determine the inside.
struct ThinPlate {
    std::vector<Vec2> places; ///< points of the rim in the plane, divided by `unit`
    double unit = 1;          ///< [model length]
    Eigen::VectorXd weight;   ///< weights of the r² log r terms of all places, then of the terms 1, x and y

    /// Height at a place of the plane [model length].
    [[nodiscard]] double height(const Vec2& place) const;
};

/// The thin plate through sample points of some loops.
ThinPlate plate_over(const geometry::Plane& plane, const topology::Model& model,
                     const std::vector<topology::Loop>& loops);

} // namespace lacuna::closure
