// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace lacuna::mesh {

/// What a cell is, by its dimension and nodes.
///
/// Nodes are in the order of VTK, which is Abaqus's too: the corners, as in `mesh::Hex`, then the middles of
/// the sides in the order of `side_corners()`, those of the faces and that of the whole. Nastran, UNV and
/// Exodus put the middles of upright sides before those of the top, Gmsh has an order of its own: readers and
/// writers turn one into the other.
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
/// @return by value of the enumeration.
const CellShapeInfo& shape_info(CellShape shape);
/// The shape of these counts. @return false  there is none.
bool find_shape(int dimension, int corners, int nodes, CellShape& shape);
/// The corners of each side a middle node lies on, in the order of these nodes.
std::span<const std::pair<int, int>> side_corners(CellShape shape);
/// The corners of each face of a solid, seen from outside counter-clockwise; the fourth is -1 in triangles.
std::span<const Quad> face_corners(CellShape shape);

} // namespace lacuna::mesh
