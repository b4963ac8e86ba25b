// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/node_reader.h>
#include <lacuna/io/partition.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <functional>
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

/// A piece of a mesh as a view of its own, with marks on points and cells of other pieces.
struct PieceView {
    std::shared_ptr<const mesh::MeshView> view;
    /// Write 1 for ghosts and 0 for others, for the points [begin, end), or for these cells of a block.
    std::function<void(std::size_t begin, std::size_t end, std::uint8_t* out)> ghost_points;
    std::function<void(std::size_t block, std::size_t begin, std::size_t end, std::uint8_t* out)> ghost_cells;
};
/// View one piece. Numbers are those of the unpartitioned file. All arguments except `part` must outlive the
/// view.
PieceView piece_of(const mesh::HexMesh& mesh, const LayerPart& part, const NodeReader& nodes,
                   const std::vector<FieldReader>& fields);

} // namespace lacuna::io
