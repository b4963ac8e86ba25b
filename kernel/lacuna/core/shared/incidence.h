// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <span>
#include <vector>

namespace lacuna {

/// Lists of numbers, one for each key: the list of key i is items[begin[i]] … items[begin[i + 1] - 1].
struct Incidence {
    std::vector<Index> begin{0};
    std::vector<Index> items;

    [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
    [[nodiscard]] std::span<const Index> of(std::size_t key) const
    {
        return std::span(items).subspan(index(begin[key]), index(begin[key + 1] - begin[key]));
    }
};

/// Group items by key; within a key they keep the order in which they are visited. O(keys + items).
/// @param each  `each(visit)` calls `visit(key, item)` for every pair. It is called twice and must visit the
///              same pairs both times.
template <class Each>
Incidence incidence(std::size_t keys, const Each& each)
{
    Incidence lists;
    lists.begin.assign(keys + 1, 0);
    each([&](std::size_t key, Index) { ++lists.begin[key + 1]; });
    for (std::size_t i = 0; i < keys; ++i) lists.begin[i + 1] += lists.begin[i];
    lists.items.resize(index(lists.begin.back()));
    std::vector<Index> next(lists.begin.begin(), lists.begin.end() - 1);
    each([&](std::size_t key, Index item) { lists.items[index(next[key]++)] = item; });
    return lists;
}

} // namespace lacuna
