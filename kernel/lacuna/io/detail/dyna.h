// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/io/detail/cursor.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Cards of LS-DYNA's keyword decks. Internal to this folder.
///
/// Wedges, pyramids and tetrahedra are hexahedra with repeated nodes, as for *ELEMENT_SOLID in the Keyword
/// User's Manual, volume I: https://lsdyna.ansys.com/manuals/
namespace lacuna::io {

inline constexpr std::size_t kDynaSetField = 10; ///< columns of a number of a set, a part or a section

/// For each of the eight node fields of a solid, the index of the cell's corner there.
struct Degenerate {
    DeckShape shape;
    std::array<std::uint8_t, 8> fields;
};
inline constexpr Degenerate kDegenerate[] = {{DeckShape::tet4, {0, 1, 2, 3, 3, 3, 3, 3}},
                                             {DeckShape::pyramid5, {0, 1, 2, 3, 4, 4, 4, 4}},
                                             {DeckShape::wedge6, {0, 2, 5, 3, 1, 1, 4, 4}},
                                             {DeckShape::hex8, {0, 1, 2, 3, 4, 5, 6, 7}}};

/// Keywords of the elements that are part of the mesh.
namespace dyna_keyword {
inline constexpr std::string_view kSolid = "ELEMENT_SOLID", kSolid20 = "ELEMENT_SOLID_H20",
                                  kThick = "ELEMENT_TSHELL", kShell = "ELEMENT_SHELL";
}

/// The keyword of a line, in capitals, without the star and without the format sign at its end.
std::string dyna_keyword_of(std::string_view line);

/// The first fields of a line, at most `count`.
std::vector<std::string_view> dyna_fields(std::string_view line, std::size_t first, std::size_t width,
                                          std::size_t count);

/// Call `take(keyword, data lines)` for every card of a text.
template <class Take>
void each_dyna_card(std::string_view text, const Take& take)
{
    std::string keyword;
    std::vector<std::string_view> lines;
    each_line(text, [&](std::string_view line) {
        if (line.starts_with('$')) return;
        if (!line.starts_with('*')) return lines.push_back(line);
        if (!keyword.empty()) take(keyword, lines);
        keyword = dyna_keyword_of(line);
        lines.clear();
    });
    if (!keyword.empty()) take(keyword, lines);
}

} // namespace lacuna::io
