// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/io/deck.h>
#include <lacuna/io/formats.h>
#include <lacuna/io/partition.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/mesh_part.h>
#include <lacuna/topology/model.h>

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace lacuna::io {

struct MeshDeckOptions {
    DeckFormat format = DeckFormat::abaqus; ///< nastran, abaqus, unv, msh, vtk, vtu or exodus
    /// Of Abaqus: the word for hexahedra of as many nodes, in capitals; empty: C3D8, of order 2 C3D20.
    std::string element{};
    DeckTag first_node = 0; ///< number of the first new node; 0: above all that are taken, from 1
    DeckTag first_cell = 0; ///< of the first hexahedron; 0: likewise
    /// Of the hexahedra: a name or number that the deck they join has, in any capitals; empty: that of the
    /// elements beside the void, where the deck says it.
    std::string material{};
};

/// A swept mesh as a deck of a format. Hexahedra are one region, named by the first of the volume's groups,
/// which is property 1. Groups of the skin are sets:
///
/// | format | a group is |
/// |---|---|
/// | abaqus | a set of nodes, one of the cells behind the faces, and a surface of their sides |
/// | exodus | a set of nodes and one of sides |
/// | nastran | a set of nodes |
/// | unv, msh, vtk, vtu | a set of quads, which are elements behind the hexahedra |
///
/// Abaqus's names have letters, digits, - and _ : others become _ .
/// @throw InvalidInput "io.element"       `element` is no hexahedron of as many nodes as the mesh's.
///                     "io.no_such_element"  the mesh is of hex27, which Nastran, Abaqus and UNV have not.
///                     "io.number_taken"  a first number is below 1, or the last would be too high.
/// @note  O(nodes + cells).
Deck deck_of(const mesh::HexMesh& mesh, const MeshDeckOptions& options, const RunContext& context = {});

/// The same of several swept meshes that have nodes in common: a region each, groups named as theirs.
/// @param interfaces  where groups are sets of quads: quads that two of the meshes have are elements too, one
///                    for both. Else the quads are the skin of the whole.
/// @throw  as `deck_of()`.
Deck deck_of(std::span<const mesh::MeshPart> parts, const MeshDeckOptions& options, bool interfaces = false,
             const RunContext& context = {});

/// Places of sets in a deck, by their kind and the group that they hold.
using GroupSets = std::map<std::pair<DeckSet::Kind, std::string>, std::size_t>;

/// What meshes that joined a deck one after the other have put there.
struct JoinedBefore {
    GroupSets sets{};                       ///< theirs
    std::map<std::string, Index> regions{}; ///< theirs, by the names of their meshes'
};

/// A deck and the mesh that fills a void of it as one conformal mesh. What the deck has keeps its numbers; a
/// node of the skin that lies on a node of the deck is that node, a middle node that of the side.
///
/// Groups of the skin are sets as in `deck_of()`, of nodes in UNV too. The new region has the property above
/// all others. Where nodes of the deck coincide, the skin takes the one of the elements whose face, else
/// whose side, it shares.
///
/// The region's material goes into a card of its own where the format is the deck's: a PSOLID in Nastran, a
/// *SOLID SECTION before the first *STEP in Abaqus, unless the deck has a section of that set already. Where
/// it is not said it is that of the region with most faces on the mesh, and the log says so; where that has
/// none, Nastran's PSOLID names material 1 and Abaqus gets no section.
/// Where `deck` lacks what `leave_out()` took from it, a mesh called as a region it emptied takes its place:
/// its number, its sets, its sections and properties, whose cards then say the material.
/// @param model    the deck's faces, which the patches of the mesh name by their tags.
/// @param scale    of the model's coordinates to the deck's [-].
/// @param options  `format` is the one it will be written in.
/// @param gone     `LeftOut::gone`, where the model was made of the deck with it; its faces are let go.
/// @param before   of the meshes that joined it before: one of the same region is more of it, and groups of
///                 one name are one set. Out: of this one too. Null: there are none.
/// @throw InvalidInput "io.not_conformal"  a face of the deck whose quads the mesh has not; with counts.
///                     "io.nodes_coincide" elements beside the void use both of two coincident nodes; names
///                                         both.
///                     "io.other_model"    a patch is of no face of the model.
///                     "io.no_material"    the deck has no material called `material`; lists those it has.
///                     "io.mixed_order"    elements beside the void are of another order than the mesh, or
///                                         have nodes in the middle of quads where it has none.
///                     as `deck_of()`.
/// @note  O(n log n) in the nodes of the deck; a copy of the deck is made.
Deck join_deck(const Deck& deck, const topology::Model& model, double scale, const mesh::HexMesh& mesh,
               const MeshDeckOptions& options, const RunContext& context = {}, const Deck* gone = nullptr,
               JoinedBefore* before = nullptr);

/// A deck of a format whose faces of solids are elements, MSH, VTK or Medit, for one where such elements
/// would be shells, Abaqus, Nastran or Exodus: instead of those that lie on solids it has sets of nodes and
/// of sides, called as the sets they are in, else as their region, else by its number, `surface:3`. All
/// others as they are.
/// @note  O(n log n) in the elements of two dimensions, O(n) in the solids.
Deck skin_as_sets(Deck deck, DeckFormat format);

struct DeckInScale {
    const Deck* deck = nullptr; ///< read, not kept
    double scale = 1;           ///< of the coordinates it is used in to its own [-]
};
struct MergeOptions {
    /// Where decks have numbers, sets or materials in common, those of the later one get numbers and names of
    /// their own, and its cards, which name the old ones, stay behind; otherwise that is refused.
    bool renumber = false;
};

/// Several decks as one, in the coordinates and the format of the first.
///
/// Cards of decks of the same format go along; before the steps of the first, where it has any; the steps of
/// the others and what stands before their bulk data do not. Nodes that coincide stay apart. The log says
/// what is left out.
/// @throw InvalidInput "io.numbers_clash"  a node, element, property, set or material of two decks; names it.
/// @note  O(n log n).
Deck merge_decks(std::span<const DeckInScale> decks, const MergeOptions& options = {},
                 const RunContext& context = {});

struct DeckFileOptions {
    bool binary = true;                       ///< of .msh and .vtk
    double msh_version = 4.1;                 ///< or 2.2
    const DeckPartition* partition = nullptr; ///< of .msh 4.1: which part elements are of; null: they are one
    bool all_groups = false;                  ///< of .msh: as `MeshFileOptions::all_groups`
};

/// Write a deck as Nastran bulk data, Abaqus input, a universal file, an Exodus file, or for Gmsh or VTK:
/// whole or not at all.
///
/// Numbers, sets and words of elements stay; text of the same format goes along verbatim. Coordinates are in
/// the basic frame, as near as the format can say them: 16 characters in Nastran (11 to 15 digits), 20 in
/// Abaqus (CalculiX reads no more; 14 to 17 digits), 17 digits in UNV. Another format than the deck's gets
/// nodes, elements, regions and sets; the log says what is left out.
///
/// Exodus has a block of each region and shape, sets of nodes, elements and sides, and numbers as maps.
/// In .msh a region is a physical group, and a set of elements where these have no region; with `all_groups`
/// all regions and sets of elements are. In .vtk and .vtu elements that are in the same
/// region and sets are an entity; cell arrays hold its number, the region's and the cell's, a point array the
/// node's, and arrays of the whole file, called as the sets and regions are, list the entities of each. Sets
/// of nodes are such arrays too, "nodes:" before their names, with places of points from 0.
/// @throw InvalidInput "io.no_such_element"  the format has no such element, or none without middle nodes.
///                     "io.folder" and the like as `WholeFile`.
/// @throw BackendError  as `WholeFile`.
void write_deck(const Deck& deck, const Format& format, const OutputPath& path,
                const RunContext& context = {}, const DeckFileOptions& options = {});
void write_deck(const Deck& deck, DeckFormat format, const OutputPath& path, const RunContext& context = {},
                const DeckFileOptions& options = {});

/// Write the parts of a deck as pieces, as `write_mesh()` does, with the arrays of its VTU file.
/// @throw  as `write_deck()`
void write_pvtu(const Deck& deck, const DeckPartition& partition, int ghosts, const OutputPath& path,
                const RunContext& context = {});

} // namespace lacuna::io
