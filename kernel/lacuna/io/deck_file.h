// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/io/deck.h>
#include <lacuna/io/formats.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/mesh/hex_mesh.h>
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
    /// For Abaqus: the element type for hexahedra with this number of nodes, in capitals; empty: C3D8, at
    /// order 2 C3D20.
    std::string element{};
    DeckTag first_node = 0; ///< number of the first new node; 0: above all used numbers, from 1
    DeckTag first_cell = 0; ///< number of the first hexahedron; 0: likewise
    /// Material of the hexahedra: a name or number in the deck that they join, in any case; empty: that of
    /// the elements next to the void, if the deck gives it.
    std::string material{};
    /// Of meshes with shared nodes: written as *TIE and *CONTACT PAIR in Abaqus, as BSURFS with BGSET and
    /// BCTSET in Nastran. In other formats only the groups of their faces are written, and a note says so.
    std::vector<mesh::ContactPair> contacts{};
};

/// Indices of sets in a deck, by their kind and the group that they hold.
using GroupSets = std::map<std::pair<DeckSet::Kind, std::string>, std::size_t>;

/// Sets and regions of meshes that joined a deck earlier.
struct JoinedBefore {
    GroupSets sets{};                       ///< sets of their groups
    std::map<std::string, Index> regions{}; ///< regions, by the names of their meshes
};

/// Combine a deck with the mesh that fills a void of it into one conformal mesh. The deck keeps its numbers.
/// A skin node that coincides with a node of the deck is that node; middle nodes are those of the deck's
/// sides.
///
/// Groups of the skin become sets as in `write_mesh()`, of nodes in UNV too. The new region gets the next
/// property above all others. Where nodes of the deck coincide, the skin uses the node of the elements whose
/// face it shares or, failing that, whose side.
///
/// The region's material is written as a card if the format is the deck's: a PSOLID in Nastran, a *SOLID
/// SECTION before the first *STEP in Abaqus, unless the deck already has a section for that set. By default
/// the material is that of the region with most faces on the mesh, and the log says so; if it has none,
/// Nastran's PSOLID names material 1 and Abaqus gets no section.
/// If `deck` lacks parts removed by `leave_out()`, a mesh named like a region that this emptied replaces it:
/// it takes its number, sets, sections and properties, and the material from their cards.
/// @param model    the deck's faces, which the patches of the mesh name by their tags.
/// @param scale    of the model's coordinates to the deck's [-].
/// @param options  `format` is that of the file to be written.
/// @param gone     `LeftOut::gone` if the model was made from the deck including these elements; their faces
///                 are not required.
/// @param before   data of meshes that joined earlier: a mesh of the same region extends it, and groups with
///                 equal names become one set. Updated with this mesh. Null: there are none.
/// @throw InvalidInput "io.not_conformal"  a face of the deck whose quads the mesh lacks; with counts.
///                     "io.nodes_coincide" elements next to the void use both of two coincident nodes; names
///                                         both.
///                     "io.other_model"    a patch belongs to no face of the model.
///                     "io.no_material"    the deck has no material named `material`; lists its materials.
///                     "io.mixed_order"    elements next to the void have another order than the mesh, or
///                                         nodes in the middle of quads where it has none.
///                     "io.element", "io.no_such_element", "io.number_taken"  as `write_mesh()`.
/// @note  O(n log n) in the nodes of the deck; a copy of the deck is made.
Deck join_deck(const Deck& deck, const topology::Model& model, double scale, const mesh::HexMesh& mesh,
               const MeshDeckOptions& options, const RunContext& context = {}, const Deck* gone = nullptr,
               JoinedBefore* before = nullptr);

/// Convert a deck of a format in which faces of solids are elements (MSH, VTK, Medit) for a format in which
/// these would be shells (Abaqus, Nastran, Exodus). Elements on faces of solids are replaced by sets of nodes
/// and of sides, named after their sets, otherwise after their region or its number, `surface:3`. Other
/// elements are unchanged.
/// @note  O(n log n) in the elements of two dimensions, O(n) in the solids.
Deck skin_as_sets(Deck deck, DeckFormat format);

struct DeckInScale {
    const Deck* deck = nullptr; ///< read, not kept
    double scale = 1;           ///< factor from its own coordinates to those in use [-]
};
struct MergeOptions {
    /// If decks share numbers, sets or materials, give those of the later deck new numbers and names, and
    /// drop its cards, which refer to the old ones. Otherwise this is refused.
    bool renumber = false;
};

/// Merge several decks into one, in the coordinates and the format of the first.
///
/// Cards of decks of the same format are copied, before the first step of the first deck; steps of the other
/// decks, and text before their bulk data, are not. Coincident nodes stay separate. The log lists omitted
/// content.
/// @throw InvalidInput "io.numbers_clash"  a node, element, property, set or material of two decks; names it.
/// @note  O(n log n).
Deck merge_decks(std::span<const DeckInScale> decks, const MergeOptions& options = {},
                 const RunContext& context = {});

} // namespace lacuna::io
