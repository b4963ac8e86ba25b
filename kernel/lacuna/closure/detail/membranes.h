// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <vector>

namespace lacuna::closure {

/// The membranes among some void faces. Membrane: a void face over a non-planar rim that does not determine
/// the inside of the face. Four-sided faces are not membranes, because they are blended from side to side;
/// nor are faces on a quadric that their rim determines, such as the mouth of a keyway on its shaft.
std::vector<FaceId> membranes(const topology::Model& model, const std::vector<FaceId>& void_faces);
bool is_membrane(const topology::Model& model, FaceId face);

/// Whether the rim determines how a face bends. If only one quadric goes through the rim, the face must be
/// near this quadric. If many quadrics do, the face must be near one of them that is a sphere, a circular
/// cylinder, a cone or a pair of planes. False for a face with several loops that are all flat, because many
/// surfaces go through such loops.
bool bends_as_rim(const topology::Model& model, FaceId face);

/// Whether all points of a face are close to its plane, compared with the extent of the face.
bool is_about_flat(const topology::Model& model, FaceId face);

} // namespace lacuna::closure
