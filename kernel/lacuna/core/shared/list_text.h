// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <iterator>
#include <string>

namespace lacuna {

/// "a, b, c": the texts of all items.
/// @param text  returns the text of an item as a std::string.
template <class Items, class Text>
std::string full_list(const Items& items, Text text)
{
    std::string list;
    for (const auto& item : items) list += (list.empty() ? "" : ", ") + text(item);
    return list;
}

/// "a, b, c, d, e, f and 3 more": the first `most` items, and the number of the others. Keeps messages short.
template <class Items, class Text>
std::string short_list(const Items& items, Text text, std::ptrdiff_t most = 6)
{
    std::string list;
    const auto count = std::ssize(items);
    auto item = std::begin(items);
    for (std::ptrdiff_t i = 0; i < std::min(count, most); ++i, ++item)
        list += (i == 0 ? "" : ", ") + text(*item);
    return count > most ? list + " and " + std::to_string(count - most) + " more" : list;
}

} // namespace lacuna
