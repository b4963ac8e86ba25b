// SPDX-License-Identifier: MIT
#include <lacuna/io/shared/text_lines.h>

#include <lacuna/core/message.h>
#include <lacuna/io/detail/abaqus.h>
#include <lacuna/io/detail/cursor.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/texts.h>

#include <algorithm>
#include <array>
#include <optional>

namespace lacuna::io {
namespace {

/// The truss or beam of a Nastran line; empty: the line is another card.
std::optional<TextLine> nastran_line(std::string_view line)
{
    const std::vector<std::string_view> fields = nastran_fields(line);
    if (fields.size() < 5) return {};
    const std::string_view word = fields[0].substr(0, fields[0].find('*'));
    constexpr std::array kWords{"CBAR", "CBEAM", "CROD", "CTUBE"};
    if (std::ranges::none_of(kWords, [&](const char* one) { return same_word(word, one); })) return {};
    const auto tag = parse_integer<DeckTag>(fields[1]), property = parse_integer<DeckTag>(fields[2]),
               a = parse_integer<DeckTag>(fields[3]), b = parse_integer<DeckTag>(fields[4]);
    if (!tag || !a || !b) return {};
    return TextLine{*tag, {*a, *b}, formatted("pid:{}", property.value_or(*tag))};
}

} // namespace

std::vector<TextLine> lines_in_text(const Deck& deck)
{
    std::vector<TextLine> lines;
    for (const DeckText& text : deck.texts) {
        if (deck.format == DeckFormat::nastran)
            each_line(text.text, [&](std::string_view line) {
                if (auto found = nastran_line(line)) lines.push_back(std::move(*found));
            });
        if (deck.format != DeckFormat::abaqus) continue;
        std::vector<DeckTag> offsets; // of the instances of its part
        for (const DeckInstance& instance : deck.instances)
            if (instance.part == text.part) offsets.push_back(instance.offset);
        if (offsets.empty()) offsets = {0};
        for (const AbaqusCard& card : abaqus_cards(text.text)) {
            const std::string type = card.keyword.value("TYPE");
            const bool is_line = type.size() > 2 &&
                                 (same_word(type.substr(0, 1), "B") || same_word(type.substr(0, 1), "T")) &&
                                 (type[1] == '2' || type[1] == '3');
            if (card.keyword.name != "ELEMENT" || !is_line) continue;
            each_data_line(card, [&](std::string_view line) {
                std::vector<DeckTag> numbers; // of the element, then of its nodes from end to end
                while (!line.empty())
                    if (const auto number = parse_integer<DeckTag>(next_field(line)))
                        numbers.push_back(*number);
                for (const DeckTag offset : offsets)
                    if (numbers.size() > 2)
                        lines.push_back(
                            {numbers[0] + offset, {numbers[1] + offset, numbers.back() + offset}, {}});
            });
        }
    }
    return lines;
}

} // namespace lacuna::io
