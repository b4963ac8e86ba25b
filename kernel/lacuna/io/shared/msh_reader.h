// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace lacuna::io {

/// A named group of an MSH file, with the entities that belong to it.
struct MshGroup {
    int dimension = 0;
    int tag = 0;
    std::string name;          ///< empty where the file gives none
    std::vector<int> entities; ///< tags of the group's surfaces, volumes…, rising
};

/// Cells of another kind than asked for.
struct OtherCells {
    int dimension = 0;
    int type = 0; ///< Gmsh's element type
    std::size_t count = 0;
};

/// The hexahedra of a mesh file and the faces beside them.
struct MshCells {
    std::vector<Vec3> nodes;     ///< in the order of the file
    std::vector<Hex> hexes;      ///< node numbers from 0; of curved cells the corners
    std::vector<int> hex_entity; ///< volume entity of each
    std::vector<Quad> quads;     ///< likewise, surface cells
    std::vector<int> quad_entity;
    std::vector<Triangle> triangles;
    std::vector<int> triangle_entity;
    std::vector<MshGroup> groups;
    std::vector<OtherCells> others; ///< what else the file holds, counted
    int order = 1;                  ///< highest order among the hexahedra
};

/// Read an MSH file: 1.0, 2.x, 4.0 or 4.1, binary or text. Sections it does not know are passed over.
/// @throw InvalidInput  the file is not there, not such a file, cut off or at odds with itself; says where.
MshCells read_msh(const std::string& path);

} // namespace lacuna::io
