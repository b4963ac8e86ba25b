// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/deck_writer.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// The elements of a deck as entities, for formats that know groups as lists of these. Internal to this
/// folder.
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

/// Elements of one dimension and region that are in the same sets.
struct DeckEntity {
    int dimension = 0;
    Index region = -1;               ///< place in `Deck::regions`; -1: none
    std::vector<std::string> groups; ///< the sets it is of, and its region; each once
};

struct DeckEntities {
    std::vector<DeckEntity> all;        ///< numbered from 1 in files
    std::vector<std::vector<Index>> of; ///< of each element of each block, its place in `all`
    /// Of each block whose elements are made, where those of one entity end, and that entity.
    std::vector<std::vector<std::pair<std::size_t, Index>>> made;
    /// Groups with the entities that are in them, counted from 1, as first met. Faces of a group that has
    /// solids too are one of their own, ":faces" behind its name.
    std::vector<std::pair<std::string, std::vector<int>>> groups;

    /// The entity of element `e` of block `b`.
    [[nodiscard]] Index at(std::size_t b, std::size_t e) const
    {
        if (made[b].empty()) return of[b][e];
        return std::ranges::upper_bound(made[b], e, {}, &std::pair<std::size_t, Index>::first)->second;
    }
};

/// @note  O(n) in the elements and the members of sets but for finding sparse tags.
DeckEntities entities_of(const Deck& deck, const BulkReader& bulk);

} // namespace lacuna::io
