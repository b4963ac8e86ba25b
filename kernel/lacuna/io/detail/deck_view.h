// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/swept_view.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <map>
#include <memory>
#include <utility>
#include <vector>

/// Decks, which may lack meshes that are made as they are written, as views. Internal to this folder.
namespace lacuna::io {

/// Lists of sets, each list once; number 0 is the empty one.
class SetLists {
public:
    int extended(int list, int set);
    [[nodiscard]] const std::vector<int>& operator[](int list) const { return lists_[index(list)]; }

private:
    std::map<std::pair<int, int>, int> next_;
    std::vector<std::vector<int>> lists_{1};
};

/// Entities are the elements of one dimension and region that are in the same sets; their groups are these
/// sets and the region. Lists are named by groups, where those of a group that has solids too are apart,
/// ":faces" behind its name; then by sets of nodes, "nodes:" before their names.
/// @param deck  must outlive the view, as what `bulk` refers to.
/// @note  O(n) in the elements and the members of sets but for finding sparse tags.
std::shared_ptr<mesh::MeshView> view_of(const Deck& deck, const BulkReader& bulk);

mesh::ViewParts parts_of(const Deck& deck, const DeckPartition& partition);

/// A part of a view, with its ghosts in their places between its own cells, without fields. O(points).
PieceView piece_of(const std::shared_ptr<const mesh::MeshView>& whole, const mesh::ViewParts& parts,
                   Index part);

} // namespace lacuna::io
