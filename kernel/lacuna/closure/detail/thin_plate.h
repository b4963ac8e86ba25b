// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/newell.h>
#include <lacuna/topology/model.h>

#include <Eigen/Core>

#include <vector>

namespace lacuna::closure {

/// The surface of least bending energy through a rim, as heights over a plane: a thin-plate spline, a sum of
/// r² log r terms centred on the rim plus a plane. A membrane minimises area instead. Both are as smooth as
/// their rim; where they differ, the rim does not determine the inside.
struct ThinPlate {
    std::vector<Vec2> places; ///< divided by `unit`
    double unit = 1;          ///< [model length]
    Eigen::VectorXd weight;   ///< for each place, then of the terms 1, x and y

    /// Height at a place of the plane [model length].
    [[nodiscard]] double height(const Vec2& place) const;
};

/// The thin plate through sample points of some loops.
ThinPlate plate_over(const geometry::Plane& plane, const topology::Model& model,
                     const std::vector<topology::Loop>& loops);

} // namespace lacuna::closure
