// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace lacuna {

/// Gives items new numbers in the order in which they are first used. Items that are not used get no number.
template <class Item>
class Renumbered {
public:
    /// @param items  referenced, not copied
    explicit Renumbered(const std::vector<Item>& items) : items_(items), number_(items.size(), -1) {}

    /// The new number of an item.
    Index operator()(std::size_t item)
    {
        Index& number = number_[item];
        if (number < 0) {
            number = static_cast<Index>(used.size());
            used.push_back(items_[item]);
        }
        return number;
    }
    Index operator()(Index item) { return (*this)(index(item)); }
    /// The new number of an item; -1 if it has not been used so far.
    [[nodiscard]] Index known(Index item) const { return number_[index(item)]; }

    std::vector<Item> used; ///< the used items, by their new numbers

private:
    const std::vector<Item>& items_;
    std::vector<Index> number_;
};

/// Erase the items for which `stays(i)` is false; the others stay in order.
/// @return  the new number of each item; -1: erased
template <class Item, class Stays>
std::vector<Index> keep_if(std::vector<Item>& items, const Stays& stays)
{
    std::vector<Index> number(items.size(), -1);
    std::size_t count = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (!stays(i)) continue;
        number[i] = static_cast<Index>(count);
        if (count < i) items[count] = std::move(items[i]);
        ++count;
    }
    items.erase(items.begin() + static_cast<std::ptrdiff_t>(count), items.end());
    return number;
}

} // namespace lacuna
