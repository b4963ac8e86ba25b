// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/mesh/hex_mesh.h>

#include <cstdint>
#include <optional>
#include <span>

/// Shapes of cells in the formats, and of swept meshes. Internal to this folder.
namespace lacuna::io {

/// A shape in the formats: the words of Abaqus, Nastran and Exodus for elements from another format, and the
/// numbers of UNV (for a face: a thin shell), Gmsh and VTK; empty and 0 if there is none.
struct ShapeWords {
    const char *abaqus, *nastran, *exodus;
    int unv, gmsh, vtk;
};
inline constexpr ShapeWords kShapeWords[kDeckShapes] = {
    // lines, triangles, quads
    {"", "", "", 0, 1, 3},
    {"", "", "", 0, 8, 21},
    {"S3", "CTRIA3", "TRI3", 91, 2, 5},
    {"STRI65", "CTRIA6", "TRI6", 92, 9, 22},
    {"S4", "CQUAD4", "SHELL4", 94, 3, 9},
    {"S8R", "CQUAD8", "SHELL8", 95, 16, 23},
    {"S9R5", "CQUAD", "SHELL9", 0, 10, 28},
    // tetrahedra, pyramids, wedges, hexahedra
    {"C3D4", "CTETRA", "TETRA", 111, 4, 10},
    {"C3D10", "CTETRA", "TETRA10", 118, 11, 24},
    {"C3D8", "CPYRAM", "PYRAMID", 115, 7, 14}, // see `is_merged_brick()`
    {"", "CPYRAM", "PYRAMID13", 0, 19, 27},
    {"", "", "", 0, 14, 0},
    {"C3D6", "CPENTA", "WEDGE", 112, 6, 13},
    {"C3D15", "CPENTA", "WEDGE15", 113, 18, 26},
    {"", "", "", 0, 13, 32},
    {"C3D8", "CHEXA", "HEX8", 115, 5, 12},
    {"C3D20", "CHEXA", "HEX20", 116, 17, 25},
    {"", "", "HEX27", 0, 12, 29},
};
inline const ShapeWords& words_of(DeckShape shape) { return kShapeWords[static_cast<std::size_t>(shape)]; }
/// The shape with a number above 0 in a format; empty: no shape has it.
inline std::optional<DeckShape> shape_numbered(int ShapeWords::*format, std::int64_t number)
{
    for (std::size_t s = kDeckShapes; s-- > 0;) // a brick before the pyramid that is written as one
        if (number > 0 && kShapeWords[s].*format == number) return static_cast<DeckShape>(s);
    return {};
}

/// Whether pyramids are written as bricks whose upper four nodes are the apex. UNV has no pyramid, and Abaqus
/// one that CalculiX lacks. The merged brick of eight nodes is a pyramid exactly: its sides are linear, so
/// that it fits tetrahedra, and CalculiX's result of a patch test has one stress to 1e-12. A merged C3D20 has
/// not (22 % of the stress), because its sides do not fit those of tetrahedra, so it is not written.
/// @param brick  whether the word or number to be written is that of a brick
inline bool is_merged_brick(DeckShape shape, bool brick) { return shape == DeckShape::pyramid5 && brick; }

/// Orders of a cell's nodes other than that of DeckShape.
enum class NodeOrder { exodus, gmsh, unv };
/// Positions of a shape's nodes in the order of DeckShape. In Exodus, and in Nastran, middles of upright
/// sides precede those above, and the centre of a hexahedron those of its faces. In UNV corners and middles
/// alternate around the cell in each layer, with the middles of upright sides between the layers.
std::span<const std::uint8_t> node_places(NodeOrder order, DeckShape shape);

/// The name given to a physical group of Gmsh without one.
std::string unnamed_group(int tag);

/// Shape of the hexahedra of a swept mesh, by its order and nodes.
inline DeckShape cell_shape(const mesh::HexMesh& mesh)
{
    return mesh.order() == 1 ? DeckShape::hex8 : mesh.middles.full ? DeckShape::hex27 : DeckShape::hex20;
}
/// Shape of the quads of its skin.
inline DeckShape skin_shape(const mesh::HexMesh& mesh)
{
    return mesh.order() == 1 ? DeckShape::quad4 : mesh.middles.full ? DeckShape::quad9 : DeckShape::quad8;
}

} // namespace lacuna::io
