// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace lacuna::mesh {

/// The shape of a cell: its dimension and its node layout.
///
/// Nodes are in the order of VTK and Abaqus: the corners as in `mesh::Hex`, the mid-side nodes in the order
/// of `side_corners()`, the centres of the faces, and the centre of the cell. Nastran, UNV and Exodus number
/// the mid-side nodes of vertical sides before those of the top; Gmsh has an order of its own. Readers and
/// writers convert.
enum class CellShape : std::uint8_t {
    line2,
    line3,
    tri3,
    tri6,
    quad4,
    quad8,
    quad9,
    tet4,
    tet10,
    pyramid5,
    pyramid13,
    pyramid14,
    wedge6,
    wedge15,
    wedge18,
    hex8,
    hex20,
    hex27,
};
inline constexpr std::size_t kCellShapes = 18;

struct CellShapeInfo {
    int dimension, corners, nodes;
};
/// @return  the properties of a shape.
const CellShapeInfo& shape_info(CellShape shape);
/// The shape with these counts; empty if there is none.
std::optional<CellShape> find_shape(int dimension, int corners, int nodes);
/// The two corners of each side that has a mid-side node, in the order of these nodes.
std::span<const std::pair<int, int>> side_corners(CellShape shape);
/// The corners of each face of a solid, counter-clockwise seen from outside; the fourth is -1 for a triangle.
std::span<const Quad> face_corners(CellShape shape);

/// A side of a cell, as in the sets of sides of a file. Sides 1, 2, … are the faces of a solid or the edges
/// of a shell, as Abaqus numbers them. A shell has two more sides: 0 is its face in the direction of its
/// normal, and -1 its face in the opposite direction.
struct CellSide {
    std::int64_t element = 0; ///< number of the cell
    int side = 0;             ///< number of the side
    friend constexpr auto operator<=>(const CellSide&, const CellSide&) = default;
};

/// The kind of the members of a named set.
enum class SetKind : std::uint8_t { nodes, elements, sides };

} // namespace lacuna::mesh
