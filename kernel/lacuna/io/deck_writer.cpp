// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/deck_writer.h>

#include <lacuna/core/error.h>
#include <lacuna/io/detail/abaqus.h>
#include <lacuna/io/detail/cursor.h>
#include <lacuna/io/detail/texts.h>
#include <lacuna/io/detail/unv.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace lacuna::io {
namespace {

/// Convert the output of to_chars() to a number with a decimal point and a short exponent. The exponent
/// follows `e_letter`, or is only its sign and digits if `e_letter` is 0.
std::size_t with_point(char* text, std::size_t length, std::size_t width, char e_letter)
{
    std::string_view all(text, length);
    const std::size_t e = all.find('e');
    std::array<char, 8> exponent{};
    std::size_t tail = 0;
    if (e != std::string_view::npos) {
        if (e_letter != 0) exponent[tail++] = e_letter;
        exponent[tail++] = text[e + 1];
        std::size_t digit = e + 2;
        while (digit + 1 < length && text[digit] == '0') ++digit;
        while (digit < length) exponent[tail++] = text[digit++];
        length = e;
    }
    if (std::string_view(text, length).find('.') == std::string_view::npos) text[length++] = '.';
    const std::size_t sign = text[0] == '-' ? 1 : 0;
    if (length + tail > width && length > sign + 2 && text[sign] == '0' && text[sign + 1] == '.') {
        std::copy(text + sign + 1, text + length, text + sign);
        --length;
    }
    std::copy_n(exponent.data(), tail, text + length);
    return length + tail;
}

/// Field 2 of a Nastran line.
std::string_view second_field(std::string_view line)
{
    const std::vector<std::string_view> fields = nastran_fields(line);
    return fields.size() > 1 ? fields[1] : std::string_view();
}

void nastran_numbers(std::string_view line, TextNumbers& numbers)
{
    const auto starts = [&](std::string_view word) { return same_word(line.substr(0, word.size()), word); };
    if (starts("SPOINT")) {
        return each_whole(line.substr(6), [&](DeckTag tag) { numbers.nodes.insert(tag); });
    }
    const auto tag = parse_integer<DeckTag>(second_field(line));
    if (!tag || *tag < 1) return;
    if (starts("SET"))
        numbers.set = std::max(numbers.set, *tag);
    else if (starts("PLOTEL") || starts("GENEL") || (starts("C") && !starts("CORD")) || starts("R"))
        numbers.cells.insert(*tag);
    else if (starts("P"))
        numbers.property = std::max(numbers.property, *tag);
}

/// The words of a line as numbers; 0 for words that are not numbers.
std::vector<std::int64_t> numbers_of(std::string_view line)
{
    std::vector<std::int64_t> numbers;
    for (auto word = next_word(line); !word.empty(); word = next_word(line))
        numbers.push_back(parse_integer<std::int64_t>(word).value_or(0));
    return numbers;
}

/// Collect the numbers in an element dataset. Its records consist of a head, possibly an orientation, and
/// nodes.
void unv_numbers(std::string_view text, TextNumbers& numbers)
{
    const auto next = [&] {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        return numbers_of(line);
    };
    next(); // the line -1 that begins the dataset
    const std::vector<std::int64_t> dataset = next();
    while (!text.empty()) {
        const std::vector<std::int64_t> head = next();
        if (head.size() < 6) continue; // blank, or the line -1 that ends the dataset
        numbers.cells.insert(head[0]);
        if (unv_has_orientation(head[1], static_cast<int>(dataset.at(0)))) next();
        for (std::int64_t left = head.back(); left > 0 && !text.empty();)
            left -= static_cast<std::int64_t>(next().size());
    }
}

} // namespace

std::vector<std::string_view> split_fields(std::string_view line, std::size_t first, std::size_t width,
                                           bool tabs)
{
    std::vector<std::string_view> fields;
    const bool commas = line.find(',') != line.npos, free = commas || (tabs && line.find('\t') != line.npos);
    for (std::size_t columns = first; !line.empty(); columns = width) {
        const std::size_t end = std::min(free ? line.find(commas ? ',' : '\t') : columns, line.size());
        fields.push_back(trimmed(line.substr(0, end)));
        line.remove_prefix(std::min(end + (free ? 1 : 0), line.size()));
    }
    return fields;
}

std::vector<std::string_view> nastran_fields(std::string_view line)
{
    line = line.substr(0, line.find('$'));
    return split_fields(line, 8, line.substr(0, 8).find('*') == line.npos ? 8 : 16, true);
}

std::map<Index, mesh::Ranges> cells_by_region(const mesh::MeshView::Block& block)
{
    std::map<Index, mesh::Ranges> cells;
    mesh::each_run(block.regions, 0, block.count, [&](std::size_t first, std::size_t last, Index region) {
        cells[region].add(first, last);
    });
    return cells;
}

std::string real_text(double value, std::size_t width, RealForm form)
{
    std::string text(width, '\0');
    text.resize(static_cast<std::size_t>(put_real(text.data(), value, width, form) - text.data()));
    return text;
}

std::string_view text_of(mesh::MeshView::TextByIndex texts, std::size_t index)
{
    const auto at = std::ranges::lower_bound(texts, index, {},
                                             &mesh::MeshView::TextByIndex::value_type::first);
    return at != texts.end() && at->first == index ? std::string_view(at->second) : std::string_view();
}

char* put_real(char* out, double value, std::size_t width, RealForm form)
{
    char best[kLongestReal], text[kLongestReal]; // with room for what `with_point()` inserts
    const char letter = form == RealForm::nastran ? '\0' : 'E';
    std::size_t length = with_point(
        best, static_cast<std::size_t>(std::to_chars(best, best + kLongestReal, value).ptr - best), width,
        letter);
    if (length > width) {
        double error = HUGE_VAL;
        length = 0;
        for (const auto format : {std::chars_format::fixed, std::chars_format::scientific})
            for (int digits = static_cast<int>(width); digits >= 0; --digits) {
                const auto end = std::to_chars(text, text + kLongestReal - 10, value, format, digits);
                if (end.ec != std::errc()) break;
                const std::size_t found = with_point(text, static_cast<std::size_t>(end.ptr - text), width,
                                                     letter);
                if (found > width) continue;
                const double back = parse_real({text, found}, Exponents::fortran).value_or(HUGE_VAL);
                if (std::abs(back - value) < error) {
                    error = std::abs(back - value);
                    length = found;
                    std::copy_n(text, found, best);
                }
                break;
            }
    }
    return std::copy_n(best, length, out);
}

std::string text_at(const Deck& deck, DeckText::Place place)
{
    std::string all;
    for (const DeckText& text : deck.texts)
        if (text.place == place) all += text.text;
    return all;
}

std::string abaqus_name(std::string_view name)
{
    std::string fit(name);
    for (char& c : fit)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
    if (fit.empty() || std::isalpha(static_cast<unsigned char>(fit[0])) == 0) fit.insert(0, "G_");
    return fit;
}

std::string free_name(std::string_view name, DeckFormat format,
                      const std::function<bool(const std::string&)>& is_taken)
{
    const bool abaqus = format == DeckFormat::abaqus;
    const std::string fit = abaqus ? abaqus_name(name) : std::string(name);
    const std::size_t longest = abaqus ? kCardColumns : fit.npos;
    std::string unique = fit.substr(0, longest);
    for (int i = 2; is_taken(unique); ++i) {
        const std::string number = "_" + std::to_string(i);
        unique = fit.substr(0, longest - number.size()) + number;
    }
    return unique;
}

bool share_names(DeckFormat format, DeckSet::Kind a, DeckSet::Kind b)
{
    using enum mesh::SetKind;
    return a == b || format == DeckFormat::unv || (format == DeckFormat::abaqus && a != nodes && b != nodes);
}

TextNumbers numbers_in_text(const Deck& deck)
{
    TextNumbers numbers;
    for (const DeckText& text : deck.texts) {
        if (text.place == DeckText::Place::head) continue;
        if (deck.format == DeckFormat::unv) {
            if (text.place == DeckText::Place::tail) unv_numbers(text.text, numbers);
            continue;
        }
        if (deck.format == DeckFormat::nastran)
            each_line(text.text, [&](std::string_view line) { nastran_numbers(line, numbers); });
        if (deck.format != DeckFormat::abaqus) continue;
        for (const AbaqusCard& card : abaqus_cards(text.text)) {
            if (card.keyword.name == "SURFACE") numbers.surfaces.push_back(card.keyword.value("NAME"));
            if (card.keyword.name != "ELEMENT") continue;
            each_data_line(card, [&](std::string_view line) {
                if (const auto tag = parse_integer<DeckTag>(next_field(line)); tag && *tag >= 0)
                    numbers.cells.insert(*tag);
            });
        }
    }
    return numbers;
}

std::vector<std::string> materials_in_text(const Deck& deck)
{
    std::vector<std::string> found;
    for (const DeckText& text : deck.texts) {
        if (deck.format == DeckFormat::abaqus)
            for (const auto& [keyword, lines, data] : abaqus_cards(text.text))
                if (keyword.name == "MATERIAL") add_once(found, keyword.value("NAME"));
        if (deck.format != DeckFormat::nastran || text.place != DeckText::Place::cards) continue;
        each_line(text.text, [&](std::string_view line) {
            // MAT1 to MAT11 and MATHP define materials. MATS1, MATT1 and the like only extend a material with
            // the same number.
            if (!same_word(line.substr(0, 3), "MAT") || line.size() < 5) return;
            if (std::isdigit(static_cast<unsigned char>(line[3])) == 0 && !same_word(line.substr(3, 2), "HP"))
                return;
            if (const auto tag = parse_integer<DeckTag>(second_field(line)))
                add_once(found, std::to_string(*tag));
        });
    }
    return found;
}

std::optional<std::string> section_material(const Deck& deck, std::string_view set)
{
    for (const DeckText& text : deck.texts)
        for (const auto& [keyword, lines, data] : abaqus_cards(text.text))
            if (is_section(keyword) && same_word(keyword.value("ELSET"), set))
                return keyword.value("MATERIAL");
    return {};
}

std::pair<std::string, std::string> model_and_steps(const std::string& cards)
{
    for (const AbaqusCard& card : abaqus_cards(cards)) {
        if (card.keyword.name != "STEP") continue;
        const auto step = static_cast<std::size_t>(card.text.data() - cards.data());
        return {cards.substr(0, step), cards.substr(step)};
    }
    return {cards, {}};
}

void add_model_cards(Deck& deck, const std::string& cards)
{
    for (DeckText& text : deck.texts) {
        if (text.place != DeckText::Place::cards) continue;
        const auto [model, steps] = model_and_steps(text.text);
        if (steps.empty()) continue;
        text.text = model + cards + steps;
        return;
    }
    deck.texts.push_back({DeckText::Place::cards, "", cards});
}

std::string unit_comment(const mesh::MeshView& view, std::string_view sign, const std::string& unit)
{
    const std::string line = std::string(sign) + " lengths are in " + unit + "\n";
    const bool is_said = view.kept && (view.kept->head + "\n" + view.kept->cards).find(line) != line.npos;
    return unit.empty() || is_said ? "" : line;
}

void check_numbers(const mesh::MeshView& view, DeckTag most, const std::string& format,
                   const std::string& remedy)
{
    const auto is_high = [&](const mesh::Numbers& numbers, std::size_t count) {
        return count > 0 && numbers.bounds(count).second > most;
    };
    if (is_high(view.point_tags, view.points) ||
        std::ranges::any_of(view.blocks, [&](const auto& block) { return is_high(block.tags, block.count); }))
        throw InvalidInput(Message("io.number_taken", "{} has numbers above {}, the highest that {} allows",
                                   view.source, needed(most), format)
                               .remedy("{}", remedy));
}

void refuse_element(const mesh::MeshView::Block& block, std::string_view format, std::string_view why)
{
    throw InvalidInput(
        Message("io.no_such_element", "{} elements {}{}of {} nodes cannot be written as {}: {}", block.count,
                block.type, block.type.empty() ? "" : " ", shape_info(block.shape).nodes, format, why)
            .remedy("write an MSH file, which has all shapes"));
}

} // namespace lacuna::io
