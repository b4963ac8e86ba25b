// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/cursor.h>

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

/// A keyword with the lines up to the next one. The first card has no name: it holds the lines before the
/// first keyword.
struct AbaqusCard {
    Keyword keyword{};
    std::string_view text{}; ///< all its lines, with comments
    std::string_view data{}; ///< from its first data line to its last, with comments between
};
/// The cards of a text. They view the text.
std::vector<AbaqusCard> abaqus_cards(std::string_view text);
/// Call `take(line)` for the data lines of a card.
template <class Take>
void each_data_line(const AbaqusCard& card, const Take& take)
{
    each_line(card.data, [&](std::string_view line) {
        if (!trimmed(line).starts_with("**")) take(line);
    });
}

/// Whether an element type in capitals is a hexahedron of a thin layer, whose nodes 5 to 8 lie on 1 to 4 in
/// the direction of its thickness: a cohesive one, a gasket, a continuum shell.
bool is_layer(std::string_view type);
/// The type of the wedges beside such hexahedra; empty: there is none.
std::string layer_wedge(std::string_view type);

/// Whether it assigns a section to a set of elements.
bool is_section(const Keyword& keyword);

} // namespace lacuna::io
