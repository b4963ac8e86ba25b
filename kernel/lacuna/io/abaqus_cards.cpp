// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/abaqus.h>

#include <lacuna/io/detail/deck_writer.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace lacuna::io {
namespace {

/// A family of element types: the word at the start of their names, and their dimension. A number of nodes
/// and letters follow the word: S4R, C3D8I.
struct Family {
    std::string_view word;
    int dimension;
};
constexpr Family kFamilies[] = {{"C3D", 3},  {"DC3D", 3}, {"AC3D", 3},  {"SC", 3},    {"CSS", 3},
                                {"S", 2},    {"DS", 2},   {"M3D", 2},   {"SFM3D", 2}, {"R3D", 2},
                                {"STRI", 2}, {"CPS", 2},  {"CPE", 2},   {"CAX", 2},   {"DC2D", 2},
                                {"DCAX", 2}, {"AC2D", 2}, {"DCC3D", 3}, {"CGAX", 2}};

} // namespace

const std::string* Keyword::find(std::string_view key) const
{
    for (const auto& [name_of, value] : parameters)
        if (name_of == key) return &value;
    return nullptr;
}

std::string Keyword::value(std::string_view key) const
{
    const std::string* found = find(key);
    return found == nullptr ? std::string() : *found;
}

Keyword parse_keyword(std::string_view words)
{
    Keyword keyword;
    words.remove_prefix(1);
    for (bool first = true; !words.empty() || first; first = false) {
        const std::string_view field = next_field(words);
        const std::size_t equals = std::min(field.find('='), field.size());
        std::string key = upper(field.substr(0, equals));
        std::erase_if(key, [](char c) { return is_blank(c); });
        if (first) {
            keyword.name = key;
            continue;
        }
        std::string_view value = equals < field.size() ? trimmed(field.substr(equals + 1))
                                                       : std::string_view();
        if (value.size() >= 2 && value.front() == '"' && value.back() == '"')
            value = value.substr(1, value.size() - 2);
        if (!key.empty()) keyword.parameters.emplace_back(std::move(key), std::string(value));
    }
    return keyword;
}

std::vector<AbaqusCard> abaqus_cards(std::string_view text)
{
    std::vector<AbaqusCard> cards(1);
    for (std::size_t begin = 0, at = 0; at < text.size(); begin = at) {
        const auto next_line = [&] {
            const std::size_t from = at, end = std::min(text.find('\n', at), text.size());
            at = std::min(end + 1, text.size());
            return trimmed(text.substr(from, end - from));
        };
        const std::string_view line = next_line();
        const bool comment = line.starts_with("**"), keyword = !comment && line.starts_with('*');
        if (keyword) {
            std::string words(line);
            while (words.ends_with(',') && at < text.size()) words += next_line();
            cards.push_back({parse_keyword(words)});
        }
        AbaqusCard& card = cards.back();
        const auto extend = [&](std::string_view& lines) {
            lines = text.substr(lines.empty() ? begin : static_cast<std::size_t>(lines.data() - text.data()));
            lines = lines.substr(0, at - static_cast<std::size_t>(lines.data() - text.data()));
        };
        extend(card.text);
        if (!keyword && !comment) extend(card.data);
    }
    return cards;
}

bool is_section(const Keyword& keyword)
{
    constexpr std::string_view kSections[] = {"SOLIDSECTION",   "SHELLSECTION",        "MEMBRANESECTION",
                                              "SURFACESECTION", "SHELLGENERALSECTION", "SOLIDSHELLSECTION",
                                              "RIGIDBODY"};
    return std::ranges::find(kSections, keyword.name) != std::end(kSections);
}

bool is_layer(std::string_view type)
{
    return std::ranges::any_of(std::array{"COH3D8", "GK3D8", "SC8R", "CSS8"},
                               [&](const char* word) { return type.starts_with(word); });
}

std::string layer_wedge(std::string_view type)
{
    if (!is_layer(type) || type.starts_with("CSS")) return {};
    std::string wedge(type);
    wedge[wedge.find('8')] = '6';
    return wedge;
}

bool is_abaqus_element(std::string_view type, DeckShape shape)
{
    // Cohesive elements and gaskets are written, but not read: they may have no thickness.
    const bool thin = type.starts_with("COH3D") || type.starts_with("GK3D");
    if (thin && type.substr(type.find('D') + 1).starts_with('8')) return shape == DeckShape::hex8;
    if (thin && type.substr(type.find('D') + 1).starts_with('6')) return shape == DeckShape::wedge6;
    return abaqus_shape(type) == shape;
}

std::optional<DeckShape> abaqus_shape(std::string_view type)
{
    for (const Family& family : kFamilies) {
        if (!type.starts_with(family.word)) continue;
        std::string_view rest = type.substr(family.word.size());
        std::size_t digits = 0;
        while (digits < rest.size() && std::isdigit(static_cast<unsigned char>(rest[digits])) != 0) ++digits;
        auto nodes = parse_integer<int>(rest.substr(0, digits)).value_or(0);
        if (digits == 0) continue;
        rest.remove_prefix(digits);
        if (!std::ranges::all_of(rest, [](unsigned char c) { return std::isalnum(c) != 0; })) continue;
        if (family.word == "STRI" && nodes == 65) nodes = 6;
        constexpr std::array<int, 5> kCorners{3, 4, 5, 6, 8};
        const bool centred = family.dimension == 3 &&
                             (nodes == 14 || nodes == 18 || nodes == 27); // shapes that no Abaqus element has
        if (centred) continue;
        for (const int corners : kCorners)
            if (const auto shape = find_shape(family.dimension, corners, nodes)) return shape;
    }
    return std::nullopt;
}

} // namespace lacuna::io
