// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/mesh/hex_mesh.h>

/// What cells of a swept mesh are. Internal to this folder.
namespace lacuna::io {

/// Words of Abaqus, Nastran and Exodus for a shape that came from elsewhere, and the UNV descriptor of a thin
/// shell; empty and 0 where there is none.
struct ShapeWords {
    const char *abaqus, *nastran, *exodus;
    int shell;
};
inline constexpr ShapeWords kShapeWords[kDeckShapes] = {
    // lines, triangles, quads
    {"", "", "", 0},
    {"", "", "", 0},
    {"S3", "CTRIA3", "TRI3", 91},
    {"STRI65", "CTRIA6", "TRI6", 92},
    {"S4", "CQUAD4", "SHELL4", 94},
    {"S8R", "CQUAD8", "SHELL8", 95},
    {"S9R5", "CQUAD", "SHELL9", 0},
    // tetrahedra, pyramids, wedges, hexahedra
    {"C3D4", "CTETRA", "TETRA", 0},
    {"C3D10", "CTETRA", "TETRA10", 0},
    {"C3D5", "CPYRAM", "PYRAMID", 0},
    {"", "CPYRAM", "PYRAMID13", 0},
    {"", "", "", 0},
    {"C3D6", "CPENTA", "WEDGE", 0},
    {"C3D15", "CPENTA", "WEDGE15", 0},
    {"", "", "", 0},
    {"C3D8", "CHEXA", "HEX8", 0},
    {"C3D20", "CHEXA", "HEX20", 0},
    {"", "", "HEX27", 0},
};
inline const ShapeWords& words_of(DeckShape shape) { return kShapeWords[static_cast<std::size_t>(shape)]; }

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
