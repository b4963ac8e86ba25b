// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/node_reader.h>
#include <lacuna/io/partition.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <memory>
#include <vector>

/// Views of swept meshes, stored or created while they are written. Internal to this folder.
namespace lacuna::io {

/// @throw InvalidInput  a skin quad belongs to no patch, or two patches share a tag.
void check_skin(const mesh::HexMesh& mesh);

/// View a mesh as blocks of hexahedra, wedges, skin quads and skin triangles. It has one entity for each
/// patch, in their order, followed by that of the volume. The arguments must outlive the view.
/// @throw InvalidInput  as `check_skin()`.
std::shared_ptr<const mesh::MeshView> view_of(const mesh::HexMesh& mesh, const NodeReader& nodes,
                                              const std::vector<FieldReader>& fields);

/// Assign the cells to parts by ranges of layers. @throw InvalidInput  as `layer_parts()`.
mesh::ViewParts parts_of(const mesh::HexMesh& mesh, const PartitionOptions& options);

} // namespace lacuna::io
