// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Keywords of Abaqus decks. Internal to this folder.
namespace lacuna::io {

/// A line `*KEYWORD, KEY=value, KEY`.
struct Keyword {
    std::string name;                                            ///< in capitals, without blanks
    std::vector<std::pair<std::string, std::string>> parameters; ///< keys in capitals

    [[nodiscard]] const std::string* find(std::string_view key) const;
    [[nodiscard]] std::string value(std::string_view key) const;
};

/// @param words  from the star on, with continuation lines joined. @pre not empty
Keyword parse_keyword(std::string_view words);

/// Whether it assigns a section to a set of elements.
bool is_section(const Keyword& keyword);

} // namespace lacuna::io
