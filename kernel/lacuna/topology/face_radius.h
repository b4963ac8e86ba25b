// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <optional>

namespace lacuna::topology {

/// The radius of a face that is part of a cylinder or a sphere, by its facets: of a cylinder the axis is what
/// their normals are square to, and its circle, or the sphere, is fitted to their corners by least squares.
/// @return [model length]; nothing where corners are off by more than a hundredth of the radius, as of a
///         plane, a cone or a free form.
std::optional<double> face_radius(const Model& model, FaceId face);

} // namespace lacuna::topology
