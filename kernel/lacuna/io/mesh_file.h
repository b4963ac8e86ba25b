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
    /// Divide the mesh into parts, which are ranges of layers: the pieces of a .pvtu, or $PartitionedEntities
    /// and $GhostElements in an .msh of version 4.1. Nodes and elements keep the numbers of the undivided
    /// file.
    PartitionOptions partition{};
    /// .msh only: write each cell into all its groups, which then overlap. Otherwise each cell is in one
    /// group, as needed by solvers that allow a single mark per cell. Version 2.2 always writes one group.
    bool all_groups = false;
    /// For several meshes, in formats that store the skin as elements: also write quads that two meshes
    /// share.
    bool interfaces = false;
    std::string unit{}; ///< declared unit of the lengths, a name that `metres_of()` knows; empty: that of the
                        ///< deck, or none
    /// Write the directions of cells (`mesh::cell_frames()`). In VTK and Exodus they are the fields "column",
    /// "axis", "radial" and "tangential". Other formats get the axes of `CellFrame::material()`: Abaqus as a
    /// distribution and an orientation for each region, Nastran as coordinate systems and MATCID cards, FEBio
    /// as `mat_axis`. The meshes must store their nodes.
    bool orientation = false;
    /// If a deck is written, `orientation` applies to these meshes. For each shape, their cells must be the
    /// first in the deck.
    std::vector<const mesh::HexMesh*> oriented{};
    /// Nodes of periodic faces. They are written as $Periodic in .msh, as equations or a cyclic symmetry in
    /// Abaqus, as multipoint constraints in Nastran, and elsewhere as two sets of nodes in the order of the
    /// pairs.
    std::vector<mesh::PeriodicNodes> periodic{};
};

/// Write hexahedra, wedges and their skin, with a group for each entity. The file is complete or does not
/// appear.
///
/// In decks the hexahedra form one region, which has the name of the volume's first group and property 1. A
/// group of the skin is
///
/// | format | a group is |
/// |---|---|
/// | Abaqus | a set of nodes, a set of the cells behind the faces, and a surface of the faces |
/// | Exodus | a set of nodes and a set of sides |
/// | Nastran | a set of nodes |
/// | UNV | a set of quads, which are elements that follow the hexahedra |
///
/// Names in Abaqus consist of letters, digits, - and _ . Other characters are replaced by _ .
///
/// In VTK the cell array "entity" holds the tag of the skin patch, and 0 for solids. For each group, a field
/// array of the group's name lists its entities. A file "mesh.pvtu" refers to its pieces "mesh_0.vtu",
/// "mesh_1.vtu" … in the same folder. Pieces have the arrays of a .vtu, and also `node_number` and
/// `cell_number`: the positions in the undivided file, from 1. Nodes on the interface of two pieces are in
/// both. A quad of the skin is in the piece of its cell. With ghosts, `vtkGhostType` is 1 for cells of other
/// pieces and for points that another piece owns.
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

/// `write_mesh()` for a mesh whose nodes are computed during writing. The file has the same bytes as if they
/// were stored. Except for the skin, memory does not depend on the number of layers. For Exodus, nodes are
/// computed three times, because x, y and z are stored in separate arrays.
/// @param options  without fields, which are given separately.
/// @param team  processes that share the work: each writes its share of the file, or some of the pieces, to
///              the path of rank 0; null: this process works alone.
/// @pre  the format is streamed
void write_mesh(const Format& format, const mesh::LayeredMesh& layered, const OutputPath& path,
                const MeshFileOptions& options = {}, const MeshDeckOptions& deck = {},
                const std::vector<LayeredField>& fields = {}, const RunContext& context = {},
                const Team* team = nullptr);

/// `write_mesh()` for several meshes with shared nodes, stored or not. There is one region for each name,
/// with groups named like those of the meshes. If there are at least as many volumes as parts, a partition
/// assigns whole volumes to parts so that numbers of cells are as even as possible. Otherwise each volume is
/// divided by its layers into one or several parts. Quads belong to the part of their cell.
/// @pre  there is at least one part.
/// @param options  without fields
/// @param team  processes that each write their share of the file; each process must have all meshes.
void write_parts(const Format& format, std::span<const mesh::LayeredPart> parts, const OutputPath& path,
                 const MeshFileOptions& options = {}, const MeshDeckOptions& deck = {},
                 const RunContext& context = {}, const Team* team = nullptr);

/// Write a deck as Nastran bulk data, Abaqus input, a universal file, an Exodus file, or for Gmsh or VTK. The
/// file is complete or does not appear.
///
/// Numbers, sets and element types are kept. Text is copied verbatim if the format stays the same.
/// Coordinates are in the basic frame and as accurate as the format allows: 16 characters in Nastran (11 to
/// 15 digits), 20 in Abaqus (14 to 17 digits; CalculiX reads no more), 17 digits in UNV. A file of another
/// format than the deck's contains nodes, elements, regions and sets; the log lists omitted content.
///
/// Exodus has a block for each region and shape; sets of nodes, elements and sides; and number maps. In .msh,
/// a physical group is written for each region, and for each set of elements without a region; with
/// `all_groups`, for every element set. In .vtk and .vtu, elements that are in the same region and sets form
/// an entity. Cell arrays hold the numbers of entity, region and cell; a point array holds the node numbers.
/// For each set and region, an array of the whole file lists its entities, under its name. Node sets are such
/// arrays too: their names start with "nodes:", and they list point indices from 0.
/// @throw InvalidInput "io.no_such_element"  the format lacks an element type, or needs middle nodes that are
///                     missing; "io.no_folder" and others as `WholeFile`.
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
