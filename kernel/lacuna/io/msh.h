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

struct MshOptions {
    bool binary = true;
    double version = 4.1; ///< 4.1, or 2.2 for readers that know no other
    std::vector<CellField>
        fields{}; ///< each becomes $ElementData, by which Gmsh colours the cells on opening
    /// Ranges of layers as $PartitionedEntities, and $GhostElements, in the same file; of version 4.1 alone.
    /// Nodes and elements have the numbers that they have without.
    PartitionOptions partition{};
    /// Surfaces and cells are in all their groups, which overlap; else in one each, as solvers want it that
    /// know one mark a cell. Version 2.2 holds no more than one.
    bool all_groups = false;
};

/// Write hexahedra and skin with a named physical group for every entity, whole or not at all: the file is
/// written beside its place and renamed.
/// @throw InvalidInput  the folder does not exist, the version is unknown, as `check_fields()` and
///                      `layer_parts()`; "io.partition_version"  parts of another version than 4.1.
/// @throw BackendError  the disk is full or the file cannot be written; nothing is left behind.
void write_msh(const mesh::HexMesh& mesh, const OutputPath& path, const MshOptions& options = {},
               const RunContext& context = {});

/// Write the options that Gmsh reads with a mesh when they lie beside it as "<mesh>.msh.opt": faces and sides
/// of cells, a colour a physical group. The file says in words what it does.
/// @throw  as `WholeFile`.
void write_msh_options(const OutputPath& path);

} // namespace lacuna::io
