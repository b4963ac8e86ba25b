// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/io/deck.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/topology/model.h>

#include <string>
#include <string_view>

namespace lacuna::io {

struct MeshDeckOptions {
    DeckFormat format = DeckFormat::abaqus; ///< nastran, abaqus or unv
    /// Of Abaqus: the word for hexahedra of as many nodes, in capitals; empty: C3D8, of order 2 C3D20.
    std::string element{};
    DeckTag first_node = 0; ///< number of the first new node; 0: above all that are taken, from 1
    DeckTag first_cell = 0; ///< of the first hexahedron; 0: likewise
};

/// The format of an ending: .bdf .nas .dat .inp .unv, in lower case. @return false  it is none of these.
bool find_deck_format(std::string_view ending, DeckFormat& format);

/// A swept mesh as a deck of a format. Hexahedra are one region, named by the first of the volume's groups,
/// which is property 1. Groups of the skin are sets:
///
/// | format | a group is |
/// |---|---|
/// | abaqus | a set of nodes, one of the cells behind the faces, and a surface of their sides |
/// | nastran | a set of nodes |
/// | unv | a set of quads, which are elements behind the hexahedra |
///
/// Abaqus's names have letters, digits, - and _ : others become _ .
/// @throw InvalidInput "io.element"       `element` is no hexahedron of as many nodes as the mesh's.
///                     "io.no_such_element"  the mesh is of hex27, which none of the formats has.
///                     "io.number_taken"  a first number is below 1, or the last would be too high.
/// @note  O(nodes + cells).
Deck deck_of(const mesh::HexMesh& mesh, const MeshDeckOptions& options);

/// A deck and the mesh that fills a void of it as one conformal mesh. What the deck has keeps its numbers; a
/// node of the skin that lies on a node of the deck is that node, a middle node that of the side.
///
/// Groups of the skin are sets as in `deck_of()`, of nodes in UNV. The new region has the property above all
/// others; in Nastran its PSOLID names material 1. Where nodes of the deck coincide, the skin takes the one
/// of the elements whose face, else whose side, it shares.
/// @param model    the deck's faces, which the patches of the mesh name by their tags.
/// @param scale    of the model's coordinates to the deck's [-].
/// @param options  `format` is the one it will be written in.
/// @throw InvalidInput "io.not_conformal"  a face of the deck whose quads the mesh has not; with counts.
///                     "io.nodes_coincide" elements beside the void use both of two coincident nodes; names
///                                         both.
///                     "io.other_model"    a patch is of no face of the model.
///                     "io.mixed_order"    elements beside the void are of another order than the mesh.
///                     as `deck_of()`.
/// @note  O(n log n) in the nodes of the deck; a copy of the deck is made.
Deck join_deck(const Deck& deck, const topology::Model& model, double scale, const mesh::HexMesh& mesh,
               const MeshDeckOptions& options);

/// Write a deck as Nastran bulk data, Abaqus input or a universal file: whole or not at all.
///
/// Numbers, sets and words of elements stay; text of the same format goes along verbatim. Coordinates are in
/// the basic frame, as near as the format can say them: 16 characters in Nastran (10 to 15 digits), 20 in
/// Abaqus (CalculiX reads no more; 14 to 17 digits), 17 digits in UNV. Another format than the deck's gets
/// nodes, elements, regions and sets; the log says what is left out.
/// @throw InvalidInput "io.no_such_element"  the format has no such element, or none without middle nodes.
///                     "io.folder" and the like as `WholeFile`.
/// @throw BackendError  as `WholeFile`.
void write_deck(const Deck& deck, DeckFormat format, const OutputPath& path, const RunContext& context = {});

} // namespace lacuna::io
