// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>
#include <lacuna/io/deck_file.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/swept_view.h>
#include <lacuna/mesh/mesh_part.h>
#include <lacuna/mesh/tet_mesh.h>

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// Adding a swept mesh to a deck. Internal to this folder.
namespace lacuna::io {

// Common interface of swept meshes and tetrahedra: cells and skin by shape.

/// Positions [begin, end) of the cells, or of the sides of the skin, of one shape.
struct OfShape {
    DeckShape shape;
    std::size_t begin, end;
};
using ByShape = std::array<OfShape, 2>;

/// A swept mesh. Its cells and skin are not stored by shape, so positions are converted to indices.
struct SweptParts {
    const mesh::HexMesh& mesh;
    mesh::CellKinds kinds{mesh};

    [[nodiscard]] ByShape cells() const
    {
        return {
            {{cell_shape(mesh), 0, kinds.hexes()}, {DeckShape::wedge6, kinds.hexes(), mesh.cell_count()}}};
    }
    [[nodiscard]] ByShape skin() const
    {
        return {{{skin_shape(mesh), 0, kinds.skin_quads()},
                 {DeckShape::tri3, kinds.skin_quads(), mesh.skin_count()}}};
    }
    [[nodiscard]] std::size_t cell(std::size_t i) const { return kinds.cell(i); }
    [[nodiscard]] std::size_t side(std::size_t i) const { return kinds.skin(i); }
    /// For each side of the skin: its cell, and the number of that face in the cell.
    [[nodiscard]] std::pair<std::vector<std::uint32_t>, std::vector<int>> behind_skin() const;
    [[nodiscard]] std::size_t nodes() const { return mesh::corner_count(mesh) + mesh::middle_count(mesh); }
    /// All nodes of the columns over nodes of the first level.
    [[nodiscard]] std::vector<Index> nodes_over(std::span<const Index> first) const;
    void check() const { check_skin(mesh); }
};

/// Pyramids and tetrahedra.
struct TetParts {
    const mesh::TetPart& mesh;

    [[nodiscard]] ByShape cells() const
    {
        return {{{mesh::cell_shape(mesh, true), 0, mesh.pyramids},
                 {mesh::cell_shape(mesh, false), mesh.pyramids, mesh.cells.size()}}};
    }
    [[nodiscard]] ByShape skin() const
    {
        return {{{mesh::skin_shape(mesh, true), 0, mesh.skin_quads},
                 {mesh::skin_shape(mesh, false), mesh.skin_quads, mesh.skin.size()}}};
    }
    [[nodiscard]] static std::size_t cell(std::size_t i) { return i; }
    [[nodiscard]] static std::size_t side(std::size_t i) { return i; }
    /// As for swept meshes.
    [[nodiscard]] std::pair<std::vector<std::uint32_t>, std::vector<int>> behind_skin() const;
    [[nodiscard]] std::size_t nodes() const { return mesh.node_count(); }
    [[nodiscard]] static std::vector<Index> nodes_over(std::span<const Index>) { return {}; }
    static void check() {}
};

/// The format's word for elements of a shape; empty: the format needs none.
inline std::string type_word(DeckFormat format, DeckShape shape)
{
    const ShapeWords& words = words_of(shape);
    return format == DeckFormat::unv       ? std::to_string(words.unv)
           : format == DeckFormat::nastran ? words.nastran
           : format == DeckFormat::abaqus  ? words.abaqus
                                           : "";
}

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

/// Adds the sets of a mesh's groups to a deck, under names that are free.
class SetAdder {
public:
    /// @param surfaces  names of surfaces in the deck's text
    SetAdder(Deck& deck, const AddedMesh& added, DeckFormat format, const std::vector<std::string>& surfaces)
        : deck_(deck), added_(added), format_(format), surfaces_(surfaces), first_set_(deck.sets.size())
    {
    }

    /// Add a group as a set, named `wanted` if that name is free. The group extends the set of a mesh that
    /// was added before, or a set that lost all members; otherwise a new set is made.
    const DeckSet& add(DeckSet& set, const std::string& group, const std::string& wanted);
    [[nodiscard]] bool is_taken(DeckSet::Kind kind, const std::string& name);
    /// Whether a region or set of this name lost all its elements or members.
    [[nodiscard]] bool is_emptied(const std::string& name) const;
    /// Log the sets whose names were in use.
    void tell_names(const std::string& volume, const RunContext& context) const;

    /// Suffix of the keys of skin groups, to distinguish them from cell groups; it occurs in no name.
    static constexpr const char* kSkin = "\n";

private:
    /// The names of the deck's sets, with those that were added since the last call.
    SetNames& names();

    Deck& deck_;
    const AddedMesh& added_;
    DeckFormat format_;
    const std::vector<std::string>& surfaces_;
    std::map<std::string, std::string> renamed_; ///< sets whose names were in use, with their new names
    SetNames names_;                             ///< names of the deck's sets, if no mesh was added before
    std::size_t first_set_;                      ///< number of sets before the mesh was added
};

/// The face of a patch of the skin, for messages.
NamedEntity entity_of(const mesh::SkinPatch& patch);

/// Find the deck's middle nodes on sides shared with the mesh.
/// @param matched  quads of the skin that are faces of the deck's elements.
/// @param points   the deck's point for each corner of the mesh, -1: none; middle nodes are added.
/// @throw InvalidInput "io.mixed_order"  only the deck or only the mesh has a middle node on a shared side or
///         quad, or the two nodes have different positions.
template <class Mesh>
void join_middles(const Deck& deck, const Mesh& mesh, const std::vector<bool>& matched, double tolerance,
                  double scale, std::vector<Index>& points);

} // namespace lacuna::io
