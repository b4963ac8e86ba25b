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

/// A part of a quadric (a sheet), as heights over a plane.
struct QuadricSheet {
    Quadric quadric;
    geometry::Plane plane;
    double side = 1; ///< sign of the derivative of `form` along the plane's normal on this sheet: 1 or -1

    /// @return  height over the plane [model length]; empty if the sheet has no point over the place.
    [[nodiscard]] std::optional<double> height(const Vec2& place) const;
};

/// Whether a quadric is not a pair of planes.
bool is_bent(const Quadric& quadric);

/// Whether a quadric is a sphere, a circular cylinder or a circular cone.
bool is_round(const Quadric& quadric);

/// Shapes of a face that follow from its non-planar rim.
struct RimShapes {
    /// Sheets on which the face may lie. If only one quadric goes through the rim, these are its sheets. If
    /// there are many, as through the end of a circular tube, they are the sheets of the spheres, circular
    /// cylinders, cones and pairs of planes among these quadrics. Planes of given faces at the rim are
    /// excluded.
    std::vector<QuadricSheet> told;
    /// If there are many quadrics, the sheets of the other cylinders among them. The rim does not determine
    /// on which of these the face lies.
    std::vector<QuadricSheet> possible;
};

/// @param plane  base plane of the face's heights.
/// @return  no sheets if no quadric goes through the rim, or if the rim has too few points to decide.
RimShapes shapes_of_rim(const topology::Model& model, const std::vector<topology::Loop>& loops,
                        const geometry::Plane& plane);

} // namespace lacuna::closure
