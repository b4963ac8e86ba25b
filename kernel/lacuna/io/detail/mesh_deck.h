// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>
#include <lacuna/io/deck_file.h>

#include <lacuna/mesh/mesh_part.h>
#include <lacuna/mesh/tet_mesh.h>

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// Adding a swept mesh to a deck. Internal to this folder.
namespace lacuna::io {

/// Place in a deck of a mesh whose nodes and cells the deck does not store.
struct BulkPlace {
    DeckTag first_node = 1;          ///< number of the first node of the whole mesh; the others follow
    DeckTag first_cell = 1;          ///< number of the first cell; the others follow
    Index region = 0;                ///< region of all cells
    std::vector<std::size_t> sets{}; ///< indices of the sets that contain all cells, increasing
    DeckTag highest = 0;             ///< highest cell number of earlier meshes
};

struct AddedMesh {
    std::span<const Index> points; ///< the deck's point for each node of the mesh; -1: the node is new
    double scale = 1;              ///< factor from the mesh's coordinates to the deck's
    bool skin_cells = false;       ///< quads of the skin become elements; groups of the skin become sets of
                                   ///< these elements
    /// Quads of the skin that are elements of the deck already, by their sorted nodes; new quads are added.
    /// Null: meshes do not share quads.
    std::map<Quad, DeckTag>* skin_tags = nullptr;
    /// Sets and regions of meshes that were added before; this mesh extends them. Updated. Null: there are
    /// none.
    JoinedBefore* before = nullptr;
    /// Null: the deck stores the nodes and cells of the mesh. Not null: the deck gets only regions, sets and
    /// empty blocks of the cells' shapes, and `*bulk` gets the place of the mesh.
    /// @pre  if not null: the deck contains only meshes that were added in this way, and they all have the
    ///       `first_node` of the first of them.
    BulkPlace* bulk = nullptr;
    /// With `bulk`: the number of each node in the whole mesh, from 0; null: its own number.
    const mesh::NodeNumbers* numbers = nullptr;
    bool is_new = false; ///< without `bulk`: no file was read, and the deck has the points already
    /// For each quad of the skin, whether it is left out of the elements; empty: none is.
    std::vector<char> inner{};
    /// Material of the elements next to the mesh, and the name of their region; empty: unknown.
    std::string neighbour_material{}, neighbour{};
};
/// Add nodes, cells, their region and the sets of the skin to a deck. @throw  as `join_deck()`.
void add_mesh(Deck& deck, const mesh::HexMesh& mesh, const AddedMesh& added, const MeshDeckOptions& options,
              const RunContext& context = {});
void add_mesh(Deck& deck, const mesh::TetPart& mesh, const AddedMesh& added, const MeshDeckOptions& options,
              const RunContext& context = {});

/// The face of a patch of the skin, for messages.
NamedEntity entity_of(const mesh::SkinPatch& patch);

/// Find the deck's middle nodes on sides shared with the mesh.
/// @param matched  quads of the skin that are faces of the deck's elements.
/// @param points   the deck's point for each corner of the mesh, -1: none; middle nodes are added.
/// @throw InvalidInput "io.mixed_order"  only the deck or only the mesh has a middle node on a shared side or
///         quad, or the two nodes have different positions.
void join_middles(const Deck& deck, const mesh::HexMesh& mesh, const std::vector<bool>& matched,
                  double tolerance, double scale, std::vector<Index>& points);
void join_middles(const Deck& deck, const mesh::TetPart& mesh, const std::vector<bool>& matched,
                  double tolerance, double scale, std::vector<Index>& points);

} // namespace lacuna::io
