// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/model.h>

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// A surface of second order, in a frame of its own: (p − centre) / unit.
struct Quadric {
    Vec3 centre = Vec3::Zero();
    double unit = 1;                                ///< [model length]
    Eigen::Matrix4d form = Eigen::Matrix4d::Zero(); ///< zero at (x, y, z, 1) where the surface is
};

/// The sheet of a quadric that a rim lies on, as heights over a plane.
struct QuadricSheet {
    Quadric quadric;
    geometry::Plane plane;
    double side = 1; ///< whether the form rises or falls along the plane's normal: 1 or -1

    /// @return  nothing where the quadric does not reach the place [model length].
    [[nodiscard]] std::optional<double> height(const Vec2& place) const;
};

bool is_pair_of_planes(const Quadric& quadric);

/// What a rim that lies in no plane says of the face within.
struct RimShapes {
    /// Sheets on which the face lies: the only quadric the rim is on, or, where it is on many, as where a
    /// round tube ends on something, the balls, round cylinders and cones and pairs of planes among them. No
    /// planes of given faces at the rim.
    std::vector<QuadricSheet> told;
    /// Other cylinders that such a rim is on: it may belong to each.
    std::vector<QuadricSheet> possible;
};

/// @param plane  over which the face within the loops is to lie.
/// @return  no sheets where the rim is on no quadric, or has too few points to tell.
RimShapes shapes_of_rim(const topology::Model& model, const std::vector<topology::Loop>& loops,
                        const geometry::Plane& plane);

} // namespace lacuna::closure
