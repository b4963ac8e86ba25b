// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/io/cell_field.h>
#include <lacuna/io/deck_file.h>
#include <lacuna/io/formats.h>
#include <lacuna/io/partition.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/mesh/mesh_part.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace lacuna {
struct Team;
}

namespace lacuna::io {

/// How a mesh is written. What a format has not is not looked at.
struct MeshFileOptions {
    bool binary = true;              ///< of .msh and .vtk
    double version = 4.1;            ///< of .msh: 4.1, or 2.2 for readers that know no other
    std::vector<CellField> fields{}; ///< each becomes a cell array; in .msh $ElementData
    /// Ranges of layers: pieces of a .pvtu; in an .msh of version 4.1 $PartitionedEntities, and
    /// $GhostElements. Nodes and elements have the numbers that they have without.
    PartitionOptions partition{};
    /// Of .msh: surfaces and cells are in all their groups, which overlap; else in one each, as solvers want
    /// it that know one mark a cell. Version 2.2 holds no more than one.
    bool all_groups = false;
};

/// Write hexahedra, wedges and their skin, with a group for every entity: whole or not at all. Decks are
/// `write_deck()` of `deck_of()` the mesh.
///
/// In VTK the cell array "entity" holds the tag of the skin patch, 0 for solids; arrays of the whole file
/// called as the groups list the entities of each. Of a .pvtu the pieces are "mesh_0.vtu", "mesh_1.vtu" …
/// beside "mesh.pvtu", which names them: with the arrays of a .vtu, and `node_number` and `cell_number`,
/// places in the file of the whole, from 1. Nodes between two pieces are in both; a quad of the skin is in
/// the piece of its cell. With ghosts, `vtkGhostType` is 1 for cells of other pieces, and for points that
/// another piece owns.
/// @param deck  of formats that are decks, and its material; its format is not looked at.
/// @throw InvalidInput  the folder does not exist, a skin quad belongs to no patch, the version is unknown,
///                      as `check_fields()`, `layer_parts()` and `deck_of()`; "io.partition_version"  parts
///                      of another version than 4.1.
/// @throw BackendError  the disk is full or the file cannot be written; nothing is left behind.
void write_mesh(const Format& format, const mesh::HexMesh& mesh, const OutputPath& path,
                const MeshFileOptions& options = {}, const MeshDeckOptions& deck = {},
                const RunContext& context = {});

/// A `CellField` whose values are made some layers at a time.
struct LayeredField {
    std::string name; ///< no quotes, no line ends
    /// Of the cells of layers [first, last), by their numbers; the same each time.
    std::function<std::vector<double>(int first, int last)> values;
};

/// The same of a mesh whose nodes are made as they are written: the same bytes, in memory that does not
/// depend on the number of layers but for what the skin takes. Exodus has the coordinates one after the
/// other, so nodes are made three times.
/// @param options  without fields; they are given by themselves.
/// @param deck     without first numbers.
/// @param team  who each write their share of it, or some of the pieces, to rank 0's path; null: this process
///              alone.
/// @pre  the format is streamed
void write_mesh(const Format& format, const mesh::LayeredMesh& layered, const OutputPath& path,
                const MeshFileOptions& options = {}, const MeshDeckOptions& deck = {},
                const std::vector<LayeredField>& fields = {}, const RunContext& context = {},
                const Team* team = nullptr);

/// `write_deck()` of `deck_of()` several meshes with nodes in common: the same bytes, and memory as above.
/// Parts may hold their nodes.
/// @param team  who each write their share of it; then each has all parts.
/// @pre  parts of the format are streamed, without a partition, and the meshes are of order 1.
void write_parts(const Format& format, std::span<const mesh::LayeredPart> parts, const OutputPath& path,
                 const DeckFileOptions& file = {}, const RunContext& context = {},
                 const Team* team = nullptr);

} // namespace lacuna::io
