// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck_file.h>
#include <lacuna/io/detail/sections.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <algorithm>
#include <array>
#include <functional>
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

/// Append text and all points, each written by `put(index, tag, point, out)` in at most this many bytes.
template <class Put>
Section section_of_points(std::string text, const View& view, std::size_t bytes, Put put)
{
    return {std::move(text), view->points, bytes, [view, put](std::size_t begin, std::size_t end, char* out) {
                Put own = put; // it may have a state
                view->each_point(begin, end, [&](std::span<const Vec3> points) {
                    for (const Vec3& point : points) {
                        out = own(begin, view->point_tags[begin], point, out);
                        ++begin;
                    }
                });
                return out;
            }};
}
/// The same for the cells of a block. @param put  `put(index in the block, tag, region, nodes, out)`
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
/// Append text and all members of a set, each written by `put(index, tag, out)`.
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

/// Content of a file to be written: its sections refer to the view.
struct DeckFile {
    std::vector<Section> sections;
    std::vector<std::string> notes; ///< content that the format cannot hold, a sentence each
    std::string changed{};          ///< sets of the deck that differ in the file; empty: none
    Sizes sizes = Sizes::varying;

    void add(std::string text) { sections.push_back({std::move(text), 0, 0, {}}); }
};

/// The text at one place, of all parts.
std::string text_at(const Deck& deck, DeckText::Place place);

/// A name that is valid in Abaqus: letters, digits, - and _ , starting with a letter.
std::string abaqus_name(std::string_view name);
/// A name that is valid in a format, with a number appended if it is in use.
std::string free_name(std::string_view name, DeckFormat format,
                      const std::function<bool(const std::string&)>& is_taken);
/// Whether sets of two kinds must not have the same name. CalculiX takes a load on a surface for one on the
/// element set of that name, and applies none; a universal file has groups of both nodes and elements.
bool share_names(DeckFormat format, DeckSet::Kind a, DeckSet::Kind b);

/// Whether an Abaqus type word in capitals is an element of this shape.
bool is_abaqus_element(std::string_view type, DeckShape shape);

/// Fields of a Nastran line, separated by commas or, if it has none, by tabs or columns; the first is the
/// card's name.
std::vector<std::string_view> nastran_fields(std::string_view line);

/// Numbers used in the text of a deck.
struct TextNumbers {
    std::set<DeckTag> nodes, cells;
    DeckTag set = 0, property = 0;       ///< the highest ones
    std::vector<std::string> surfaces{}; ///< names in Abaqus
};
TextNumbers numbers_in_text(const Deck& deck);

/// Materials defined in the text of a Nastran or Abaqus deck, by their names there, each once.
std::vector<std::string> materials_in_text(const Deck& deck);
/// The section material of an element set in the text of an Abaqus deck; empty: it has no section.
std::optional<std::string> section_material(const Deck& deck, std::string_view set);
/// Cards of an Abaqus deck before its first step, and from there on.
std::pair<std::string, std::string> model_and_steps(const std::string& cards);
/// Insert model cards before the first step of an Abaqus deck.
void add_model_cards(Deck& deck, const std::string& cards);

/// Start of the exponent of a real number: an E, or only its sign, as in 1.5-3.
enum class RealForm { plain, nastran };

/// The nearest real number of at most `width` characters, with a point. @pre width >= 10
char* put_real(char* out, double value, std::size_t width, RealForm form = RealForm::plain);

inline char* put_words(char* out, std::string_view words) { return words.copy(out, words.size()) + out; }

/// A comment line with the unit of the lengths, after a sign; empty if none is declared or the kept text says
/// it.
std::string unit_comment(const mesh::MeshView& view, std::string_view sign, const std::string& unit);

/// Check that all node and element numbers fit into a format. @throw InvalidInput "io.number_taken"
void check_numbers(const mesh::MeshView& view, DeckTag most, const std::string& format,
                   const std::string& remedy);
/// Refuse elements that a format does not have. @throw InvalidInput always
[[noreturn]] void refuse_element(const mesh::MeshView::Block& block, std::string_view format,
                                 std::string_view why);

} // namespace lacuna::io
