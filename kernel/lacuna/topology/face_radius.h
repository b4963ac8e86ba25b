// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <optional>

namespace lacuna::topology {

/// The cylinder or the sphere that a face is part of.
struct RoundShape {
    double radius = 0;          ///< [model length]
    Vec3 centre = Vec3::Zero(); ///< of the sphere, or a place on the axis half way along the face
    std::optional<Vec3> axis;   ///< of a cylinder; unit
    [[nodiscard]] bool is_sphere() const { return !axis; }
};

/// The cylinder or sphere of a face, by its facets: of a cylinder the axis is what their normals are square
/// to, and its circle, or the sphere, is fitted to their corners by least squares.
/// @return nothing where corners are off by more than a hundredth of the radius, as of a plane, a cone or a
///         free form, and where the file says that the face is another shape.
std::optional<RoundShape> round_shape(const Model& model, FaceId face);

/// Its radius alone [model length].
std::optional<double> face_radius(const Model& model, FaceId face);

} // namespace lacuna::topology
