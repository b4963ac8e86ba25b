// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
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

} // namespace lacuna
