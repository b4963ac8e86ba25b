// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <vector>

namespace lacuna::closure {

/// The membranes among some void faces: faces over a non-planar rim that does not determine their inside.
/// Excluded are four-sided faces, which are blended from side to side, and faces on a quadric given by their
/// rim, like the mouth of a keyway on its shaft.
std::vector<FaceId> membranes(const topology::Model& model, const std::vector<FaceId>& void_faces);
bool is_membrane(const topology::Model& model, FaceId face);

/// Whether the rim determines how a face bends: it lies on one quadric (of many, on a sphere, a circular
/// cylinder, a cone or two planes), and the inside of the face is near that quadric.
bool bends_as_rim(const topology::Model& model, FaceId face);

/// Whether all points of a face are close to its plane, compared with the extent of the face.
bool is_about_flat(const topology::Model& model, FaceId face);

} // namespace lacuna::closure
