// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck_file.h>
#include <lacuna/io/detail/sections.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Common parts of the writers, and of the code that adds meshes to decks. Internal to this folder.
namespace lacuna::io {

using View = std::shared_ptr<const mesh::MeshView>;

/// Call `visit(i, tag, nodes)` for the cells [begin, end) of a block.
template <class Visit>
void each_cell(const mesh::MeshView::Block& block, std::size_t begin, std::size_t end, const Visit& visit)
{
    std::array<DeckTag, mesh::MeshView::Block::kAtOnce> tags;
    while (begin < end) {
        const std::size_t stop = std::min(begin + tags.size(), end);
        block.tags.each(begin, stop, [&](std::size_t i, DeckTag tag) { tags[i - begin] = tag; });
        block.each_cell(begin, stop, [&](std::size_t i, std::span<const Index> nodes) {
            visit(i, tags[i - begin], nodes);
        });
        begin = stop;
    }
}

/// Writes the points of a view with `put_one(out, point)`.
template <class Put>
Fill fill_points(const View& view, Put put_one)
{
    return [view, put_one](std::size_t begin, std::size_t end, char* out) {
        view->each_point(begin, end, [&](std::span<const Vec3> points) {
            for (const Vec3& point : points) out = put_one(out, point);
        });
        return out;
    };
}
/// Writes numbers with `put_one(out, number)`.
template <class Put>
Fill fill_numbers(mesh::Numbers numbers, Put put_one)
{
    return [all = std::move(numbers), put_one](std::size_t begin, std::size_t end, char* out) {
        all.each(begin, end, [&](std::size_t, std::int64_t number) { out = put_one(out, number); });
        return out;
    };
}
/// A section that consists of `text` and all points. `put(index, tag, point, out)` writes each point in at
/// most `bytes` bytes.
template <class Put>
Section section_of_points(std::string text, const View& view, std::size_t bytes, Put put)
{
    return {std::move(text), view->points, bytes, [view, put](std::size_t begin, std::size_t end, char* out) {
                Put own = put; // a copy, because it may have a state
                view->each_point(begin, end, [&](std::span<const Vec3> points) {
                    for (const Vec3& point : points) {
                        out = own(begin, view->point_tags[begin], point, out);
                        ++begin;
                    }
                });
                return out;
            }};
}
/// A section that consists of all cells of a block. `put(index in the block, tag, region, nodes, out)` writes
/// each cell in at most `bytes` bytes.
template <class Put>
Section section_of_cells(const View& view, std::size_t block, std::size_t bytes, Put put)
{
    return {
        {},
        view->blocks[block].count,
        bytes,
        [view, block, put](std::size_t begin, std::size_t end, char* out) {
            Put own = put;
            const mesh::MeshView::Block& of = view->blocks[block];
            mesh::each_run(of.regions, begin, end, [&](std::size_t first, std::size_t last, Index region) {
                each_cell(of, first, last, [&](std::size_t i, DeckTag tag, std::span<const Index> nodes) {
                    out = own(i, tag, region, nodes, out);
                });
            });
            return out;
        }};
}
/// A section that consists of `text` and some cells of a block. `put(tag, nodes, out)` writes each cell in at
/// most `bytes` bytes.
template <class Put>
Section section_of_cells(std::string text, const View& view, std::size_t block, mesh::Ranges cells,
                         std::size_t bytes, Put put)
{
    const std::size_t count = cells.count();
    return {std::move(text), count, bytes,
            [view, block, put, all = std::move(cells)](std::size_t begin, std::size_t end, char* out) {
                all.each(begin, end, [&](std::size_t first, std::size_t last) {
                    each_cell(view->blocks[block], first, last,
                              [&](std::size_t, DeckTag tag, std::span<const Index> nodes) {
                                  out = put(tag, nodes, out);
                              });
                });
                return out;
            }};
}
/// The cells of a block by their region.
std::map<Index, mesh::Ranges> cells_by_region(const mesh::MeshView::Block& block);

/// A section that consists of `text` and all members of a set. `put(index, tag, out)` writes each member.
template <class Put>
Section section_of_members(std::string text, const View& view, std::size_t set, std::size_t bytes, Put put)
{
    return {std::move(text), view->sets[set].count, bytes,
            [view, set, put](std::size_t begin, std::size_t end, char* out) {
                view->sets[set].members.each(begin, end,
                                             [&](std::size_t i, DeckTag tag) { out = put(i, tag, out); });
                return out;
            }};
}

/// Content of a file to be written. Its sections refer to the view.
struct DeckFile {
    std::vector<Section> sections;
    std::vector<std::string> notes; ///< content that the format cannot hold; one sentence each
    std::string changed{};          ///< sets of the deck that differ in the file; empty: none
    Sizes sizes = Sizes::varying;

    void add(std::string text) { sections.push_back({std::move(text), 0, 0, {}}); }
};

/// All texts of a deck at one place, one after the other.
std::string text_at(const Deck& deck, DeckText::Place place);

/// Convert a name to one that is valid in Abaqus: letters, digits, - and _ , starting with a letter.
std::string abaqus_name(std::string_view name);
/// Convert a name to one that is valid in a format, and append a number if that is in use.
std::string free_name(std::string_view name, DeckFormat format,
                      const std::function<bool(const std::string&)>& is_taken);
/// Whether sets of two kinds must not have the same name. Reasons: CalculiX takes a load on a surface for a
/// load on the element set of the same name, and applies none. In a universal file, a group holds both nodes
/// and elements.
bool share_names(DeckFormat format, DeckSet::Kind a, DeckSet::Kind b);

/// Whether an Abaqus type word (in capitals) is an element of this shape.
bool is_abaqus_element(std::string_view type, DeckShape shape);

/// Fields of a line. They are separated by commas; in a line without commas, by tabs if there are any and
/// `tabs` is set. Otherwise the first field has `first` characters and each later one `width`.
std::vector<std::string_view> split_fields(std::string_view line, std::size_t first, std::size_t width,
                                           bool tabs = false);
/// Fields of a Nastran line, separated by commas, tabs or columns. The first field is the name of the card.
std::vector<std::string_view> nastran_fields(std::string_view line);

/// Numbers used in the text of a deck.
struct TextNumbers {
    std::set<DeckTag> nodes, cells;
    DeckTag set = 0, property = 0;       ///< the highest ones
    std::vector<std::string> surfaces{}; ///< names of surfaces in Abaqus
};
TextNumbers numbers_in_text(const Deck& deck);

/// Materials that the text of a Nastran or Abaqus deck defines, each once, by their names in the text.
std::vector<std::string> materials_in_text(const Deck& deck);
/// The material that a section in the text of an Abaqus deck gives to an element set; empty: there is no
/// section.
std::optional<std::string> section_material(const Deck& deck, std::string_view set);
/// The cards of an Abaqus deck in two parts: before its first step, and from there on.
std::pair<std::string, std::string> model_and_steps(const std::string& cards);
/// Insert model cards before the first step of an Abaqus deck.
void add_model_cards(Deck& deck, const std::string& cards);

/// How the exponent of a real number starts: with an E, or only with its sign, as in 1.5-3.
enum class RealForm { plain, nastran };

/// Write the text of at most `width` characters, with a decimal point, whose value is nearest to `value`.
/// @pre width >= 10
char* put_real(char* out, double value, std::size_t width, RealForm form = RealForm::plain);
std::string real_text(double value, std::size_t width, RealForm form = RealForm::plain);

/// The text of a node or cell; empty: it has none.
std::string_view text_of(mesh::MeshView::TextByIndex texts, std::size_t index);
/// The numbers of all elements of the blocks for which `which(block)` holds, rising.
template <class Which>
std::vector<DeckTag> tags_of_blocks(const mesh::MeshView& view, const Which& which)
{
    std::vector<DeckTag> tags;
    for (const mesh::MeshView::Block& block : view.blocks)
        if (which(block))
            block.tags.each(0, block.count, [&](std::size_t, DeckTag tag) { tags.push_back(tag); });
    std::ranges::sort(tags);
    return tags;
}

/// A word or a number, aligned right in a column.
inline char* put_right(char* out, std::string_view text, std::size_t width)
{
    for (std::size_t k = text.size(); k < width; ++k) *out++ = ' ';
    return put_text(out, text);
}
inline char* put_right(char* out, long long number, std::size_t width)
{
    char text[kNumberBytes];
    return put_right(out, {text, static_cast<std::size_t>(put_text(text, number) - text)}, width);
}

/// A comment line that states the unit of the lengths; `sign` begins a comment. Empty if no unit is declared,
/// or if the kept text states it already.
std::string unit_comment(const mesh::MeshView& view, std::string_view sign, const std::string& unit);

/// The highest number that fits into a field of this many characters.
constexpr DeckTag highest_of(std::size_t characters)
{
    DeckTag highest = 0;
    for (; characters > 0; --characters) highest = 10 * highest + 9;
    return highest;
}
/// Check that all node and element numbers fit into a format. @throw InvalidInput "io.number_taken"
void check_numbers(const mesh::MeshView& view, DeckTag most, const std::string& format,
                   const std::string& remedy);
/// Refuse elements that a format does not have. @throw InvalidInput  always
[[noreturn]] void refuse_element(const mesh::MeshView::Block& block, std::string_view format,
                                 std::string_view why);

} // namespace lacuna::io
