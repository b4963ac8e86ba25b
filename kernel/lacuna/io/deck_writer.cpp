// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/deck_writer.h>

#include <lacuna/core/error.h>
#include <lacuna/io/deck_file.h>
#include <lacuna/io/detail/abaqus.h>
#include <lacuna/io/detail/cursor.h>
#include <lacuna/io/detail/deck_formats.h>
#include <lacuna/io/detail/mesh_deck.h>
#include <lacuna/io/detail/msh_content.h>
#include <lacuna/io/detail/unv.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

namespace lacuna::io {
namespace {

/// Longer than any double with 17 digits behind the point and the shift of `with_point()`.
constexpr std::size_t kRoom = 400;

/// Digits as to_chars() has them, with a point and a short exponent, a letter before it unless that is 0.
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

bool is_number_start(std::string_view text)
{
    return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) != 0;
}

/// Field 2 of a Nastran line.
std::string_view second_field(std::string_view line)
{
    const std::size_t comma = line.find(',');
    if (comma != std::string_view::npos) {
        line.remove_prefix(comma + 1);
        return trimmed(line.substr(0, line.find(',')));
    }
    if (const std::size_t tab = line.find('\t'); tab != std::string_view::npos) {
        line = trimmed(line.substr(tab));
        return line.substr(0, line.find_first_of(" \t"));
    }
    if (line.size() <= 8) return {};
    return trimmed(line.substr(8, line.substr(0, 8).find('*') == std::string_view::npos ? 8 : 16));
}

void nastran_numbers(std::string_view line, TextNumbers& numbers)
{
    const auto starts = [&](std::string_view word) { return same_word(line.substr(0, word.size()), word); };
    if (starts("SPOINT")) {
        line.remove_prefix(6);
        while (!line.empty()) {
            const std::size_t end = std::min(line.find_first_of(", \t"), line.size());
            if (const auto tag = parse_integer<DeckTag>(line.substr(0, end))) numbers.nodes.insert(*tag);
            line.remove_prefix(std::min(end + 1, line.size()));
        }
        return;
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

/// Call `take(keyword, where its line begins)` for every keyword of an Abaqus text; until it returns false.
template <class Take>
void each_keyword(std::string_view text, const Take& take)
{
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t begin = at;
        std::string words;
        do {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            words += trimmed(text.substr(at, end - at));
            at = end + 1;
        } while (words.starts_with('*') && !words.starts_with("**") && words.ends_with(',') &&
                 at < text.size());
        if (words.starts_with('*') && !words.starts_with("**") && !take(parse_keyword(words), begin)) return;
    }
}

/// Words of a line as numbers; 0 for what is none.
std::vector<std::int64_t> numbers_of(std::string_view line)
{
    std::vector<std::int64_t> numbers;
    while (!(line = trimmed(line)).empty()) {
        const std::size_t length = std::min(line.find_first_of(" \t"), line.size());
        numbers.push_back(parse_integer<std::int64_t>(line.substr(0, length)).value_or(0));
        line.remove_prefix(length);
    }
    return numbers;
}

/// Of a dataset of elements, whose records are head, maybe orientation, nodes.
void unv_numbers(std::string_view text, TextNumbers& numbers)
{
    const auto next = [&] {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        return numbers_of(line);
    };
    next(); // the mark
    const std::vector<std::int64_t> dataset = next();
    while (!text.empty()) {
        const std::vector<std::int64_t> head = next();
        if (head.size() < 6) continue; // blank, or the mark
        numbers.cells.insert(head[0]);
        if (unv_has_orientation(head[1], static_cast<int>(dataset.at(0)))) next();
        for (std::int64_t left = head.back(); left > 0 && !text.empty();)
            left -= static_cast<std::int64_t>(next().size());
    }
}

} // namespace

char* put_real(char* out, double value, std::size_t width, RealForm form)
{
    char best[kRoom], text[kRoom];
    const char letter = form == RealForm::nastran ? '\0' : 'E';
    std::size_t length = with_point(
        best, static_cast<std::size_t>(std::to_chars(best, best + kRoom, value).ptr - best), width, letter);
    if (length > width) {
        double error = HUGE_VAL;
        length = 0;
        for (const auto format : {std::chars_format::fixed, std::chars_format::scientific})
            for (int digits = static_cast<int>(width); digits >= 0; --digits) {
                const auto end = std::to_chars(text, text + kRoom - 10, value, format, digits);
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
    constexpr std::size_t kLongest = 80; // characters that Abaqus and CalculiX take
    const bool abaqus = format == DeckFormat::abaqus;
    const std::string fit = abaqus ? abaqus_name(name) : std::string(name);
    const std::size_t longest = abaqus ? kLongest : fit.npos;
    std::string unique = fit.substr(0, longest);
    for (int i = 2; is_taken(unique); ++i) {
        const std::string number = "_" + std::to_string(i);
        unique = fit.substr(0, longest - number.size()) + number;
    }
    return unique;
}

bool share_names(DeckFormat format, DeckSet::Kind a, DeckSet::Kind b)
{
    constexpr auto kNodes = DeckSet::Kind::nodes;
    return a == b || format == DeckFormat::unv ||
           (format == DeckFormat::abaqus && a != kNodes && b != kNodes);
}

TextNumbers numbers_in_text(const Deck& deck)
{
    TextNumbers numbers;
    bool elements = false; // of an Abaqus deck are read
    for (const DeckText& text : deck.texts) {
        if (text.place == DeckText::Place::head) continue;
        if (deck.format == DeckFormat::unv) {
            if (text.place == DeckText::Place::tail) unv_numbers(text.text, numbers);
            continue;
        }
        for (std::string_view rest = text.text; !rest.empty();) {
            const std::size_t end = std::min(rest.find('\n'), rest.size());
            const std::string_view line = trimmed(rest.substr(0, end));
            if (deck.format == DeckFormat::nastran) {
                nastran_numbers(rest.substr(0, end), numbers);
            } else if (deck.format == DeckFormat::abaqus && line.starts_with('*')) {
                if (!line.starts_with("**")) elements = same_word(line.substr(0, 8), "*ELEMENT");
                if (const Keyword keyword = parse_keyword(line); keyword.name == "SURFACE")
                    numbers.surfaces.push_back(keyword.value("NAME"));
            } else if (elements && is_number_start(line)) {
                const auto tag = parse_integer<DeckTag>(trimmed(line.substr(0, line.find(','))));
                if (tag) numbers.cells.insert(*tag);
            }
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    }
    return numbers;
}

std::vector<std::string> materials_in_text(const Deck& deck)
{
    std::vector<std::string> found;
    const auto add = [&](const std::string& name) {
        if (!name.empty() && std::ranges::find(found, name) == found.end()) found.push_back(name);
    };
    for (const DeckText& text : deck.texts) {
        if (deck.format == DeckFormat::abaqus)
            each_keyword(text.text, [&](const Keyword& keyword, std::size_t) {
                if (keyword.name == "MATERIAL") add(keyword.value("NAME"));
                return true;
            });
        if (deck.format != DeckFormat::nastran || text.place != DeckText::Place::cards) continue;
        for (std::string_view rest = text.text; !rest.empty();) {
            const std::size_t end = std::min(rest.find('\n'), rest.size());
            const std::string_view line = rest.substr(0, end);
            rest.remove_prefix(std::min(end + 1, rest.size()));
            // MAT1 to MAT11 and MATHP; MATS1, MATT1 and the like add to a material of the same number.
            if (!same_word(line.substr(0, 3), "MAT") || line.size() < 5) continue;
            if (std::isdigit(static_cast<unsigned char>(line[3])) == 0 && !same_word(line.substr(3, 2), "HP"))
                continue;
            if (const auto tag = parse_integer<DeckTag>(second_field(line))) add(std::to_string(*tag));
        }
    }
    return found;
}

std::optional<std::string> section_material(const Deck& deck, std::string_view set)
{
    std::optional<std::string> found;
    for (const DeckText& text : deck.texts)
        each_keyword(text.text, [&](const Keyword& keyword, std::size_t) {
            if (is_section(keyword) && same_word(keyword.value("ELSET"), set))
                found = keyword.value("MATERIAL");
            return !found;
        });
    return found;
}

std::pair<std::string, std::string> model_and_steps(const std::string& cards)
{
    std::size_t step = cards.size();
    each_keyword(cards, [&](const Keyword& keyword, std::size_t begin) {
        if (keyword.name != "STEP") return true;
        step = begin;
        return false;
    });
    return {cards.substr(0, step), cards.substr(step)};
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

void refuse_element(const DeckBlock& block, std::string_view format, std::string_view why)
{
    throw InvalidInput("io.no_such_element", std::to_string(block.count()) + " elements " +
                                                 (block.type.empty() ? "" : block.type + " ") + "of " +
                                                 std::to_string(shape_info(block.shape).nodes) +
                                                 " nodes cannot be written as " + std::string(format) + ": " +
                                                 std::string(why));
}

LayeredBulk::LayeredBulk(const Deck& deck, std::vector<BulkPart> own)
    : parts(std::move(own)), sets(deck.sets.size()), set_size(deck.sets.size(), 0)
{
    for (const BulkPart& part : parts) {
        points += part.points();
        hexes.push_back(hexes.back() + part.count(true));
        wedges.push_back(wedges.back() + part.count(false));
    }
    // Numbers rise: those held that are lower than a part's come before its cells.
    std::vector<std::size_t> taken(sets.size(), 0);
    const auto take_held = [&](std::size_t s, std::size_t until) {
        if (until == taken[s]) return;
        sets[s].push_back({set_size[s], nullptr, taken[s]});
        set_size[s] += until - taken[s];
        taken[s] = until;
    };
    for (const BulkPart& part : parts)
        for (const std::size_t s : part.place.sets) {
            const std::vector<DeckTag>& held = deck.sets[s].members;
            take_held(s, static_cast<std::size_t>(std::ranges::lower_bound(held, part.place.first_cell) -
                                                  held.begin()));
            sets[s].push_back({set_size[s], &part});
            set_size[s] += part.mesh.cell_count();
        }
    for (std::size_t s = 0; s < sets.size(); ++s)
        if (!sets[s].empty()) take_held(s, deck.sets[s].members.size());
}

std::size_t BulkReader::made_cell(const BulkPart& part, bool hex, std::size_t e) const
{
    const auto at = static_cast<std::size_t>(&part - layered_->parts.data());
    return hex ? part.kinds.cell(e - layered_->hexes[at])
               : part.kinds.cell(part.kinds.hexes() + (e - layered_->wedges[at]));
}

DeckTag BulkReader::tag(const DeckBlock& block, std::size_t e) const
{
    if (!is_made(block)) return block.tags[e];
    const bool hex = is_of_hexes(block);
    const BulkPart& part = layered_->part_of(hex, e);
    return part.tag(made_cell(part, hex, e));
}

Index BulkReader::region(const DeckBlock& block, std::size_t e) const
{
    return is_made(block) ? layered_->part_of(is_of_hexes(block), e).place.region : block.regions[e];
}

std::vector<BulkReader::MadeRun> BulkReader::made_runs(const DeckBlock& block) const
{
    std::vector<MadeRun> runs;
    if (!is_made(block)) return runs;
    const std::vector<std::size_t>& before = is_of_hexes(block) ? layered_->hexes : layered_->wedges;
    for (std::size_t p = 0; p < layered_->parts.size(); ++p)
        if (before[p] < before[p + 1])
            runs.push_back({before[p], before[p + 1], layered_->parts[p].place.region, &layered_->parts[p]});
    return runs;
}

std::pair<DeckTag, DeckTag> BulkReader::tags(const DeckBlock& block) const
{
    if (!is_made(block)) {
        const auto [low, high] = std::ranges::minmax(block.tags);
        return {low, high};
    }
    std::pair<DeckTag, DeckTag> all{std::numeric_limits<DeckTag>::max(), 0};
    const bool hex = is_of_hexes(block);
    for (const BulkPart& part : layered_->parts) {
        const std::size_t count = part.count(hex), first = hex ? 0 : part.kinds.hexes();
        if (count == 0) continue;
        all.first = std::min(all.first, part.tag(part.kinds.cell(first)));
        all.second = std::max(all.second, part.tag(part.kinds.cell(first + count - 1)));
    }
    return all;
}

std::vector<const BulkPart*> BulkReader::parts_of(Index region) const
{
    std::vector<const BulkPart*> found;
    if (layered_ == nullptr) return found;
    for (const BulkPart& part : layered_->parts)
        if (part.place.region == region) found.push_back(&part);
    return found;
}

std::vector<const BulkPart*> BulkReader::parts_of(const DeckSet& set) const
{
    std::vector<const BulkPart*> found;
    for (const LayeredBulk::Run& run : runs(set))
        if (run.part != nullptr) found.push_back(run.part);
    return found;
}

std::size_t BulkReader::count(const DeckBlock& block) const
{
    if (!is_made(block)) return block.count();
    return is_of_hexes(block) ? layered_->hexes.back() : layered_->wedges.back();
}

DeckFile file_of(const Deck& deck, DeckFormat format, const DeckFileOptions& options,
                 const LayeredBulk* layered)
{
    switch (format) {
    case DeckFormat::nastran:
        return nastran_file(deck, layered);
    case DeckFormat::abaqus:
        return abaqus_file(deck, layered);
    case DeckFormat::exodus:
        return exodus_file(deck, layered);
    case DeckFormat::msh:
        return msh_of_deck(deck, options, layered);
    case DeckFormat::vtu:
        return vtu_of_deck(deck, layered);
    case DeckFormat::vtk:
        return vtk_of_deck(deck, options.binary, layered);
    default:
        return unv_file(deck, layered);
    }
}

namespace {

/// The options, with all groups only where the format holds them.
DeckFileOptions options_for(DeckFormat format, DeckFileOptions options, const OutputPath& path,
                            const RunContext& context)
{
    options.all_groups = format == DeckFormat::msh &&
                         holds_all_groups(options.all_groups, options.msh_version, path, context);
    return options;
}

void write_bulk(const Deck& deck, const LayeredBulk& bulk, DeckFormat format, const DeckFileOptions& options,
                const OutputPath& path, const RunContext& context, const Team* team)
{
    const DeckFile file = file_of(deck, format, options_for(format, options, path, context), &bulk);
    if (team == nullptr || team->rank == 0)
        for (const std::string& note : file.notes) log_line(context, "note: " + path.text() + ": " + note);
    write_file(path, file.sections, file.sizes, context, team);
}

} // namespace

bool is_layered_of_parts(DeckFormat format)
{
    return is_layered(format)
               ? format != DeckFormat::exodus
               : format == DeckFormat::msh || format == DeckFormat::vtu || format == DeckFormat::vtk;
}

bool is_layered(DeckFormat format)
{
    return format == DeckFormat::nastran || format == DeckFormat::abaqus || format == DeckFormat::unv ||
           format == DeckFormat::exodus;
}

void write_deck(const mesh::LayeredMesh& layered, const MeshDeckOptions& options, const OutputPath& path,
                const RunContext& context, const Team* team)
{
    BulkPlace place;
    const Deck deck = deck_without_bulk(layered.mesh, options, place, context);
    std::vector<BulkPart> parts;
    parts.push_back(
        {layered.mesh, std::make_unique<NodeReader>(layered, context), nullptr, std::move(place)});
    write_bulk(deck, LayeredBulk(deck, std::move(parts)), options.format, {}, path, context, team);
}

void write_parts(std::span<const mesh::LayeredPart> parts, DeckFormat format, const DeckFileOptions& file,
                 const OutputPath& path, const RunContext& context, const Team* team)
{
    MeshDeckOptions options;
    options.format = format;
    std::vector<BulkPlace> places;
    const Deck deck = deck_without_bulk(parts, options, false, places, context);
    std::vector<BulkPart> bulk;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const mesh::HexMesh& mesh = parts[p].mesh;
        auto nodes = parts[p].nodes != nullptr
                         ? std::make_unique<NodeReader>(mesh::LayeredMesh{mesh, *parts[p].nodes}, context)
                         : std::make_unique<NodeReader>(mesh);
        bulk.push_back({mesh, std::move(nodes), &parts[p].numbers, std::move(places[p])});
    }
    write_bulk(deck, LayeredBulk(deck, std::move(bulk)), format, file, path, context, team);
}

bool find_deck_format(std::string_view ending, DeckFormat& format)
{
    const DeckFileFormat* found = deck_file_format(ending);
    using enum DeckFormat;
    constexpr DeckFormat kWritten[] = {nastran, abaqus, unv, msh, vtk, vtu, exodus};
    if (found == nullptr || std::ranges::find(kWritten, found->format) == std::end(kWritten)) return false;
    format = found->format;
    return true;
}

namespace {

bool holds_lines(DeckFormat format)
{
    return format == DeckFormat::msh || format == DeckFormat::vtk || format == DeckFormat::vtu;
}

/// The deck without its lines, which sets do not name either.
Deck without_lines(const Deck& deck)
{
    Deck less = deck;
    std::vector<DeckTag> lines;
    std::erase_if(less.blocks, [&](const DeckBlock& block) {
        if (shape_info(block.shape).dimension != 1) return false;
        lines.insert(lines.end(), block.tags.begin(), block.tags.end());
        return true;
    });
    std::ranges::sort(lines);
    for (DeckSet& set : less.sets)
        if (set.kind == DeckSet::Kind::elements)
            std::erase_if(set.members, [&](DeckTag tag) { return std::ranges::binary_search(lines, tag); });
    std::erase_if(less.sets, [](const DeckSet& set) {
        return set.kind == DeckSet::Kind::elements && set.members.empty();
    });
    return less;
}

} // namespace

void write_deck(const Deck& deck, DeckFormat format, const OutputPath& path, const RunContext& context,
                const DeckFileOptions& options)
{
    if (const std::size_t lines = deck.element_count(1); lines > 0 && !holds_lines(format)) {
        log_line(context, path.text() + ": " + std::to_string(lines) + " lines are not written");
        return write_deck(without_lines(deck), format, path, context, options);
    }
    DeckFile file = file_of(deck, format, options_for(format, options, path, context));
    const bool texts = std::ranges::any_of(
        deck.texts, [](const DeckText& text) { return text.place == DeckText::Place::cards; });
    if (format != deck.format && texts)
        file.notes.push_back("materials, loads and other cards of " + deck.path +
                             " are of another format and not carried over");
    if (!file.changed.empty()) file.notes.push_back(file.changed);
    for (const std::string& note : file.notes) log_line(context, "note: " + path.text() + ": " + note);
    write_file(path, file.sections, file.sizes, context);
}

} // namespace lacuna::io
