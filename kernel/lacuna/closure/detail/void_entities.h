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

/// Add a filled face to the volume.
FaceId add_void_face(topology::OpenVolume& volume, VoidFilling filling, topology::Role role);

} // namespace lacuna::closure
