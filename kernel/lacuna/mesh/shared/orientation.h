// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/mesh/hex_mesh.h>

#include <array>
#include <vector>

namespace lacuna::mesh {

/// Directions at the centre of a swept cell, of length 1.
struct CellFrame {
    Vec3 column = Vec3::Zero(); ///< along the column of cells, from source to target
    Vec3 axis = Vec3::Zero();   ///< along the sweep, at the centroid of the section
    /// From the centroid of the section to the cell, normal to the axis. For a cell at the centroid, any
    /// direction normal to the axis.
    Vec3 radial = Vec3::Zero();
    Vec3 tangential = Vec3::Zero(); ///< axis × radial

    /// The axes of a material: 1. along the column; 2. the radial direction, made normal to the column;
    /// 3. normal to both.
    [[nodiscard]] std::array<Vec3, 3> material() const;
};

/// The directions of all cells, by their numbers.
///
/// If a rigid motion (a translation or a screw) maps one level of nodes onto the next, the directions between
/// these levels are tangents of that motion. They are then exact for straight sweeps, turns and helices. In
/// other layers, the directions are those of straight lines from level to level.
/// @pre  the mesh stores its nodes. O(nodes).
std::vector<CellFrame> cell_frames(const HexMesh& mesh);

} // namespace lacuna::mesh
