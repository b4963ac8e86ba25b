// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck_file.h>
#include <lacuna/io/detail/node_reader.h>
#include <lacuna/io/detail/sections.h>
#include <lacuna/mesh/second_order.h>

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// What the writers of decks share. Internal to this folder.
namespace lacuna::io {

/// Nodes and cells that a deck does not hold, numbered from 1; the cells are of its first region.
struct LayeredBulk {
    const mesh::HexMesh& mesh;
    const NodeReader& nodes;
    mesh::CellKinds kinds{mesh};
};

/// What a deck holds in bulk, or leaves to be made.
class BulkReader {
public:
    BulkReader(const Deck& deck, const LayeredBulk* layered) : deck_(&deck), layered_(layered) {}

    [[nodiscard]] std::size_t points() const
    {
        return layered_ ? layered_->nodes.count() : deck_->points.size();
    }
    /// Call `visit(place, tag, point)` for the points [begin, end).
    template <class Visit>
    void each_point(std::size_t begin, std::size_t end, const Visit& visit) const
    {
        if (layered_ != nullptr)
            return layered_->nodes.each(begin, end, [&](std::size_t n, const Vec3& point) {
                visit(n, static_cast<DeckTag>(n) + 1, point);
            });
        for (std::size_t p = begin; p < end; ++p) visit(p, deck_->point_tags[p], deck_->points[p]);
    }
    [[nodiscard]] DeckTag point_tag(Index place) const
    {
        return layered_ ? DeckTag(place) + 1 : deck_->point_tags[index(place)];
    }

    /// Whether a block's elements are made.
    [[nodiscard]] bool is_made(const DeckBlock& block) const
    {
        return layered_ != nullptr && shape_info(block.shape).dimension == 3;
    }
    [[nodiscard]] std::size_t count(const DeckBlock& block) const;
    /// Call `visit(tag, region, places of the nodes)` for one of them.
    template <class Visit>
    void element(const DeckBlock& block, std::size_t e, const Visit& visit) const
    {
        if (!is_made(block)) return visit(block.tags[e], block.regions[e], block.element(e));
        const std::size_t cell = made_cell(block, e);
        const mesh::CellNodes nodes = mesh::cell_nodes(layered_->mesh, cell);
        visit(static_cast<DeckTag>(cell) + 1, Index{0}, std::span<const Index>(nodes.all()));
    }

    /// Members of a set of nodes or elements; of those made, a set of elements without any is all cells.
    [[nodiscard]] std::size_t count(const DeckSet& set) const
    {
        return is_all(set) ? layered_->mesh.cell_count() : set.members.size();
    }
    [[nodiscard]] DeckTag member(const DeckSet& set, std::size_t i) const
    {
        return is_all(set) ? static_cast<DeckTag>(i) + 1 : set.members[i];
    }
    [[nodiscard]] bool is_all(const DeckSet& set) const
    {
        return layered_ != nullptr && set.kind == DeckSet::Kind::elements && set.members.empty();
    }

private:
    [[nodiscard]] std::size_t made_cell(const DeckBlock& block, std::size_t e) const;

    const Deck* deck_;
    const LayeredBulk* layered_;
};

/// A file to be: sections refer to the deck.
struct DeckFile {
    std::vector<Section> sections;
    std::vector<std::string> notes; ///< what the format cannot hold, a sentence each
    Sizes sizes = Sizes::varying;
};

DeckFile file_of(const Deck& deck, DeckFormat format, const DeckFileOptions& options);
/// @param layered  what `deck_without_bulk()` left out; null: the deck holds all. Sections refer to it.
DeckFile nastran_file(const Deck& deck, const LayeredBulk* layered = nullptr);
DeckFile abaqus_file(const Deck& deck, const LayeredBulk* layered = nullptr);
DeckFile unv_file(const Deck& deck, const LayeredBulk* layered = nullptr);
DeckFile msh_of_deck(const Deck& deck, const DeckFileOptions& options);
DeckFile exodus_file(const Deck& deck, const LayeredBulk* layered = nullptr);
DeckFile vtu_of_deck(const Deck& deck);
DeckFile vtk_of_deck(const Deck& deck, bool binary);

/// Text of one place, all parts.
std::string text_at(const Deck& deck, DeckText::Place place);

/// A name of Abaqus: letters, digits, - and _ , a letter first.
std::string abaqus_name(std::string_view name);

/// Whether Abaqus's word in capitals is an element of this shape.
bool is_abaqus_element(std::string_view type, DeckShape shape);

/// Numbers that the text of a deck takes.
struct TextNumbers {
    std::set<DeckTag> nodes, cells;
    DeckTag set = 0, property = 0; ///< the highest
};
TextNumbers numbers_in_text(const Deck& deck);

/// Materials that the text of a Nastran or Abaqus deck defines, as it calls them, each once.
std::vector<std::string> materials_in_text(const Deck& deck);
/// Whether the text of an Abaqus deck has a section of a set of elements.
bool has_section(const Deck& deck, std::string_view set);
/// Cards of an Abaqus deck up to its first step, and from there on.
std::pair<std::string, std::string> model_and_steps(const std::string& cards);
/// Put cards of the model before the first step of an Abaqus deck.
void add_model_cards(Deck& deck, const std::string& cards);

/// How the exponent of a real number begins: with an E, or with its sign alone, as in 1.5-3.
enum class RealForm { plain, nastran };

/// A real number of at most `width` characters, the nearest of these, with a point. @pre width >= 10
char* put_real(char* out, double value, std::size_t width, RealForm form = RealForm::plain);

inline char* put_words(char* out, std::string_view words) { return words.copy(out, words.size()) + out; }

/// An element that a format does not have. @throw InvalidInput always
[[noreturn]] void refuse_element(const DeckBlock& block, std::string_view format, std::string_view why);

} // namespace lacuna::io
