// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/partition.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <map>
#include <memory>
#include <utility>
#include <vector>

/// Views of decks, including decks with meshes that are created while they are written. Internal to this
/// folder.
namespace lacuna::io {

/// Lists of sets without duplicates; list 0 is empty.
class SetLists {
public:
    int extended(int list, int set);
    [[nodiscard]] const std::vector<int>& operator[](int list) const { return lists_[index(list)]; }

private:
    std::map<std::pair<int, int>, int> next_;
    std::vector<std::vector<int>> lists_{1};
};

/// View a deck. An entity is the elements of one dimension and region that are in the same sets; its groups
/// are these sets and the region. The named lists of the view are those of the groups, where the faces of a
/// group that also has solids form a list of their own with ":faces" appended to its name, followed by the
/// node sets, with "nodes:" before their names.
/// @param deck  must outlive the view, as must the objects that `bulk` refers to.
/// @note  O(n) in the elements and the members of sets, plus the search for sparse tags.
std::shared_ptr<mesh::MeshView> view_of(const Deck& deck, const BulkReader& bulk);

mesh::ViewParts parts_of(const Deck& deck, const DeckPartition& partition);

} // namespace lacuna::io
