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

/// Names of a shape in the formats. For Abaqus, Nastran, Exodus and FEBio: the type word that is written for
/// elements read from another format; empty: there is none. For UNV (where a face is a thin shell), Gmsh,
/// VTK and MED: the number of the type; 0: there is none.
struct ShapeWords {
    const char *abaqus, *nastran, *exodus, *febio;
    int unv, gmsh, vtk, med;
};
inline constexpr ShapeWords kShapeWords[mesh::kCellShapes] = {
    // lines, triangles, quads
    {"", "", "", "", 0, 1, 3, 102},
    {"", "", "", "", 0, 8, 21, 103},
    {"S3", "CTRIA3", "TRI3", "tri3", 91, 2, 5, 203},
    {"STRI65", "CTRIA6", "TRI6", "tri6", 92, 9, 22, 206},
    {"S4", "CQUAD4", "SHELL4", "quad4", 94, 3, 9, 204},
    {"S8R", "CQUAD8", "SHELL8", "quad8", 95, 16, 23, 208},
    {"S9R5", "CQUAD", "SHELL9", "quad9", 0, 10, 28, 209},
    // tetrahedra, pyramids, wedges, hexahedra
    {"C3D4", "CTETRA", "TETRA", "tet4", 111, 4, 10, 304},
    {"C3D10", "CTETRA", "TETRA10", "tet10", 118, 11, 24, 310},
    {"C3D8", "CPYRAM", "PYRAMID", "pyra5", 115, 7, 14, 305}, // see `merged_brick()`
    {"C3D20", "CPYRAM", "PYRAMID13", "pyra13", 116, 19, 27, 313},
    {"", "", "PYRAMID14", "", 0, 14, 0, 0}, // see `vtk_view()`
    {"C3D6", "CPENTA", "WEDGE", "penta6", 112, 6, 13, 306},
    {"C3D15", "CPENTA", "WEDGE15", "penta15", 113, 18, 26, 315},
    {"", "", "", "", 0, 13, 32, 0},
    {"C3D8", "CHEXA", "HEX8", "hex8", 115, 5, 12, 308},
    {"C3D20", "CHEXA", "HEX20", "hex20", 116, 17, 25, 320},
    {"", "", "HEX27", "hex27", 0, 12, 29, 327},
};
inline const ShapeWords& words_of(DeckShape shape) { return kShapeWords[static_cast<std::size_t>(shape)]; }
/// The shape with a given number (above 0) in a format; empty: no shape has it.
inline std::optional<DeckShape> shape_numbered(int ShapeWords::*format, std::int64_t number)
{
    // Backwards: a brick comes before the pyramid that is written as one.
    for (std::size_t s = mesh::kCellShapes; s-- > 0;)
        if (number > 0 && kShapeWords[s].*format == number) return static_cast<DeckShape>(s);
    return {};
}

/// The brick that stands for a pyramid in UNV and Abaqus files: its four upper nodes are all the apex. UNV
/// has no pyramid. Abaqus has one of order 1 only, which CalculiX does not know.
///
/// - The displacement of the brick of eight nodes is linear along the sides of the pyramid, so the brick is
///   compatible with tetrahedra. In a patch test with CalculiX, the stress is uniform to 1e-12.
/// - The brick of twenty nodes is compatible with tetrahedra of order 2 if the displacement is linear along
///   the sides of the base. Equations in the deck enforce this (`abaqus_writer.cpp`). The stress is then
///   uniform to 1e-7; without the equations it is 22 % off.
///
/// @return  the brick of a pyramid; empty for other shapes
inline std::optional<DeckShape> merged_brick(DeckShape shape)
{
    if (shape == DeckShape::pyramid5) return DeckShape::hex8;
    if (shape == DeckShape::pyramid13) return DeckShape::hex20;
    return {};
}
/// For each node of the brick, the node of the pyramid. Order 1 uses the first eight entries, order 2 all
/// twenty.
inline constexpr std::array<std::uint8_t, 20> kMergedBrick{0, 1, 2, 3, 4, 4, 4, 4,  5,  6,
                                                           7, 8, 4, 4, 4, 4, 9, 10, 11, 12};

/// Formats whose cell nodes are ordered differently from DeckShape.
enum class NodeOrder { exodus, gmsh, unv, med };
/// For each node in the order of DeckShape, its position in the format's order. In Exodus and Nastran, middle
/// nodes of upright sides come before those of the top, and the centre of a hexahedron comes before the
/// centres of its faces. In UNV, corners and middle nodes alternate around the cell in each layer, with the
/// middle nodes of upright sides between the layers. In MED, the nodes of a solid's base are listed in the
/// opposite direction: counter-clockwise seen from outside.
std::span<const std::uint8_t> node_places(NodeOrder order, DeckShape shape);

/// The name given to a physical group of Gmsh that has none.
std::string unnamed_group(int tag);

/// Shape of the hexahedra of a swept mesh.
inline DeckShape cell_shape(const mesh::HexMesh& mesh)
{
    return mesh.order() == 1 ? DeckShape::hex8 : mesh.middles.full ? DeckShape::hex27 : DeckShape::hex20;
}
/// Shape of the quads of the skin of a swept mesh.
inline DeckShape skin_shape(const mesh::HexMesh& mesh)
{
    return mesh.order() == 1 ? DeckShape::quad4 : mesh.middles.full ? DeckShape::quad9 : DeckShape::quad8;
}

} // namespace lacuna::io
