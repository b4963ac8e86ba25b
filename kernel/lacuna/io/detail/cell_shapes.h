// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/mesh/hex_mesh.h>

/// What cells of a swept mesh are. Internal to this folder.
namespace lacuna::io {

/// What the hexahedra of a swept mesh are, by its order and nodes.
inline DeckShape cell_shape(const mesh::HexMesh& mesh)
{
    return mesh.order() == 1 ? DeckShape::hex8 : mesh.middles.full ? DeckShape::hex27 : DeckShape::hex20;
}
/// And the quads of its skin.
inline DeckShape skin_shape(const mesh::HexMesh& mesh)
{
    return mesh.order() == 1 ? DeckShape::quad4 : mesh.middles.full ? DeckShape::quad9 : DeckShape::quad8;
}
/// Nodes of a cell and of a quad of its skin.
inline std::size_t cell_size(const mesh::HexMesh& mesh)
{
    return static_cast<std::size_t>(shape_info(cell_shape(mesh)).nodes);
}
inline std::size_t skin_size(const mesh::HexMesh& mesh)
{
    return static_cast<std::size_t>(shape_info(skin_shape(mesh)).nodes);
}

} // namespace lacuna::io
