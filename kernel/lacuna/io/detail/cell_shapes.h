// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/mesh/hex_mesh.h>

#include <array>
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
    {"C3D20", "CPYRAM", "PYRAMID13", 116, 19, 27},
    {"", "", "PYRAMID14", 0, 14, 0}, // see `vtk_view()`
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

/// Pyramids are written as bricks whose upper nodes are the apex where a format has none: UNV, and Abaqus,
/// whose pyramid CalculiX lacks and which has none of order 2. The brick of eight nodes is a pyramid exactly:
/// its sides are linear, so that it fits tetrahedra, and CalculiX's result of a patch test has one stress to
/// 1e-12. The sides of a brick of twenty nodes fit those of tetrahedra if the displacement is linear along
/// the sides of the base, which equations in the deck see to (`abaqus_writer.cpp`): the stress is one to 1e-7
/// then, and 22 % off without.
///
/// @return  the brick of a pyramid; empty for other shapes
inline std::optional<DeckShape> merged_brick(DeckShape shape)
{
    if (shape == DeckShape::pyramid5) return DeckShape::hex8;
    if (shape == DeckShape::pyramid13) return DeckShape::hex20;
    return {};
}
/// The node of the pyramid at each node of its brick, of which the first eight or all twenty are used.
inline constexpr std::array<std::uint8_t, 20> kMergedBrick{0, 1, 2, 3, 4, 4, 4, 4,  5,  6,
                                                           7, 8, 4, 4, 4, 4, 9, 10, 11, 12};

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
