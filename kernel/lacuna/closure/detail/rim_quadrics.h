// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/model.h>

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// A quadric surface in its own frame: (p − centre) / unit.
struct Quadric {
    Vec3 centre = Vec3::Zero();
    double unit = 1;                                ///< [model length]
    Eigen::Matrix4d form = Eigen::Matrix4d::Zero(); ///< zero at (x, y, z, 1) on the surface
};

/// The sheet of a quadric that contains a rim, as heights over a plane.
struct QuadricSheet {
    Quadric quadric;
    geometry::Plane plane;
    double side = 1; ///< sign of the form's slope along the plane's normal: 1 or -1

    /// @return  empty if the quadric has no point over the place [model length].
    [[nodiscard]] std::optional<double> height(const Vec2& place) const;
};

bool is_pair_of_planes(const Quadric& quadric);

/// Shapes of a face that follow from its non-planar rim.
struct RimShapes {
    /// Sheets that the rim determines. If only one quadric goes through the rim, these are its sheets. If
    /// there are many, as through the end of a circular tube, they are the sheets of the spheres, circular
    /// cylinders, cones and pairs of planes among them. Planes of given faces at the rim are excluded.
    std::vector<QuadricSheet> told;
    /// If there are many quadrics, the other cylinders among them: the face may lie on any of these.
    std::vector<QuadricSheet> possible;
};

/// @param plane  base plane of the face's heights.
/// @return  no sheets if the rim is on no quadric, or has too few points to decide.
RimShapes shapes_of_rim(const topology::Model& model, const std::vector<topology::Loop>& loops,
                        const geometry::Plane& plane);

} // namespace lacuna::closure
