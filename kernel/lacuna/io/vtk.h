// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/io/cell_field.h>
#include <lacuna/io/partition.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/mesh/hex_mesh.h>

#include <string>
#include <vector>

namespace lacuna::io {

struct VtuOptions {
    std::vector<CellField> fields{}; ///< each becomes a cell array
};

/// Write hexahedra, then skin quads, for ParaView: XML, numbers raw behind it. The cell array "entity" holds
/// the tag of the skin patch, 0 for hexahedra; arrays of the whole file called as the groups list the
/// entities of each. Whole or not at all.
/// @throw InvalidInput  the folder does not exist, a skin quad belongs to no patch, as `check_fields()`.
/// @throw BackendError  the disk is full or the file cannot be written; nothing is left behind.
void write_vtu(const mesh::HexMesh& mesh, const OutputPath& path, const VtuOptions& options = {},
               const RunContext& context = {});

/// Write a mesh as pieces, each a VTU file of a range of layers: "mesh_0.vtu", "mesh_1.vtu" … beside
/// "mesh.pvtu", which names them. All are whole, or none is there.
///
/// Pieces hold the arrays of `write_vtu()`, and `node_number` and `cell_number`: places in the file that it
/// would write, from 1. Nodes between two pieces are in both; a quad of the skin is in the piece of its cell.
/// With ghosts, `vtkGhostType` is 1 for cells of other pieces, and for points that another piece owns.
/// @throw  as `write_vtu()` and `layer_parts()`
void write_pvtu(const mesh::HexMesh& mesh, const OutputPath& path, const PartitionOptions& partition,
                const VtuOptions& options = {}, const RunContext& context = {});

struct VtkOptions {
    bool binary = true;
    std::vector<CellField> fields{}; ///< each becomes a cell array
};

/// The same in VTK's legacy format.
void write_vtk(const mesh::HexMesh& mesh, const OutputPath& path, const VtkOptions& options = {},
               const RunContext& context = {});

} // namespace lacuna::io
