// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>
#include <lacuna/io/deck_file.h>

#include <lacuna/mesh/mesh_part.h>

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// Putting a swept mesh into a deck. Internal to this folder.
namespace lacuna::io {

/// Where a deck has the cells of a mesh that it does not hold.
struct BulkPlace {
    DeckTag first_cell = 1;          ///< number of the first, which the others follow
    Index region = 0;                ///< all are of
    std::vector<std::size_t> sets{}; ///< places of the sets that all are in
    DeckTag highest = 0;             ///< number of a cell of the meshes before it
};

struct AddedMesh {
    std::span<const Index> points; ///< of each node of the mesh the deck's point it is; -1: a new one
    double scale = 1;              ///< of the mesh's coordinates to the deck's
    bool joins = false;            ///< the deck is one that was read, whose sets get what belongs to them
    bool skin_cells = false;       ///< sets of the skin are quads that become elements
    /// Quads of the skin that the deck has already as elements, by their nodes rising; those added join them.
    /// Null: none are to be shared.
    std::map<Quad, DeckTag>* skin_tags = nullptr;
    /// Sets of the meshes added before, by kind and group, which this one's join; null: there are none.
    GroupSets* groups = nullptr;
    Index region = -1; ///< of the deck, that the cells are more of; -1: one of their own
    /// Not null: nodes and cells are not put in the deck, only regions, sets and empty blocks of the cells'
    /// shapes; here is where it would have them. Points are numbered from 1.
    /// @pre the deck is empty but for such meshes, and no first numbers are asked for
    BulkPlace* bulk = nullptr;
    /// Then of each node its number in the whole, from 0; null: it is its own.
    const mesh::NodeNumbers* numbers = nullptr;
    /// Of each quad of the skin, whether it is left out of the elements; empty: none is.
    std::vector<char> inner{};
    /// Of the elements beside the mesh, and the name of their region; empty: none is known.
    std::string neighbour_material{}, neighbour{};
};
/// Add nodes, hexahedra, their region and the sets of the skin to a deck. @throw as `join_deck()`.
/// @return  place of the region in the deck.
Index add_mesh(Deck& deck, const mesh::HexMesh& mesh, const AddedMesh& added, const MeshDeckOptions& options,
               const RunContext& context = {});

/// `deck_of()` without nodes and cells; see `AddedMesh::bulk`.
Deck deck_without_bulk(const mesh::HexMesh& mesh, const MeshDeckOptions& options, BulkPlace& place,
                       const RunContext& context);
/// The same of several meshes. @param places  of each mesh
Deck deck_without_bulk(std::span<const mesh::LayeredPart> parts, const MeshDeckOptions& options,
                       bool interfaces, std::vector<BulkPlace>& places, const RunContext& context);

/// The face of a patch of the skin, as messages name it.
NamedEntity entity_of(const mesh::SkinPatch& patch);

/// The deck's middle nodes that are the mesh's on the sides they share.
/// @param matched  quads of the skin that are faces of the deck's elements.
/// @param points   of each corner of the mesh the deck's point, -1: none; out: of the middle nodes too.
/// @throw InvalidInput "io.mixed_order"  one of the two has middle nodes where the other has none or others.
void join_middles(const Deck& deck, const mesh::HexMesh& mesh, const std::vector<bool>& matched,
                  double tolerance, double scale, std::vector<Index>& points);

} // namespace lacuna::io
