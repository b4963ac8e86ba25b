// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>
#include <lacuna/core/shared/list_text.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

/// Lines of text, and lists in messages. Internal to this folder.
namespace lacuna::io {

/// An entity of a file or a mesh, for a message.
NamedEntity numbered(const char* kind, std::integral auto tag) { return {kind, static_cast<long long>(tag)}; }

/// Names of a list that are told one by one: sets are often renamed by the dozen, and users need every name.
inline constexpr int kMostListed = 20;
/// "a, b, c and 4 more"
inline std::string listed(const std::vector<std::string>& names)
{
    return short_list(names, std::identity(), kMostListed);
}

/// Append a name if it is neither empty nor already in the list.
inline void add_once(std::vector<std::string>& names, const std::string& name)
{
    if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
}

/// Escape a text for an attribute of an XML file.
inline std::string xml_text(std::string_view text)
{
    std::string safe;
    for (const char c : text) {
        if (c == '&')
            safe += "&amp;";
        else if (c == '<')
            safe += "&lt;";
        else if (c == '"')
            safe += "&quot;";
        else
            safe += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
    return safe;
}

/// Call `take(line)` for every line of a text, without the line end.
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
