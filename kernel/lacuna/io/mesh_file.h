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

/// Options for writing a mesh or deck. Options that the format does not support are ignored.
struct MeshFileOptions {
    bool binary = true;              ///< .msh and .vtk only
    double version = 4.1;            ///< .msh only: 4.1, or 2.2 for readers without 4.1
    std::vector<CellField> fields{}; ///< each is written as a cell array; in .msh as $ElementData
    /// Ranges of layers as parts: the pieces of a .pvtu, or $PartitionedEntities and $GhostElements in an
    /// .msh of version 4.1. Nodes and elements keep the numbers of the file without parts.
    PartitionOptions partition{};
    /// .msh only: write cells into all their groups, which then overlap. Otherwise each cell is in one group,
    /// as solvers with a single mark per cell require. Version 2.2 always writes one.
    bool all_groups = false;
    /// Of several meshes, in formats where the skin is elements: quads shared by two of them are written too.
    bool interfaces = false;
    std::string unit{}; ///< declared unit of the lengths, as `metres_of()`; empty: that of the deck, or none
    /// Directions of cells (`mesh::cell_frames()`): fields "column", "axis", "radial" and "tangential" in VTK
    /// and Exodus; in Abaqus a distribution and an orientation for each region, in Nastran coordinate systems
    /// and MATCID cards, in FEBio `mat_axis`, with the axes of `CellFrame::material()`. Needs meshes that
    /// store their nodes.
    bool orientation = false;
    /// The same of decks: the meshes whose cells are the first of their shapes in the deck.
    std::vector<const mesh::HexMesh*> oriented{};
    /// Nodes of periodic faces, written as $Periodic in .msh, as equations or a cyclic symmetry in Abaqus, as
    /// multipoint constraints in Nastran, and as two sets of nodes in the order of the pairs elsewhere.
    std::vector<mesh::PeriodicNodes> periodic{};
};

/// Write hexahedra, wedges and their skin, with a group for each entity: the complete file or none.
///
/// In decks the hexahedra form one region, named after the first of the volume's groups, with property 1; a
/// group of the skin is
///
/// | format | a group is |
/// |---|---|
/// | Abaqus | a set of nodes, one of the cells behind the faces, and a surface of their sides |
/// | Exodus | a set of nodes and one of sides |
/// | Nastran | a set of nodes |
/// | UNV | a set of quads, which are elements behind the hexahedra |
///
/// Names in Abaqus consist of letters, digits, - and _ : other characters become _ .
///
/// In VTK the cell array "entity" holds the tag of the skin patch, and 0 for solids. A field array
/// for each group, with the name of the group, lists its entities. A .pvtu "mesh.pvtu" refers to its pieces
/// "mesh_0.vtu", "mesh_1.vtu" … in the same folder. These have the arrays of a .vtu, and `node_number` and
/// `cell_number`: the positions in the unpartitioned file, from 1. Nodes on the interface of two pieces are
/// in both; a quad of the skin is in the piece of its cell. With ghosts, `vtkGhostType` is 1 for cells of
/// other pieces and for points that another piece owns.
/// @param deck  options for formats that are decks, with the material; `deck.format` is ignored.
/// @throw InvalidInput  the folder does not exist, a skin quad belongs to no patch, the version is unknown,
///                      as `check_fields()` and `layer_parts()`; "io.partition_version"  parts of another
///                      version than 4.1; "io.element"  `deck.element` is not a hexahedron with as many
///                      nodes as the mesh's; "io.no_such_element"  the mesh is of hex27, which Nastran,
///                      Abaqus and UNV do not have; "io.number_taken"  a first number is below 1, or the
///                      last would be too high.
/// @throw BackendError  the disk is full or the file cannot be written; nothing is left behind.
void write_mesh(const Format& format, const mesh::HexMesh& mesh, const OutputPath& path,
                const MeshFileOptions& options = {}, const MeshDeckOptions& deck = {},
                const RunContext& context = {});

/// A `CellField` whose values are computed for some layers at a time.
struct LayeredField {
    std::string name; ///< no quotes, no line ends
    /// The values of the cells in the layers [first, last), by cell number; must not differ between calls.
    std::function<std::vector<double>(int first, int last)> values;
};

/// The same for a mesh whose nodes are created while they are written. The bytes are the same; memory does
/// not depend on the number of layers, apart from that for the skin. Exodus stores x, y and z in separate
/// arrays, so nodes are computed three times.
/// @param options  without fields; these are given separately.
/// @param team  processes that each write their share of the file, or some of the pieces, to the path of rank
///              0; null: this process alone.
/// @pre  the format is streamed
void write_mesh(const Format& format, const mesh::LayeredMesh& layered, const OutputPath& path,
                const MeshFileOptions& options = {}, const MeshDeckOptions& deck = {},
                const std::vector<LayeredField>& fields = {}, const RunContext& context = {},
                const Team* team = nullptr);

/// The same for several meshes with shared nodes, stored or not: one region for each name, with groups named
/// like those of the meshes. With a partition, whole volumes are parts, with numbers of cells as even as
/// possible, if there are at least as many volumes as parts; otherwise each volume is one or several parts by
/// its layers. Quads belong to the part of their cell.
/// @pre  there is at least one part.
/// @param options  without fields
/// @param team  processes that each write their share of the file; each must have all parts.
void write_parts(const Format& format, std::span<const mesh::LayeredPart> parts, const OutputPath& path,
                 const MeshFileOptions& options = {}, const MeshDeckOptions& deck = {},
                 const RunContext& context = {}, const Team* team = nullptr);

/// Write a deck as Nastran bulk data, Abaqus input, a universal file, an Exodus file, or for Gmsh or VTK: the
/// complete file or none.
///
/// Numbers, sets and element types are kept; text of the same format is copied verbatim. Coordinates are in
/// the basic frame, as accurate as the format allows: 16 characters in Nastran (11 to 15 digits), 20 in
/// Abaqus (CalculiX reads no more; 14 to 17 digits), 17 digits in UNV. Another format than the deck's gets
/// nodes, elements, regions and sets; the log lists omitted content.
///
/// Exodus has a block for each region and shape; sets of nodes, elements and sides; and number maps. In .msh,
/// a region is a physical group; a set of elements is one if these have no region, and with `all_groups` all
/// regions and element sets are. In .vtk and .vtu, the elements of the same region and sets form an entity.
/// Cell arrays hold the numbers of the entity, of the region and of the cell; a point array holds the node
/// numbers. Arrays of the whole file, with the names of the sets and regions, list the entities of each; node
/// sets are such arrays too, with "nodes:" before their names and point indices from 0.
/// @throw InvalidInput "io.no_such_element"  the format lacks an element type, or requires middle nodes.
/// "io.no_folder" and others as `WholeFile`.
/// @throw BackendError  as `WholeFile`.
void write_deck(const Deck& deck, const Format& format, const OutputPath& path,
                const RunContext& context = {}, const MeshFileOptions& options = {});
void write_deck(const Deck& deck, DeckFormat format, const OutputPath& path, const RunContext& context = {},
                const MeshFileOptions& options = {});

/// `write_mesh()` for Gmsh.
inline void write_msh(const mesh::HexMesh& mesh, const OutputPath& path, const MeshFileOptions& options = {},
                      const RunContext& context = {})
{
    write_mesh(format_of(DeckFormat::msh), mesh, path, options, {}, context);
}

/// Write the options that Gmsh reads with a mesh if they are next to it as "<mesh>.msh.opt": show faces and
/// sides of cells, one colour for each physical group. Comments in the file explain its effect.
/// @throw  as `WholeFile`.
void write_msh_options(const OutputPath& path);

} // namespace lacuna::io
