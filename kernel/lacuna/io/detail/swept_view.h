// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/node_reader.h>
#include <lacuna/io/partition.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <functional>
#include <memory>
#include <vector>

/// Swept meshes, held or made as they are written, as views. Internal to this folder.
namespace lacuna::io {

/// @throw InvalidInput  a skin quad belongs to no patch, or two patches share a tag.
void check_skin(const mesh::HexMesh& mesh);

/// Hexahedra, wedges, quads of the skin and its triangles. An entity of each patch, in their order, and of
/// the volume, behind them. The arguments must outlive the view.
/// @throw InvalidInput  as `check_skin()`.
std::shared_ptr<const mesh::MeshView> view_of(const mesh::HexMesh& mesh, const NodeReader& nodes,
                                              const std::vector<FieldReader>& fields);

/// Parts by ranges of layers. @throw InvalidInput  as `layer_parts()`.
mesh::ViewParts parts_of(const mesh::HexMesh& mesh, const PartitionOptions& options);

/// A piece of a mesh as a view of its own, and what in it belongs to other pieces.
struct PieceView {
    std::shared_ptr<const mesh::MeshView> view;
    /// 1 for each of the points [begin, end), and of the cells of a block, that are ghosts.
    std::function<void(std::size_t begin, std::size_t end, std::uint8_t* out)> ghost_points;
    std::function<void(std::size_t block, std::size_t begin, std::size_t end, std::uint8_t* out)> ghost_cells;
};
/// Numbers are those in the file of the whole. The arguments but for `part` must outlive the view.
PieceView piece_of(const mesh::HexMesh& mesh, const LayerPart& part, const NodeReader& nodes,
                   const std::vector<FieldReader>& fields);

} // namespace lacuna::io
