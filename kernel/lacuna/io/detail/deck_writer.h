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

/// Common parts of the deck writers. Internal to this folder.
namespace lacuna::io {

/// A mesh whose nodes and cells are not stored in the deck.
struct BulkPart {
    const mesh::HexMesh& mesh;
    std::unique_ptr<const NodeReader> nodes;
    const mesh::NodeNumbers* numbers; ///< of its nodes, from 0; null: its nodes are those of the whole
    BulkPlace place;
    mesh::CellKinds kinds{mesh};

    /// Number of nodes that no earlier part has, and the number of the first.
    [[nodiscard]] std::size_t points() const { return numbers ? numbers->fresh() : nodes->count(); }
    [[nodiscard]] std::size_t first_point() const { return numbers ? index(numbers->first()) : 0; }
    [[nodiscard]] Index number(Index node) const { return numbers ? numbers->of(node) : node; }
    /// Number of cells in blocks of hexahedra, or of wedges.
    [[nodiscard]] std::size_t count(bool hexes) const
    {
        return hexes ? kinds.hexes() : mesh.cell_count() - kinds.hexes();
    }
    [[nodiscard]] DeckTag tag(std::size_t cell) const
    {
        return place.first_cell + static_cast<DeckTag>(cell);
    }
};

/// Meshes that are not stored in the deck. Nodes are numbered from 1.
class LayeredBulk {
public:
    LayeredBulk(const Deck& deck, std::vector<BulkPart> parts);

    std::vector<BulkPart> parts;
    std::size_t points = 0;

    /// For each set of the deck with generated cells: its members, and the parts of these.
    std::vector<mesh::Ranges> sets;
    std::vector<std::vector<const BulkPart*>> parts_of_set;
    /// Number of cells before each part, for hexahedra and wedges; last the total.
    std::vector<std::size_t> hexes{0}, wedges{0};

    /// The part that contains the `i`-th of the hexahedra or wedges.
    [[nodiscard]] const BulkPart& part_of(bool hex, std::size_t i) const
    {
        const std::vector<std::size_t>& before = hex ? hexes : wedges;
        return parts[static_cast<std::size_t>(std::ranges::upper_bound(before, i) - before.begin()) - 1];
    }
};

/// Reads the bulk data of a deck, stored or generated.
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
    /// Call `visit(point)` for the skin nodes of meshes that are not stored in the deck, for some of them
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

    /// Whether a block's elements are generated.
    [[nodiscard]] bool is_made(const DeckBlock& block) const
    {
        return layered_ != nullptr && shape_info(block.shape).dimension == 3;
    }
    [[nodiscard]] std::size_t count(const DeckBlock& block) const;
    /// Call `visit(tag, region, node indices)` for one of them.
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
    /// Elements [begin, end) of a block that are generated for one part, and their region.
    struct MadeRun {
        std::size_t begin, end;
        Index region;
        const BulkPart* part;
    };
    /// In the block's order; empty: the deck stores its elements.
    [[nodiscard]] std::vector<MadeRun> made_runs(const DeckBlock& block) const;
    /// The numbers of a block's elements.
    [[nodiscard]] mesh::Numbers tag_ranges(const DeckBlock& block) const;

    /// Parts with cells of a region, and parts whose cells are all members of a set.
    [[nodiscard]] std::vector<const BulkPart*> parts_of(Index region) const;
    [[nodiscard]] std::vector<const BulkPart*> parts_of(const DeckSet& set) const;

    /// Number of members of a set of nodes or elements.
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
    /// Null: the deck stores all of its members.
    [[nodiscard]] const mesh::Ranges* made(const DeckSet& set) const
    {
        if (layered_ == nullptr || layered_->sets[place_of(set)].count() == 0) return nullptr;
        return &layered_->sets[place_of(set)];
    }
    [[nodiscard]] std::size_t made_cell(const BulkPart& part, bool hex, std::size_t e) const;

    /// Visit the points [begin, end) for which a part is the first to have them.
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

/// Append text and all points, each written by `put(place, tag, point, out)` in at most this many bytes.
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
/// The same for the elements of a block. @param put  `put(index in the block, tag, region, nodes, out)`
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

/// Content of a file to be written: its sections refer to the deck.
struct DeckFile {
    std::vector<Section> sections;
    std::vector<std::string> notes; ///< content that the format cannot hold, a sentence each
    std::string changed{};          ///< sets of the deck that differ in the file; empty: none
    Sizes sizes = Sizes::varying;
};

/// @param layered  the data that `deck_without_bulk()` omitted; null: the deck has all. Sections refer to it.
DeckFile nastran_file(const Deck& deck, const LayeredBulk* layered = nullptr);
DeckFile abaqus_file(const Deck& deck, const LayeredBulk* layered = nullptr);
DeckFile unv_file(const Deck& deck, const LayeredBulk* layered = nullptr);
/// @param layered  of one part
DeckFile exodus_file(const Deck& deck, const LayeredBulk* layered = nullptr);

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

/// Check that all node and element numbers fit into a format. @throw InvalidInput "io.number_taken"
void check_numbers(const Deck& deck, DeckTag most, const std::string& format, const std::string& remedy);
/// Refuse an element that a format does not have. @throw InvalidInput always
[[noreturn]] void refuse_element(std::size_t count, std::string_view type, DeckShape shape,
                                 std::string_view format, std::string_view why);
[[noreturn]] inline void refuse_element(const DeckBlock& block, std::string_view format, std::string_view why)
{
    refuse_element(block.count(), block.type, block.shape, format, why);
}

} // namespace lacuna::io
