// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Lines of texts, and lists in messages. Internal to this folder.
namespace lacuna::io {

/// "a, b, c and 4 more"
inline std::string listed(const std::vector<std::string>& names)
{
    constexpr std::size_t kMost = 20; // what still reads as a list
    std::string text;
    for (std::size_t n = 0; n < std::min(names.size(), kMost); ++n) text += (n > 0 ? ", " : "") + names[n];
    if (names.size() > kMost) text += " and " + std::to_string(names.size() - kMost) + " more";
    return text;
}

/// Call `take(line)` for every line of a text, without its end.
template <class Take>
void each_line(std::string_view text, const Take& take)
{
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        take(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

} // namespace lacuna::io
