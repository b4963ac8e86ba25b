// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <optional>

namespace lacuna::topology {

/// The cylinder or sphere that a face lies on.
struct RoundShape {
    double radius = 0;          ///< [model length]
    Vec3 centre = Vec3::Zero(); ///< centre of the sphere, or the point of the axis at mid-length of the face
    std::optional<Vec3> axis;   ///< unit axis of a cylinder; empty for a sphere
    [[nodiscard]] bool is_sphere() const { return !axis; }
    /// Distance of a point from the surface [model length]; negative inside.
    [[nodiscard]] double height(const Vec3& p) const
    {
        return (axis ? (p - centre).cross(*axis).norm() : (p - centre).norm()) - radius;
    }
};

/// The cylinder or sphere of a face, from its facets. The axis of a cylinder is normal to all facet normals.
/// The circle across the axis, or the sphere, is fitted to the corners by least squares.
/// @return empty in these cases:
///         - the file declares a plane, a cone or a torus;
///         - all normals are equal, or the facets fit a cone;
///         - a corner is off the cylinder or sphere by more than a hundredth of the radius;
///         - the facets are too few for the shape, such as those of a cube, whose corners lie on a sphere.
std::optional<RoundShape> round_shape(const Model& model, FaceId face);

/// Radius of round_shape() [model length].
std::optional<double> face_radius(const Model& model, FaceId face);

} // namespace lacuna::topology
