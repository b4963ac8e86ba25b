// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/void_geometry.h>

#include <vector>

namespace lacuna::closure {

/// Add a void edge through new points, or a straight one.
EdgeId add_void_edge_through(topology::Model& model, VertexId from, VertexId to,
                             const std::vector<Vec3>& between = {});
EdgeId add_void_edge_through(topology::ModelBuilder& builder, VertexId from, VertexId to,
                             const std::vector<Vec3>& between);

/// Add filled faces to the volume whose model they were filled for. Adding n faces at once costs one pass
/// over the model, not n.
std::vector<FaceId> add_void_faces(topology::OpenVolume& volume, std::vector<VoidFilling> fillings,
                                   topology::Role role);
FaceId add_void_face(topology::OpenVolume& volume, VoidFilling filling, topology::Role role);

} // namespace lacuna::closure
