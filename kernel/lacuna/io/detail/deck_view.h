// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/mesh_deck.h>
#include <lacuna/io/detail/swept_view.h>
#include <lacuna/io/formats.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

/// Views of decks, including decks with meshes that are created while they are written. Internal to this
/// folder.
namespace lacuna::io {

/// Lists of sets. Each list is stored once and identified by its number; list 0 is empty. `extended()`
/// returns the number of the list that consists of `list` and `set`.
class SetLists {
public:
    int extended(int list, int set);
    [[nodiscard]] const std::vector<int>& operator[](int list) const { return lists_[index(list)]; }

private:
    std::map<std::pair<int, int>, int> next_;
    std::vector<std::vector<int>> lists_{1};
};

/// A mesh whose nodes and cells are not stored in the deck.
struct BulkPart {
    const mesh::HexMesh& mesh;
    std::unique_ptr<const NodeReader> nodes;
    const mesh::NodeNumbers* numbers; ///< numbers of its nodes in the whole mesh, from 0; null: the mesh is
                                      ///< the whole
    SweptCells cells{mesh};
    BulkPlace place{};
};
/// Convert swept meshes with shared nodes to a deck of a format. The deck has regions and sets as in
/// `write_mesh()`, but lacks the nodes and cells of the meshes; see `AddedMesh::bulk`.
/// @param parts       their `place` is set
/// @param interfaces  as `MeshFileOptions::interfaces`
/// @throw  as `write_parts()`
/// @note   O(nodes and cells of the skin)
Deck deck_without_bulk(std::span<BulkPart> parts, MeshDeckOptions options, bool interfaces,
                       const RunContext& context);

/// View a deck for the writer of a format. The view has the regions and sets of the deck.
///
/// For formats that are not decks, elements of one dimension and region that are in the same sets form an
/// entity. Its groups are these sets and the region. The view gets a named list for each group. If a group
/// has both solids and faces, its faces form a list of their own, with ":faces" appended to the name. Lists
/// of the node sets follow, with "nodes:" before their names.
/// @param deck   must outlive the view, as must `parts`.
/// @param parts  meshes that `deck_without_bulk()` left out of the deck; empty: the deck has all.
/// @note  O(n) in the elements and the members of sets; O(n log n) if tags have large gaps.
std::shared_ptr<mesh::MeshView> view_of(const Deck& deck, const Format& format,
                                        std::span<const BulkPart> parts = {});

/// Add the directions of cells to a view of swept meshes that store their nodes. They become
/// `MeshView::frames` and, with `fields`, the fields "column", "axis", "radial" and "tangential" with three
/// components each.
/// @param parts  in the order of the view's cells; cells after these have no directions.
void add_orientation(std::span<const BulkPart> parts, bool fields, mesh::MeshView& view);

/// Divide the view of several swept meshes into parts, as `write_parts()` says.
/// @param parts  meshes of the view. The view numbers all cells of a mesh before its skin elements.
/// @throw InvalidInput "io.too_many_parts"  there are fewer layers than parts.
/// @note  O(nodes of all cells) for each row of ghosts.
mesh::ViewParts parts_of(const mesh::MeshView& view, std::span<const BulkPart> parts,
                         const PartitionOptions& options);

} // namespace lacuna::io
