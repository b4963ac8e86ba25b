// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <optional>

namespace lacuna::topology {

/// The cone that a face is part of.
struct ConeShape {
    double half_angle = 0;     ///< between axis and surface, in (0, 90) [degrees]
    Vec3 apex = Vec3::Zero();  ///< its tip, which the face need not reach
    Vec3 axis = Vec3::UnitZ(); ///< unit, from the tip into the cone
    double least_radius = 0;   ///< of the face [model length]
    double largest_radius = 0; ///< of the face [model length]
};

/// The cone of a face, by its facets: the axis is what their normals lean to alike, and place and slope
/// are fitted to their corners by least squares.
/// @return nothing where corners are off by more than a hundredth of the largest radius, as of a plane, a
///         cylinder or a free form; and of a face with too few facets round the axis to tell.
/// @note  O(facets).
std::optional<ConeShape> cone_shape(const Model& model, FaceId face);

} // namespace lacuna::topology
