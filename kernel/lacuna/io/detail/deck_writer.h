// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck_file.h>
#include <lacuna/io/detail/mesh_deck.h>
#include <lacuna/io/detail/node_reader.h>
#include <lacuna/io/detail/sections.h>
#include <lacuna/mesh/second_order.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// What the writers of decks share. Internal to this folder.
namespace lacuna::io {

/// A mesh whose nodes and cells a deck does not hold.
struct BulkPart {
    const mesh::HexMesh& mesh;
    std::unique_ptr<const NodeReader> nodes;
    const mesh::NodeNumbers* numbers; ///< of its nodes, from 0; null: they are the whole's
    BulkPlace place;
    mesh::CellKinds kinds{mesh};

    /// Nodes that no part before it has, and the number of the first.
    [[nodiscard]] std::size_t points() const { return numbers ? numbers->fresh() : nodes->count(); }
    [[nodiscard]] std::size_t first_point() const { return numbers ? index(numbers->first()) : 0; }
    [[nodiscard]] Index number(Index node) const { return numbers ? numbers->of(node) : node; }
    /// Cells that are in blocks of hexahedra, else of wedges.
    [[nodiscard]] std::size_t count(bool hexes) const
    {
        return hexes ? kinds.hexes() : mesh.cell_count() - kinds.hexes();
    }
    [[nodiscard]] DeckTag tag(std::size_t cell) const
    {
        return place.first_cell + static_cast<DeckTag>(cell);
    }
};

/// Meshes that a deck does not hold. Nodes are numbered from 1.
class LayeredBulk {
public:
    LayeredBulk(const Deck& deck, std::vector<BulkPart> parts);

    std::vector<BulkPart> parts;
    std::size_t points = 0;

    /// Of each set of the deck its members, where some are cells that are made, and the parts of these.
    std::vector<mesh::Ranges> sets;
    std::vector<std::vector<const BulkPart*>> parts_of_set;
    /// Cells before those of each part, of hexahedra and of wedges, and all.
    std::vector<std::size_t> hexes{0}, wedges{0};

    /// The part that the `i`-th of the hexahedra or wedges is of.
    [[nodiscard]] const BulkPart& part_of(bool hex, std::size_t i) const
    {
        const std::vector<std::size_t>& before = hex ? hexes : wedges;
        return parts[static_cast<std::size_t>(std::ranges::upper_bound(before, i) - before.begin()) - 1];
    }
};

/// What a deck holds in bulk, or leaves to be made.
class BulkReader {
public:
    BulkReader(const Deck& deck, const LayeredBulk* layered) : deck_(&deck), layered_(layered) {}

    [[nodiscard]] std::size_t points() const { return layered_ ? layered_->points : deck_->points.size(); }
    /// Call `visit(place, tag, point)` for the points [begin, end).
    template <class Visit>
    void each_point(std::size_t begin, std::size_t end, const Visit& visit) const
    {
        if (layered_ == nullptr) {
            for (std::size_t p = begin; p < end; ++p) visit(p, deck_->point_tags[p], deck_->points[p]);
            return;
        }
        for (const BulkPart& part : layered_->parts) {
            const std::size_t first = part.first_point();
            const std::size_t low = std::max(begin, first), high = std::min(end, first + part.points());
            if (low < high) each_of(part, low, high, visit);
        }
    }
    /// Call `visit(point)` for the nodes on the skins of meshes that the deck does not hold, some of them
    /// more than once.
    template <class Visit>
    void each_on_skin(const Visit& visit) const
    {
        if (layered_ == nullptr) return;
        for (const BulkPart& part : layered_->parts)
            for (std::size_t i = 0; i < part.mesh.skin_count(); ++i)
                for (const Index node : skin_quad(part.mesh, i).nodes) visit(part.nodes->on_skin(node));
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
        const bool hex = is_of_hexes(block);
        const BulkPart& part = layered_->part_of(hex, e);
        const std::size_t cell = made_cell(part, hex, e);
        mesh::CellNodes nodes = mesh::cell_nodes(part.mesh, cell);
        if (part.numbers != nullptr)
            for (std::size_t k = 0; k < nodes.count; ++k) nodes.node[k] = part.numbers->of(nodes.node[k]);
        visit(part.tag(cell), part.place.region, std::span<const Index>(nodes.all()));
    }
    /// Elements [begin, end) of a block that are made for one part, and their region.
    struct MadeRun {
        std::size_t begin, end;
        Index region;
        const BulkPart* part;
    };
    /// In the block's order; empty: the deck holds its elements.
    [[nodiscard]] std::vector<MadeRun> made_runs(const DeckBlock& block) const;
    /// Numbers of a block's elements.
    [[nodiscard]] mesh::Numbers tag_ranges(const DeckBlock& block) const;

    /// Parts whose cells are of a region, and those whose cells are all members of a set.
    [[nodiscard]] std::vector<const BulkPart*> parts_of(Index region) const;
    [[nodiscard]] std::vector<const BulkPart*> parts_of(const DeckSet& set) const;

    /// Members of a set of nodes or elements.
    [[nodiscard]] std::size_t count(const DeckSet& set) const
    {
        return made(set) != nullptr ? made(set)->count() : set.members.size();
    }
    [[nodiscard]] DeckTag member(const DeckSet& set, std::size_t i) const
    {
        return made(set) != nullptr ? static_cast<DeckTag>((*made(set))[i]) : set.members[i];
    }

    static bool is_of_hexes(const DeckBlock& block) { return shape_info(block.shape).corners == 8; }

private:
    [[nodiscard]] std::size_t place_of(const DeckSet& set) const
    {
        return static_cast<std::size_t>(&set - deck_->sets.data());
    }
    /// Null: the deck holds all of its members.
    [[nodiscard]] const mesh::Ranges* made(const DeckSet& set) const
    {
        if (layered_ == nullptr || layered_->sets[place_of(set)].count() == 0) return nullptr;
        return &layered_->sets[place_of(set)];
    }
    [[nodiscard]] std::size_t made_cell(const BulkPart& part, bool hex, std::size_t e) const;

    /// Points [begin, end) that a part is the first to have.
    template <class Visit>
    static void each_of(const BulkPart& part, std::size_t begin, std::size_t end, const Visit& visit)
    {
        const auto call = [&](std::size_t place, const Vec3& point) {
            visit(place, static_cast<DeckTag>(place) + 1, point);
        };
        if (part.numbers == nullptr || part.numbers->known().empty()) {
            const std::size_t first = part.first_point();
            part.nodes->each(begin - first, end - first,
                             [&](std::size_t n, const Vec3& point) { call(first + n, point); });
            return;
        }
        const std::size_t first = part.numbers->fresh_node(begin - part.first_point());
        const std::size_t last = part.numbers->fresh_node(end - 1 - part.first_point());
        auto known = std::ranges::lower_bound(part.numbers->known(), static_cast<Index>(first), {},
                                              &std::pair<Index, Index>::first);
        part.nodes->each(first, last + 1, [&](std::size_t n, const Vec3& point) {
            if (known != part.numbers->known().end() && index(known->first) == n)
                ++known;
            else
                call(begin++, point);
        });
    }

    const Deck* deck_;
    const LayeredBulk* layered_;
};

/// Text and all points, each put by `put(place, tag, point, out)` in at most so many bytes.
template <class Put>
Section section_of_points(std::string text, const BulkReader& bulk, std::size_t bytes, Put put)
{
    return {std::move(text), bulk.points(), bytes,
            [bulk, put](std::size_t begin, std::size_t end, char* out) {
                Put own = put; // it may have a state
                bulk.each_point(begin, end, [&](std::size_t place, DeckTag tag, const Vec3& point) {
                    out = own(place, tag, point, out);
                });
                return out;
            }};
}
/// The same of the elements of a block. @param put  `put(place in the block, tag, region, nodes, out)`
template <class Put>
Section section_of_elements(const BulkReader& bulk, const DeckBlock& block, std::size_t bytes, Put put)
{
    return {{}, bulk.count(block), bytes, [bulk, &block, put](std::size_t e, std::size_t end, char* out) {
                Put own = put;
                for (; e < end; ++e)
                    bulk.element(block, e, [&](DeckTag tag, Index region, std::span<const Index> nodes) {
                        out = own(e, tag, region, nodes, out);
                    });
                return out;
            }};
}

/// A file to be: sections refer to the deck.
struct DeckFile {
    std::vector<Section> sections;
    std::vector<std::string> notes; ///< what the format cannot hold, a sentence each
    std::string changed{};          ///< sets of the deck that are other ones in the file; empty: none is
    Sizes sizes = Sizes::varying;
};

/// @param layered  what `deck_without_bulk()` left out; null: the deck holds all. Sections refer to it.
DeckFile nastran_file(const Deck& deck, const LayeredBulk* layered = nullptr);
DeckFile abaqus_file(const Deck& deck, const LayeredBulk* layered = nullptr);
DeckFile unv_file(const Deck& deck, const LayeredBulk* layered = nullptr);
/// @param layered  of one part
DeckFile exodus_file(const Deck& deck, const LayeredBulk* layered = nullptr);

/// Text of one place, all parts.
std::string text_at(const Deck& deck, DeckText::Place place);

/// A name of Abaqus: letters, digits, - and _ , a letter first.
std::string abaqus_name(std::string_view name);
/// A name as a format can hold it, with a number behind it where that is taken.
std::string free_name(std::string_view name, DeckFormat format,
                      const std::function<bool(const std::string&)>& is_taken);
/// Whether sets of two kinds must not have one name. CalculiX takes a load on a surface for one on the set of
/// elements of that name, and applies none; a universal file has groups of both nodes and elements.
bool share_names(DeckFormat format, DeckSet::Kind a, DeckSet::Kind b);

/// Whether Abaqus's word in capitals is an element of this shape.
bool is_abaqus_element(std::string_view type, DeckShape shape);

/// Fields of a Nastran line apart by commas or, where it has none, tabs or columns; the first is the card's
/// name.
std::vector<std::string_view> nastran_fields(std::string_view line);

/// Numbers that the text of a deck takes.
struct TextNumbers {
    std::set<DeckTag> nodes, cells;
    DeckTag set = 0, property = 0;       ///< the highest
    std::vector<std::string> surfaces{}; ///< names of Abaqus
};
TextNumbers numbers_in_text(const Deck& deck);

/// Materials that the text of a Nastran or Abaqus deck defines, as it calls them, each once.
std::vector<std::string> materials_in_text(const Deck& deck);
/// The material of the section of a set of elements in the text of an Abaqus deck; none: it has no section.
std::optional<std::string> section_material(const Deck& deck, std::string_view set);
/// Cards of an Abaqus deck up to its first step, and from there on.
std::pair<std::string, std::string> model_and_steps(const std::string& cards);
/// Put cards of the model before the first step of an Abaqus deck.
void add_model_cards(Deck& deck, const std::string& cards);

/// How the exponent of a real number begins: with an E, or with its sign alone, as in 1.5-3.
enum class RealForm { plain, nastran };

/// A real number of at most `width` characters, the nearest of these, with a point. @pre width >= 10
char* put_real(char* out, double value, std::size_t width, RealForm form = RealForm::plain);

inline char* put_words(char* out, std::string_view words) { return words.copy(out, words.size()) + out; }

/// See that a format has room for all numbers of nodes and elements. @throw InvalidInput "io.number_taken"
void check_numbers(const Deck& deck, DeckTag most, const std::string& format, const std::string& remedy);
/// An element that a format does not have. @throw InvalidInput always
[[noreturn]] void refuse_element(std::size_t count, std::string_view type, DeckShape shape,
                                 std::string_view format, std::string_view why);
[[noreturn]] inline void refuse_element(const DeckBlock& block, std::string_view format, std::string_view why)
{
    refuse_element(block.count(), block.type, block.shape, format, why);
}

} // namespace lacuna::io
