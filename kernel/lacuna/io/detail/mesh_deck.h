// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck_file.h>

#include <limits>
#include <map>
#include <span>
#include <vector>

/// Putting a swept mesh into a deck. Internal to this folder.
namespace lacuna::io {

struct AddedMesh {
    std::span<const Index> points; ///< of each node of the mesh the deck's point it is; -1: a new one
    double scale = 1;              ///< of the mesh's coordinates to the deck's
    bool skin_cells = false;       ///< sets of the skin are quads that become elements
    /// Quads of the skin that the deck has already as elements, by their nodes rising; those added join them.
    /// Null: none are to be shared.
    std::map<Quad, DeckTag>* skin_tags = nullptr;
    /// Sets from this one on are those of meshes added before, and join this one's of the same names.
    std::size_t own_sets = std::numeric_limits<std::size_t>::max();
    Index region = -1; ///< of the deck, that the cells are more of; -1: one of their own
    /// Nodes and cells are not put in the deck: only regions, sets and empty blocks of the cells' shapes.
    /// Sets of elements without members are all cells then.
    /// @pre the deck is empty, and no first numbers are asked for
    bool bulk_elsewhere = false;
    /// Of each quad of the skin, whether it is left out of the elements; empty: none is.
    std::vector<char> inner{};
    /// Of the elements beside the mesh, and the name of their region; empty: none is known.
    std::string neighbour_material{}, neighbour{};
};
/// Add nodes, hexahedra, their region and the sets of the skin to a deck. @throw as `join_deck()`.
void add_mesh(Deck& deck, const mesh::HexMesh& mesh, const AddedMesh& added, const MeshDeckOptions& options,
              const RunContext& context = {});

/// `deck_of()` without nodes and cells; see `AddedMesh::bulk_elsewhere`.
Deck deck_without_bulk(const mesh::HexMesh& mesh, const MeshDeckOptions& options, const RunContext& context);

/// The deck's middle nodes that are the mesh's on the sides they share.
/// @param matched  quads of the skin that are faces of the deck's elements.
/// @param points   of each corner of the mesh the deck's point, -1: none; out: of the middle nodes too.
/// @throw InvalidInput "io.mixed_order"  one of the two has middle nodes where the other has none or others.
void join_middles(const Deck& deck, const mesh::HexMesh& mesh, const std::vector<bool>& matched,
                  double tolerance, double scale, std::vector<Index>& points);

} // namespace lacuna::io
