// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/team.h>
#include <lacuna/io/deck_file.h>
#include <lacuna/io/msh.h>
#include <lacuna/io/vtk.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/mesh/mesh_part.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::io {

/// A `CellField` whose values are made some layers at a time.
struct LayeredField {
    std::string name; ///< no quotes, no line ends
    /// Of the cells of layers [first, last), by their numbers; the same each time.
    std::function<std::vector<double>(int first, int last)> values;
};

/// `write_msh()`, `write_vtu()` and `write_vtk()` of a mesh whose nodes are made as they are written: the
/// same bytes, in memory that does not depend on the number of layers but for what the skin takes.
/// @param options  without fields; they are given by themselves.
/// @param team  who each write their share of it, to rank 0's path; null: this process alone.
/// @throw  as those.
void write_msh(const mesh::LayeredMesh& layered, const OutputPath& path, const MshOptions& options = {},
               const std::vector<LayeredField>& fields = {}, const RunContext& context = {},
               const Team* team = nullptr);
void write_vtu(const mesh::LayeredMesh& layered, const OutputPath& path,
               const std::vector<LayeredField>& fields = {}, const RunContext& context = {},
               const Team* team = nullptr);
/// @param team  who each write some of the pieces.
void write_pvtu(const mesh::LayeredMesh& layered, const OutputPath& path, const PartitionOptions& partition,
                const std::vector<LayeredField>& fields = {}, const RunContext& context = {},
                const Team* team = nullptr);
void write_vtk(const mesh::LayeredMesh& layered, const OutputPath& path, const VtkOptions& options = {},
               const std::vector<LayeredField>& fields = {}, const RunContext& context = {},
               const Team* team = nullptr);

/// Whether decks of a format are written so: Nastran's, Abaqus's, Exodus and universal files. Exodus has the
/// coordinates one after the other, so nodes are made three times.
bool is_layered(DeckFormat format);
/// `write_deck()` of `deck_of()` the mesh, numbered from 1, in such a format: the same bytes, and memory as
/// above.
/// @param options  without first numbers.
/// @pre  is_layered()
void write_deck(const mesh::LayeredMesh& layered, const MeshDeckOptions& options, const OutputPath& path,
                const RunContext& context = {}, const Team* team = nullptr);

/// Whether decks of several meshes are written so: all of those but Exodus, and .msh, .vtu and .vtk.
bool is_layered_of_parts(DeckFormat format);
/// `write_deck()` of `deck_of()` several meshes with nodes in common, in such a format: the same bytes, and
/// memory as above. Parts may hold their nodes.
/// @param team  who each write their share of it; then each has all parts.
/// @pre  is_layered_of_parts(), without a partition, and the meshes are of order 1.
void write_parts(std::span<const mesh::LayeredPart> parts, DeckFormat format, const DeckFileOptions& file,
                 const OutputPath& path, const RunContext& context = {}, const Team* team = nullptr);

} // namespace lacuna::io
