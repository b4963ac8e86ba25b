// SPDX-License-Identifier: MIT
#include <lacuna/io/leave_out.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/core/shared/renumbered.h>
#include <lacuna/io/detail/abaqus.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/texts.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

namespace lacuna::io {
namespace {

bool is_part(const Deck& deck, const DeckRegion& region, std::string_view name)
{
    if (same_word(region.name, name) || same_word(region.part, name)) return true;
    const auto number = parse_integer<int>(name);
    return number && format_of(deck.format).numbers_regions && region.tag == *number;
}

bool is_part(const DeckSet& set, std::string_view name)
{
    return set.kind == DeckSet::Kind::elements && same_word(set.name, name);
}

/// A Nastran card that refers to nodes or elements. `fields` lists the fields with their numbers, counted as
/// in the manuals; 0 stands for all fields of continuation lines.
struct NamingCard {
    std::string_view name, fields;
    bool nodes, elements;
};
constexpr NamingCard kNamingCards[] = {
    {"FORCE", "3", true, false},      {"MOMENT", "3", true, false},     {"SPC", "36", true, false},
    {"SPCD", "36", true, false},      {"SPC1", "0456789", true, false}, {"TEMP", "357", true, false},
    {"PLOAD4", "3", false, true},     {"PLOAD1", "3", false, true},     {"PLOAD2", "0456789", false, true},
    {"SET1", "03456789", true, true}, {"SET3", "03456789", true, true}, {"PLOAD", "456789", true, false},
    {"BSURFS", "06789", false, true}};

/// Reads the cards that name nodes and elements by number.
///
/// `use(node)` is called for the nodes of elements, constraints and frames that are kept as text.
/// `name(card, node, element)` is called for nodes and elements that loads and similar cards name; one of the
/// two numbers may be 0. A number that may be of a node or an element, as in SET1, is passed as both.
struct CardReader {
    std::function<void(DeckTag)> use;
    std::function<void(const std::string& card, DeckTag node, DeckTag element)> name;

    void read(const Deck& deck) const
    {
        for (const DeckText& text : deck.texts) {
            if (deck.format == DeckFormat::nastran && text.place == DeckText::Place::cards)
                read_nastran(text.text);
            else if (deck.format == DeckFormat::abaqus)
                read_abaqus(text.text);
            else if (deck.format == DeckFormat::unv && text.place == DeckText::Place::tail)
                each_whole(text.text, use);
        }
    }

private:
    void read_nastran(std::string_view text) const
    {
        std::string card;
        each_line(text, [&](std::string_view line) {
            const std::vector<std::string_view> fields = nastran_fields(line);
            if (fields.empty()) return;
            const bool goes_on = fields[0].empty() || fields[0][0] == '+' || fields[0][0] == '*';
            if (!goes_on) card = upper(fields[0].substr(0, fields[0].find('*')));
            for (std::size_t f = 1; f < std::min<std::size_t>(fields.size(), 9); ++f)
                if (const auto tag = parse_integer<DeckTag>(fields[f]); tag && *tag > 0)
                    take_nastran(card, goes_on ? 0 : f + 1, *tag);
        });
    }

    /// @param field  numbered as in the manuals, from 2; 0: a field of a continuation line.
    void take_nastran(const std::string& card, std::size_t field, DeckTag tag) const
    {
        const auto starts = [&](std::string_view word) { return card.starts_with(word); };
        const bool frame = starts("CORD1");
        const bool stands = frame || (starts("C") && !starts("CORD")) || starts("RB") || starts("RR") ||
                            starts("RS") || starts("RT") || starts("MPC") || starts("PLOTEL") ||
                            starts("GENEL");
        if (stands && (field == 0 || field > 2)) use(tag);
        const auto naming = std::ranges::find(kNamingCards, card, &NamingCard::name);
        if (naming != std::end(kNamingCards) &&
            naming->fields.find(static_cast<char>('0' + field)) != std::string_view::npos)
            name(card, naming->nodes ? tag : 0, naming->elements ? tag : 0);
    }

    void read_abaqus(std::string_view text) const
    {
        for (const AbaqusCard& card : abaqus_cards(text)) {
            const std::string& word = card.keyword.name;
            if (word == "EQUATION") {
                each_equation_node(card, [&](DeckTag node, bool) { use(node); });
                continue;
            }
            each_data_line(card, [&](std::string_view line) {
                std::string_view others = line;
                const auto first = parse_integer<DeckTag>(next_field(others));
                if (word == "ELEMENT")
                    each_whole(others, use);
                else if (word == "MPC")
                    each_whole(line, use);
                else if (first && word == "KINEMATICCOUPLING") // node, first and last direction
                    use(*first);
                else if (first && (word == "BOUNDARY" || word == "CLOAD" || word == "TEMPERATURE"))
                    name("*" + word, *first, 0);
                else if (first && (word == "DLOAD" || word == "FILM" || word == "DFLUX"))
                    name("*" + word, 0, *first);
            });
        }
    }
};

class Leaver {
public:
    Leaver(const Deck& deck, std::span<const std::string> parts)
        : deck_(deck), parts_(parts), elements_(element_tags(deck)), nodes_(deck.point_tags)
    {
        is_out_.assign(deck.element_count(), 0);
    }

    LeftOut leave_out()
    {
        for (const std::string& part : parts_) mark(part);
        if (const Format& of = format_of(deck_.format); of.is_written && of.skin == Format::Skin::quads)
            mark_skin();
        const std::size_t count = static_cast<std::size_t>(std::ranges::count(is_out_, 1));
        if (count == is_out_.size() && count > 0)
            throw InvalidInput(Message("io.nothing_left",
                                       "without: {} {} all elements of {}, so none would be left", list(),
                                       parts_.size() > 1 ? "are" : "is", deck_.path)
                                   .remedy("leave out fewer parts"));
        find_nodes();
        split_blocks();
        split_points();
        copy_rest();
        filter_sets();
        note(count);
        found_.gone = std::make_shared<const Deck>(std::move(gone_));
        found_.kept.gap.gone.push_back(found_.gone);
        return std::move(found_);
    }

private:
    void mark(const std::string& part)
    {
        if (!has_part(deck_, part)) refuse_part(std::span(&deck_, 1), part);
        for (const DeckTag tag : cells_of_part(deck_, part))
            if (const Index e = elements_.find(tag); e >= 0) is_out_[index(e)] = 1;
    }

    /// If the file stores the skin as elements, remove those on faces of removed solids. If a remaining solid
    /// has the same face, one element stays.
    void mark_skin()
    {
        if (std::ranges::none_of(
                deck_.blocks, [](const DeckBlock& block) { return shape_info(block.shape).dimension == 2; }))
            return;
        each_with_same_nodes(deck_, [&](std::span<const NumberedCell> alike) {
            bool out = false, stays = false;
            for (const auto& [others, number] : alike)
                if (number % 8 > 0) (is_out_[number / 8] != 0 ? out : stays) = true;
            for (const auto& [others, number] : alike)
                if (out && number % 8 == 0 && !std::exchange(stays, false)) is_out_[number / 8] = 1;
        });
    }

    /// Find nodes that only removed elements use.
    void find_nodes()
    {
        std::vector<char> used(deck_.points.size(), 0);
        goes_.assign(used.size(), 0);
        each_element(deck_, [&](const DeckBlock& block, std::size_t e, std::size_t at) {
            for (const Index node : block.element(e))
                if (node >= 0) (is_out_[at] != 0 ? goes_ : used)[index(node)] = 1;
        });
        const auto keep = [&](DeckTag tag) {
            if (const Index node = nodes_.find(tag); node >= 0) used[index(node)] = 1;
        };
        CardReader{keep, [](const std::string&, DeckTag, DeckTag) {}}.read(deck_);
        for (std::size_t p = 0; p < goes_.size(); ++p)
            if (used[p] != 0) goes_[p] = 0;
    }

    void split_blocks()
    {
        std::size_t first = 0; // elements before the block
        for (const DeckBlock& block : deck_.blocks) {
            const auto is_out = [&](std::size_t e) { return is_out_[first + e] != 0; };
            found_.kept.blocks.push_back(without_elements(block, is_out));
            gone_.blocks.push_back(without_elements(block, std::not_fn(is_out)));
            for (const DeckTag tag : gone_.blocks.back().tags)
                found_.kept.gap.cell = std::max(found_.kept.gap.cell, tag);
            first += block.count();
        }
        for (Deck* deck : {&found_.kept, &gone_})
            std::erase_if(deck->blocks, [](const DeckBlock& block) { return block.count() == 0; });
    }

    void add_emptied(const std::string& name)
    {
        std::vector<std::string>& names = found_.kept.gap.names;
        if (!name.empty() && find_word(names, name) == names.end()) names.push_back(name);
    }

    void split_points()
    {
        Deck& kept = found_.kept;
        const auto stays = [&](std::size_t p) { return goes_[p] == 0; };
        kept.points = deck_.points;
        kept.point_tags = deck_.point_tags;
        const std::vector<Index> place = keep_if(kept.points, stays);
        keep_if(kept.point_tags, stays);
        for (std::size_t p = 0; p < place.size(); ++p)
            if (!stays(p)) kept.gap.node = std::max(kept.gap.node, deck_.point_tags[p]);
        for (const auto& [p, text] : deck_.point_more)
            if (stays(p)) kept.point_more.emplace_back(index(place[p]), text);
        for (DeckBlock& block : kept.blocks)
            for (Index& node : block.nodes)
                if (node >= 0) node = place[index(node)];
        kept.instances = deck_.instances;
        for (DeckInstance& instance : kept.instances) {
            const auto begin = goes_.begin() + static_cast<std::ptrdiff_t>(instance.first_point);
            const auto end = begin + static_cast<std::ptrdiff_t>(instance.points);
            instance.first_point -= static_cast<std::size_t>(std::count(goes_.begin(), begin, 1));
            instance.points -= static_cast<std::size_t>(std::count(begin, end, 1));
        }
    }

    void copy_rest()
    {
        Deck &kept = found_.kept, &gone = gone_;
        kept.path = gone.path = deck_.path;
        kept.format = gone.format = deck_.format;
        kept.version = gone.version = deck_.version;
        kept.regions = gone.regions = deck_.regions;
        kept.texts = deck_.texts;
        kept.notes = deck_.notes;
        kept.gap.node = std::max(kept.gap.node, deck_.gap.node);
        kept.gap.cell = std::max(kept.gap.cell, deck_.gap.cell);
        kept.gap.gone = deck_.gap.gone;
        const std::vector<char> left = used_regions(kept), lost = used_regions(gone);
        for (std::size_t r = 0; r < left.size(); ++r)
            if (lost[r] != 0 && left[r] == 0) add_emptied(deck_.regions[r].name);
        for (const std::string& name : deck_.gap.names) add_emptied(name);
        gone.points = deck_.points;
        gone.point_tags = deck_.point_tags;
    }

    [[nodiscard]] bool element_goes(DeckTag tag) const
    {
        const Index e = elements_.find(tag);
        return e >= 0 && is_out_[index(e)] != 0;
    }
    [[nodiscard]] bool node_goes(DeckTag tag) const
    {
        const Index node = nodes_.find(tag);
        return node >= 0 && goes_[index(node)] != 0;
    }

    void filter_sets()
    {
        for (const DeckSet& all : deck_.sets) {
            DeckSet set = all;
            const std::size_t before = set.members.size() + set.sides.size();
            if (set.kind == DeckSet::Kind::nodes)
                std::erase_if(set.members, [&](DeckTag tag) { return node_goes(tag); });
            else
                std::erase_if(set.members, [&](DeckTag tag) { return element_goes(tag); });
            std::erase_if(set.sides, [&](const DeckSide& side) { return element_goes(side.element); });
            const std::size_t after = set.members.size() + set.sides.size();
            if (after < before)
                sets_.push_back(formatted("{} loses {} of {}", set.name, before - after, before));
            if (after == 0 && before > 0) add_emptied(set.name);
            // Record a set of all nodes as if it had lost members, even if it kept all, because the
            // replacement adds nodes.
            if (after < before || after >= deck_.points.size()) gone_.sets.push_back(all);
            found_.kept.sets.push_back(std::move(set));
        }
    }

    [[nodiscard]] std::string list() const { return full_list(parts_, std::identity()); }

    void note(std::size_t elements)
    {
        const auto nodes = std::ranges::count(goes_, 1);
        found_.kept.notes.push_back(
            formatted("{}: without {}: {} elements are left out, and {} nodes that only they use{}{}",
                      deck_.path, list(), elements, nodes, sets_.empty() ? "" : "; ", listed(sets_)));
        std::map<std::string, std::size_t> cards;
        const auto count = [&](const std::string& card, DeckTag node, DeckTag element) {
            if ((node != 0 && node_goes(node)) || (element != 0 && element_goes(element))) ++cards[card];
        };
        CardReader{[](DeckTag) {}, count}.read(deck_);
        for (const auto& [card, times] : cards)
            found_.kept.notes.push_back(formatted("note: {}: {} names nodes or elements that are left out: "
                                                  "{} times. The cards are kept unchanged: edit them by hand",
                                                  deck_.path, card, times));
    }

    const Deck& deck_;
    std::span<const std::string> parts_;
    TagPlaces elements_, nodes_;
    std::vector<char> is_out_; ///< whether each element is left out, for all blocks one after the other
    std::vector<char> goes_;   ///< whether each node is removed
    LeftOut found_;
    Deck gone_;
    std::vector<std::string> sets_; ///< sets that lose members, in words
};

/// The text without the sections of the given sets.
std::string without_sections(std::string_view text, const std::vector<std::string>& sets)
{
    std::string kept;
    for (const AbaqusCard& card : abaqus_cards(text))
        if (!is_section(card.keyword) || find_word(sets, card.keyword.value("ELSET")) == sets.end())
            kept += card.text;
    return kept;
}

} // namespace

bool has_part(const Deck& deck, std::string_view name)
{
    return std::ranges::any_of(deck.regions,
                               [&](const DeckRegion& region) { return is_part(deck, region, name); }) ||
           std::ranges::any_of(deck.sets, [&](const DeckSet& set) { return is_part(set, name); });
}

void refuse_part(std::span<const Deck> decks, const std::string& name)
{
    std::vector<std::string> known;
    std::string paths;
    for (const Deck& deck : decks) {
        paths += (paths.empty() ? "" : ", ") + deck.path;
        for (const DeckRegion& region : deck.regions) add_once(known, region.name);
        for (const DeckSet& set : deck.sets)
            if (set.kind == DeckSet::Kind::elements) add_once(known, set.name);
    }
    throw InvalidInput("io.no_such_part", "without: {} is neither a region nor a property nor a set of {}{}",
                       name, paths,
                       known.empty() ? ", which has none with a name"
                                     : formatted(", which has {}", short_list(known, std::identity())));
}

std::vector<DeckTag> cells_of_part(const Deck& deck, std::string_view name)
{
    std::vector<DeckTag> cells;
    each_element(deck, [&](const DeckBlock& block, std::size_t e, std::size_t) {
        if (block.regions[e] >= 0 && is_part(deck, deck.regions[index(block.regions[e])], name))
            cells.push_back(block.tags[e]);
    });
    for (const DeckSet& set : deck.sets)
        if (is_part(set, name)) cells.insert(cells.end(), set.members.begin(), set.members.end());
    tidy(cells);
    return cells;
}

LeftOut leave_out(const Deck& deck, std::span<const std::string> parts)
{
    return Leaver(deck, parts).leave_out();
}

Deck close_gap(Deck deck, const RunContext& context)
{
    // Two meshes of one surface may differ in area as much as a hexagon is shorter than its circle.
    const auto differs = [](double ratio) { return std::min(ratio, 1 / ratio) < 3 / std::numbers::pi; };
    std::vector<std::string> lost;
    for (const auto& gone : deck.gap.gone)
        for (const DeckSet& set : gone->sets)
            if (differs(deck.gap.replaced[{set.kind, set.name}])) lost.push_back(set.name);
    if (!lost.empty())
        log_line(context, formatted("note: {}: these sets lost members that no mesh fully replaced: {}",
                                    deck.path, listed(lost)));
    std::erase_if(lost, [&](const std::string& name) {
        return std::ranges::any_of(deck.sets, [&](const DeckSet& set) { return same_word(set.name, name); });
    });
    if (!lost.empty())
        log_line(context, formatted("note: {}: these sets are empty and not written; remove lines that use "
                                    "them: {}",
                                    deck.path, listed(lost)));
    deck.gap.gone.clear();
    if (deck.gap.names.empty()) return deck;
    std::vector<std::string> empty; // empty element sets, whose sections are removed
    const std::vector<char> used = used_regions(deck);
    for (const std::string& name : deck.gap.names) {
        bool has_any = false;
        for (std::size_t r = 0; r < used.size(); ++r)
            has_any = has_any || (used[r] != 0 && same_word(deck.regions[r].name, name));
        for (const DeckSet& set : deck.sets)
            has_any = has_any || (is_part(set, name) && !set.members.empty());
        if (!has_any) empty.push_back(name);
    }
    const auto is_gone = [&](const DeckSet& set) {
        return set.members.empty() && set.sides.empty() &&
               find_word(deck.gap.names, set.name) != deck.gap.names.end();
    };
    for (mesh::ContactPair& pair : deck.contacts)
        for (std::size_t& set : pair.sets)
            set -= static_cast<std::size_t>(std::ranges::count_if(std::span(deck.sets).first(set), is_gone));
    std::erase_if(deck.sets, is_gone);
    if (deck.format == DeckFormat::abaqus)
        for (DeckText& text : deck.texts) text.text = without_sections(text.text, empty);
    deck.gap.names.clear();
    return deck;
}

} // namespace lacuna::io
