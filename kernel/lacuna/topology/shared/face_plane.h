// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/newell.h>
#include <lacuna/topology/model.h>

#include <optional>

namespace lacuna::topology {

/// Whether all corners of a face's facets lie within the model's tolerance of a plane.
bool lies_in_plane(const Model& model, FaceId face, const geometry::Plane& plane);

/// The plane through the centre of a face, normal to its area vector. @pre the area vector is not zero
geometry::Plane mean_plane(const Model& model, FaceId face);

/// The plane of a planar face, through its centre; empty if the face is not planar.
std::optional<geometry::Plane> plane_of(const Model& model, FaceId face);

} // namespace lacuna::topology
