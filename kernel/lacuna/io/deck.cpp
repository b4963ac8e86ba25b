// SPDX-License-Identifier: MIT
#include <lacuna/io/deck.h>

#include <lacuna/core/error.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/format_table.h>
#include <lacuna/io/detail/input_file.h>
#include <lacuna/io/detail/vtk_cells.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace lacuna::io {
namespace {

/// First bytes by which some file types are recognised, for an error that names the actual type.
struct Beginning {
    std::string_view text, ending;
};
constexpr Beginning kBeginnings[] = {{"# vtk datafile", ".vtk"},  {"<?xml", ".vtu"},
                                     {"<vtkfile", ".vtu"},        {"$meshformat", ".msh"},
                                     {"$comments", ".msh"},       {"$nod", ".msh"},
                                     {"solid ", ".stl"},          {"meshversion", ".mesh"},
                                     {"iso-10303-21", ".step"},   {"cascade topology", ".brep"},
                                     {"dbrep_drawable", ".brep"}, {"*heading", ".inp"},
                                     {"*node", ".inp"},           {"*part", ".inp"},
                                     {"cdf\x01", ".exo"},         {"cdf\x02", ".exo"},
                                     {"cdf\x05", ".exo"},         {"*keyword", ".k"}};

/// Words of the next line that is not a comment.
std::vector<std::string_view> words_of_line(Cursor& cursor)
{
    std::vector<std::string_view> words;
    while (words.empty() && cursor.more()) {
        for (auto word = cursor.word_in_line(); !word.empty(); word = cursor.word_in_line())
            words.push_back(word);
        if (words[0][0] == '#' || words[0].starts_with("!!")) words.clear();
    }
    return words;
}

/// Whether bytes are a binary AVS UCD file. It starts with 7, then has six counts in either byte order
/// (nodes, cells, three kinds of values, corners of all cells). At least four numbers for each cell follow,
/// then the corners and coordinates.
bool is_binary_avs(std::string_view bytes)
{
    constexpr std::int64_t kHead = 1 + 6 * 4;
    if (std::ssize(bytes) < kHead || bytes[0] != 7) return false;
    return std::ranges::any_of(std::array{true, false}, [&](bool big) {
        const auto count = [&](std::size_t k) -> std::int64_t {
            return from_bytes<std::uint32_t>(bytes.data() + 1 + 4 * k, big);
        };
        const std::int64_t nodes = count(0), cells = count(1), corners = count(5);
        return nodes > 0 && cells > 0 && corners >= cells &&
               std::ssize(bytes) >= kHead + 16 * cells + 4 * corners + 12 * nodes;
    });
}

/// The type of a file whose format is not supported although its extension is; empty: unknown.
///
/// HEC-MW starts with a keyword after an exclamation mark. AVS UCD starts with five counts, followed by the
/// number and coordinates of a node.
std::string_view unread_by_content(std::string_view bytes)
{
    if (is_binary_avs(bytes)) return "a binary AVS UCD file";
    constexpr std::size_t kHead = 8192; // number of bytes examined; a larger value also finds types after
                                        // long comments
    Cursor cursor({}, bytes.substr(0, kHead));
    const auto first = words_of_line(cursor), second = words_of_line(cursor);
    if (!first.empty() && first[0].size() > 1 && first[0][0] == '!' &&
        std::isalpha(static_cast<unsigned char>(first[0][1])) != 0)
        return "a HEC-MW mesh";
    const auto is_count = [](std::string_view word) {
        return parse_integer<std::uint32_t>(word).has_value();
    };
    const auto is_real = [](std::string_view word) { return parse_real(word).has_value(); };
    const bool counts = first.size() == 5 && std::ranges::all_of(first, is_count);
    const bool node = second.size() == 4 && std::ranges::all_of(second, is_real);
    return counts && node ? "an AVS UCD file" : std::string_view();
}

/// The extension of the file type that the first bytes identify; empty if they identify none.
std::string_view ending_by_content(std::string_view bytes)
{
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
    const std::string_view head = trimmed(bytes.substr(0, 256));
    for (const Beginning& known : kBeginnings)
        if (same_word(head.substr(0, known.text.size()), known.text)) return known.ending;
    // A universal file: a line -1, then the number of a dataset.
    const std::size_t line = head.find('\n');
    if (line != std::string_view::npos && trimmed(head.substr(0, line)) == "-1" &&
        parse_integer<int>(trimmed(head.substr(line + 1, head.find('\n', line + 1) - line - 1))))
        return ".unv";
    return {};
}

void check_content(const std::string& name, const FormatRow& format, std::string_view bytes)
{
    if (format.read == read_stl && is_binary_stl(bytes)) return;
    if (const std::string_view unread = unread_by_content(bytes); !unread.empty())
        throw InvalidInput(
            Message("io.unreadable",
                    "cannot read {}, line 1: expected {}, found {}, a format that is not supported", name,
                    format.name, found(unread))
                .remedy("export it as .vtu, .unv or .msh"));
    const std::string_view ending = ending_by_content(bytes);
    if (ending.empty() || ending == format.ending) return;
    // A deck of LS-DYNA without its first keyword may look like an Abaqus deck.
    if (format.deck == DeckFormat::dyna && ending == ".inp") return;
    const Format* const other = find_format("file" + std::string(ending));
    // Several endings can mean the same format.
    if (other != nullptr && row_of(*other).read == format.read) return;
    throw InvalidInput(Message("io.unreadable", "cannot read {}, line 1: expected {}, found {}", name,
                               format.name,
                               found(other != nullptr ? std::string(other->name)
                                                      : formatted("the beginning of a {} file", ending)))
                           .remedy("give the file the ending {}", ending));
}

} // namespace

std::size_t Deck::element_count() const
{
    std::size_t count = 0;
    for (const DeckBlock& block : blocks) count += block.count();
    return count;
}

std::size_t Deck::element_count(int dimension) const
{
    std::size_t count = 0;
    for (const DeckBlock& block : blocks)
        if (shape_info(block.shape).dimension == dimension) count += block.count();
    return count;
}

NodesAt nodes_at(const Deck& deck, std::span<const Vec3> places, double tolerance, double scale)
{
    // Sort the points in the box of the places by x, rounded down to multiples of the tolerance, and points
    // of equal rounded x by y. Bisection by y then finds the near points quickly, even if all points have the
    // same x.
    Eigen::AlignedBox3d box;
    for (const Vec3& place : places) box.extend(place);
    box.min().array() -= tolerance;
    box.max().array() += tolerance;
    std::vector<Index> order;
    for (std::size_t p = 0; p < deck.points.size(); ++p)
        if (box.contains(deck.points[p] * scale)) order.push_back(static_cast<Index>(p));
    const auto cell_of = [&](double x) { return tolerance > 0 ? std::floor(x / tolerance) : x; };
    struct Key {
        double x, y;
        auto operator<=>(const Key&) const = default;
    };
    std::vector<Key> keys(deck.points.size());
    for (std::size_t p = 0; p < keys.size(); ++p)
        keys[p] = {cell_of(deck.points[p].x() * scale), deck.points[p].y() * scale};
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return std::pair(keys[index(a)], a) < std::pair(keys[index(b)], b); });
    NodesAt found;
    found.first.push_back(0);
    for (const Vec3& place : places) {
        const std::size_t begin = found.nodes.size();
        const double cell = cell_of(place.x());
        for (double x : {cell - 1, cell, cell + 1}) {
            if (tolerance <= 0 && x != cell) continue;
            auto at = std::lower_bound(order.begin(), order.end(), Key{x, place.y() - tolerance},
                                       [&](Index p, const Key& key) { return keys[index(p)] < key; });
            for (;
                 at != order.end() && keys[index(*at)].x == x && keys[index(*at)].y <= place.y() + tolerance;
                 ++at)
                if ((deck.points[index(*at)] * scale - place).norm() <= tolerance) found.nodes.push_back(*at);
        }
        std::sort(found.nodes.begin() + static_cast<std::ptrdiff_t>(begin), found.nodes.end());
        found.first.push_back(static_cast<Index>(found.nodes.size()));
    }
    return found;
}

Deck read_deck(const std::string& name, std::string_view bytes)
{
    const FormatRow& format = needed_reader(name, {});
    check_content(name, format, bytes);
    Cursor cursor(name, bytes);
    DeckBuilder builder(format.deck);
    format.read(cursor, builder);
    Deck deck = builder.take(name);
    if (deck.format == DeckFormat::vtk || deck.format == DeckFormat::vtu) turn_vtk_wedges(deck);
    return deck;
}

Deck read_deck(const std::string& path, const RunContext& context)
{
    for (const char* cad : {".step", ".stp", ".iges", ".igs", ".brep", ".geo", ".geo_unrolled"})
        if (ending_of(path) == cad) {
            check_file(path);
            throw InvalidInput(Message("io.no_mesh", "{} is a CAD file, which has no mesh", path)
                                   .remedy("`lacuna info` lists its faces"));
        }
    needed_reader(path, {});
    Deck deck = read_deck(path, read_file(path));
    for (const std::string& warning : deck.warnings) log_line(context, formatted("note: {}", warning));
    return deck;
}

std::string ending_of(const std::string& path)
{
    std::string ending = std::filesystem::path(path).extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return ending;
}

} // namespace lacuna::io
