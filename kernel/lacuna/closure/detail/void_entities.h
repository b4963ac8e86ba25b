// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/void_geometry.h>

#include <vector>

namespace lacuna::closure {

/// Add a void edge through the points `between`; straight if there are none.
EdgeId add_void_edge_through(topology::Model& model, VertexId from, VertexId to,
                             const std::vector<Vec3>& between = {});
EdgeId add_void_edge_through(topology::ModelBuilder& builder, VertexId from, VertexId to,
                             const std::vector<Vec3>& between);

/// Add filled faces to a volume. Adding n faces at once costs one pass over the model, not n.
/// @pre  the fillings were made for the current model of this volume.
std::vector<FaceId> add_void_faces(topology::OpenVolume& volume, std::vector<VoidFilling> fillings,
                                   topology::Role role);
FaceId add_void_face(topology::OpenVolume& volume, VoidFilling filling, topology::Role role);

} // namespace lacuna::closure
