// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/io/deck.h>
#include <lacuna/io/formats.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/topology/model.h>

#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace lacuna::io {

/// A set of nodes of a swept mesh: all nodes of the columns over the given nodes of the first level.
struct ColumnSet {
    std::string name;
    std::vector<Index> nodes{}; ///< < `HexMesh::nodes_per_layer`, rising
    std::size_t part = 0;       ///< number of the mesh among those that are written together
};

struct MeshDeckOptions {
    DeckFormat format = DeckFormat::abaqus; ///< format of the file: nastran, abaqus, unv, msh, vtk, vtu or
                                            ///< exodus
    /// For Abaqus: the element type of the hexahedra, in capitals. It must have as many nodes as the
    /// hexahedra. Empty: C3D8, at order 2 C3D20.
    std::string element{};
    DeckTag first_node = 0; ///< number of the first new node; 0: above all used numbers, from 1
    DeckTag first_cell = 0; ///< number of the first hexahedron; 0: above all used numbers, from 1
    /// Material of the hexahedra: a name, in upper or lower case, or a number in the deck that they join.
    /// Empty: the material of the elements next to the void, if the deck gives it.
    std::string material{};
    /// Contacts of meshes with shared nodes. Formats with `Format::has_contacts` store them. In other formats
    /// only the groups of their faces are written, and a note says so.
    std::vector<mesh::ContactPair> contacts{};
    std::vector<ColumnSet> columns{}; ///< sets of nodes besides the groups
};

/// Indices of sets in a deck, by the kind of the set and the group that it holds.
using GroupSets = std::map<std::pair<DeckSet::Kind, std::string>, std::size_t>;

/// An index of the first `counted` sets of a deck by their names in capitals, and the highest tag of these
/// sets.
struct SetNames {
    std::size_t counted = 0;
    std::unordered_map<std::string, std::vector<std::size_t>> sets{}; ///< ascending indices
    int highest_tag = 0;
};

/// Entities of a deck that come from meshes joined to it earlier.
struct JoinedBefore {
    GroupSets sets{};                       ///< sets of the meshes' groups
    SetNames names{};                       ///< all sets of the deck
    std::map<std::string, Index> regions{}; ///< regions, by the names of the meshes
    std::size_t meshes = 0;                 ///< number of meshes that were added
    /// The number of each node of the next mesh among the nodes of all meshes that join a deck of a file.
    /// Null: meshes share no nodes.
    std::function<Index(Index node)> number{};
    std::vector<Index> points{}; ///< by this number: the deck's point; -1: none yet
    std::size_t of_file = 0;     ///< number of points of the deck before the first mesh
};

/// Combine a deck with the mesh that fills one of its voids into one conformal mesh. The deck keeps its
/// numbers. Where a node of the mesh's skin coincides with a node of the deck, corner or middle, the deck's
/// node is used. Nodes of meshes that joined before are shared only where `JoinedBefore::number` says so.
///
/// Groups of the skin become sets as in `write_mesh()`; in UNV, sets of nodes. The new region gets the number
/// after the highest property. If several nodes of the deck coincide, the skin uses the node of the elements
/// with which it shares a face or, if there are none, an edge of a face.
///
/// If the file has the deck's format, a card gives the region its material: a PSOLID in Nastran, a *SOLID
/// SECTION before the first *STEP in Abaqus. There is no card if the deck already has a section for the set.
/// By default the material is that of the region with the most faces on the mesh, among the regions that have
/// a material, and the log says so. If no such region touches the mesh, Nastran's PSOLID names material 1,
/// and Abaqus gets no section.
/// If `leave_out()` removed parts from `deck` and thereby emptied a region, a mesh of the same name replaces
/// that region. It takes over the region's number, sets, sections and properties, and the material from their
/// cards.
/// @param model    faces of the deck; patches of the mesh name them by their tags.
/// @param scale    factor from the model's coordinates to the deck's [-].
/// @param options  `format` is that of the file to be written.
/// @param gone     if elements were left out of the deck after the model was made: `LeftOut::gone`. The mesh
///                 need not match the faces of these elements.
/// @param before   data of meshes that joined earlier; updated with this mesh. A mesh of the same region
///                 extends that region, and groups with equal names become one set. Null: there are none.
/// @throw InvalidInput "io.not_conformal"  the mesh lacks quads of a face of the deck, or lies on a face with
///                                         other quads; gives counts.
///                     "io.nodes_coincide" elements next to the void use both of two coincident nodes; names
///                                         both.
///                     "io.other_model"    a patch belongs to no face of the model.
///                     "io.no_material"    the deck has no material named `material`; lists its materials.
///                     "io.mixed_order"    elements next to the void have another order than the mesh, or
///                                         nodes in the middle of quads where the mesh has none.
///                     "io.element", "io.no_such_element", "io.number_taken"  as `write_mesh()`.
/// @note  O(n log n) in the nodes of the deck; a copy of the deck is made.
Deck join_deck(const Deck& deck, const topology::Model& model, double scale, const mesh::HexMesh& mesh,
               const MeshDeckOptions& options, const RunContext& context = {}, const Deck* gone = nullptr,
               JoinedBefore* before = nullptr);

/// Convert a deck of a format in which faces of solids are elements (MSH, VTK, Medit) to a format in which
/// such elements would be shells (Abaqus, Nastran, Exodus). Elements on faces of solids become sets of nodes
/// and, except in Nastran, sets of sides. The sets of an element keep their names. An element in no set goes
/// to sets with the name of its region or, if the region has none, with the region's number: `surface:3`.
/// Other elements are unchanged.
/// @note  O(n log n) in the two-dimensional elements, O(n) in the solids.
Deck skin_as_sets(Deck deck, DeckFormat format);

struct DeckInScale {
    const Deck* deck = nullptr; ///< read, not kept
    double scale = 1;           ///< factor from its own coordinates to those in use [-]
};
struct MergeOptions {
    /// If decks share numbers, sets or materials: give those of the later deck new numbers and names, and
    /// drop its cards, which refer to the old ones. Otherwise such decks are refused.
    bool renumber = false;
};

/// Merge several decks into one, in the coordinates and the format of the first.
///
/// Cards of later decks of the same format are inserted before the first step of the first deck. The steps of
/// later decks and their text before the bulk data are omitted, and the log lists omitted content. Coincident
/// nodes stay separate.
/// @throw InvalidInput "io.numbers_clash"  two decks have the same node, element, property, set or material;
///        names it.
/// @note  O(n log n).
Deck merge_decks(std::span<const DeckInScale> decks, const MergeOptions& options = {},
                 const RunContext& context = {});

} // namespace lacuna::io
