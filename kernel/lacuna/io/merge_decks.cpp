// SPDX-License-Identifier: MIT
#include <lacuna/io/deck_file.h>

#include <lacuna/core/error.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/join_sets.h>
#include <lacuna/io/detail/texts.h>
#include <lacuna/io/shared/units.h>

#include <algorithm>
#include <limits>
#include <ranges>

namespace lacuna::io {
namespace {

/// The values that are in both lists, increasing.
std::vector<DeckTag> in_both(std::vector<DeckTag> a, std::vector<DeckTag> b)
{
    std::ranges::sort(a);
    std::ranges::sort(b);
    std::vector<DeckTag> both;
    std::ranges::set_intersection(a, b, std::back_inserter(both));
    return both;
}

class Merger {
public:
    Merger(Deck& all, const Deck& more, const MergeOptions& options, const RunContext& context)
        : all_(all), more_(more), options_(options), context_(context), same_(all.format == more.format)
    {
    }

    void merge(double scale)
    {
        all_.unit = common_unit(all_.unit, all_.path, more_.unit, more_.path);
        const TextNumbers texts = numbers_in_text(all_), own = numbers_in_text(more_);
        std::vector<DeckTag> nodes = all_.point_tags, cells = element_tags(all_);
        nodes.insert(nodes.end(), texts.nodes.begin(), texts.nodes.end());
        cells.insert(cells.end(), texts.cells.begin(), texts.cells.end());
        std::vector<DeckTag> own_nodes = more_.point_tags, own_cells = element_tags(more_);
        if (same_) {
            own_nodes.insert(own_nodes.end(), own.nodes.begin(), own.nodes.end());
            own_cells.insert(own_cells.end(), own.cells.begin(), own.cells.end());
        }
        check_clash("node", in_both(nodes, own_nodes));
        check_clash("element", in_both(cells, own_cells));
        if (same_ && more_.format != DeckFormat::abaqus) check_clash("property", shared_properties());
        if (same_) check_names();
        if (clashes_) {
            node_offset_ = offset("node", nodes, own_nodes);
            cell_offset_ = offset("element", cells, own_cells);
        }
        add_points(scale);
        const auto first_region = static_cast<Index>(all_.regions.size());
        add_regions();
        add_blocks(first_region);
        const std::size_t first_set = all_.sets.size();
        add_sets();
        for (const std::size_t s : sets_of_all(more_)) all_.sets[first_set + s].of_one_deck = true;
        add_texts();
        all_.path += ", " + more_.path;
        all_.gap.names.insert(all_.gap.names.end(), more_.gap.names.begin(), more_.gap.names.end());
        if (same_ && !clashes_ && scale == 1)
            all_.gap.gone.insert(all_.gap.gone.end(), more_.gap.gone.begin(), more_.gap.gone.end());
        else if (!more_.gap.gone.empty())
            log_line(context_, formatted("note: sets of {} do not get the cells that replace its left-out "
                                         "parts: their names, numbers or units have changed",
                                         more_.path));
        all_.gap.node = std::max(all_.gap.node, more_.gap.node + node_offset_);
        all_.gap.cell = std::max(all_.gap.cell, more_.gap.cell + cell_offset_);
        all_.notes.insert(all_.notes.end(), more_.notes.begin(), more_.notes.end());
    }

private:
    /// Handle numbers that both decks have: refuse them or, if renumbering is allowed, record the clash.
    void check_clash(const char* what, const std::vector<DeckTag>& both)
    {
        if (both.empty()) return;
        clashes_ = true;
        if (options_.renumber) return;
        refuse(numbered(what, both.front()), both.size());
    }

    [[noreturn]] void refuse(const Argument& first, std::size_t count) const
    {
        throw InvalidInput(Message("io.numbers_clash", "option 'with': {} is in {} and in {}{}", first,
                                   all_.path, more_.path,
                                   count > 1 ? formatted(", and so are {} more", count - 1) : "")
                               .remedy("renumber = true gives the entities of the later deck new numbers and "
                                       "names, and omits its cards, which use the old ones"));
    }

    [[nodiscard]] std::vector<DeckTag> shared_properties() const
    {
        const auto tags = [](const Deck& deck) {
            const auto of_all = std::views::transform(deck.regions, &DeckRegion::tag);
            return std::vector<DeckTag>(of_all.begin(), of_all.end());
        };
        return in_both(tags(all_), tags(more_));
    }

    [[nodiscard]] static bool has_set(const Deck& deck, const DeckSet& wanted, const std::string& name)
    {
        return std::ranges::any_of(deck.sets, [&](const DeckSet& set) {
            return set.kind == wanted.kind && same_word(set.name, name);
        });
    }

    /// Check the names of sets and materials, because cards refer to them.
    void check_names()
    {
        std::vector<std::string> both;
        for (const DeckSet& set : more_.sets)
            if (has_set(all_, set, set.name)) both.push_back("the set " + set.name);
        const std::vector<std::string> known = materials_in_text(all_);
        for (const std::string& name : materials_in_text(more_))
            if (find_word(known, name) != known.end()) both.push_back("material " + name);
        if (both.empty()) return;
        clashes_ = true;
        if (!options_.renumber) refuse(both.front(), both.size());
    }

    static DeckTag offset(const char* what, const std::vector<DeckTag>& taken,
                          const std::vector<DeckTag>& own)
    {
        if (in_both(taken, own).empty()) return 0;
        const DeckTag highest = *std::ranges::max_element(taken), last = *std::ranges::max_element(own);
        if (highest + last > std::numeric_limits<Index>::max())
            throw InvalidInput(
                Message("io.number_taken",
                        "option 'with': the highest {} would get the number {}, above the limit of {}", what,
                        highest + last, std::numeric_limits<Index>::max())
                    .remedy("lower the numbers in the decks"));
        return highest;
    }

    void add_points(double scale)
    {
        first_point_ = static_cast<Index>(all_.points.size());
        for (const Vec3& p : more_.points) all_.points.push_back(scale == 1 ? p : Vec3(p * scale));
        for (const DeckTag tag : more_.point_tags) all_.point_tags.push_back(tag + node_offset_);
        if (!same_ || clashes_) return; // `point_more` names frames, which are defined on cards
        for (const auto& [at, text] : more_.point_more)
            all_.point_more.emplace_back(index(first_point_) + at, text);
    }

    void add_regions()
    {
        const DeckTag property = numbers_in_text(all_).property;
        int highest = highest_tag(
            all_.regions, static_cast<int>(std::min<DeckTag>(property, std::numeric_limits<int>::max() / 2)));
        for (DeckRegion region : more_.regions) {
            const bool taken = std::ranges::any_of(
                all_.regions, [&](const DeckRegion& other) { return other.tag == region.tag; });
            if (taken) region.tag = highest + 1;
            highest = std::max(highest, region.tag);
            all_.regions.push_back(std::move(region));
        }
    }

    void add_blocks(Index first_region)
    {
        for (const DeckBlock& block : more_.blocks) {
            const std::string type = same_ ? block.type : std::string();
            DeckBlock& to = all_.blocks[block_of(all_.blocks, block.shape, type)];
            const std::size_t before = to.count();
            append_block(block, first_point_, first_region, cell_offset_, to);
            if (!same_ || clashes_) continue;
            for (const auto& [at, text] : block.more) to.more.emplace_back(before + at, text);
        }
    }

    void add_sets()
    {
        int tag = highest_tag(all_.sets);
        for (DeckSet set : more_.sets) {
            const std::string name = set.name;
            for (int i = 2; has_set(all_, set, set.name); ++i) set.name = name + "_" + std::to_string(i);
            if (set.tag > 0) set.tag = ++tag;
            raise_numbers(set, node_offset_, cell_offset_);
            all_.sets.push_back(std::move(set));
        }
    }

    void add_texts()
    {
        const bool any = std::ranges::any_of(
            more_.texts, [](const DeckText& text) { return text.place == DeckText::Place::cards; });
        if (!any) return;
        if (!same_ || clashes_ || !more_.instances.empty()) {
            log_line(context_, formatted("cards of {} are left out: {}", more_.path,
                                         !same_     ? "they are of another format"
                                         : clashes_ ? "they refer to numbers and sets that have changed"
                                                    : "they refer to nodes by instance"));
            return;
        }
        if (all_.format != DeckFormat::abaqus) {
            for (const DeckText& text : more_.texts)
                if (text.place == DeckText::Place::cards) all_.texts.push_back(text);
            return;
        }
        const auto [model, steps] = model_and_steps(text_at(more_, DeckText::Place::cards));
        if (!steps.empty())
            log_line(context_, formatted("the steps of {} are not written; those of the first deck are kept",
                                         more_.path));
        add_model_cards(all_, model);
    }

    Deck& all_;
    const Deck& more_;
    const MergeOptions& options_;
    const RunContext& context_;
    bool same_, clashes_ = false;
    DeckTag node_offset_ = 0, cell_offset_ = 0;
    Index first_point_ = 0;
};

} // namespace

Deck merge_decks(std::span<const DeckInScale> decks, const MergeOptions& options, const RunContext& context)
{
    if (decks.empty())
        throw InvalidInput(Message("io.no_file", "no deck was given").remedy("name at least one"));
    Deck all = *decks.front().deck;
    for (const std::size_t s : sets_of_all(all)) all.sets[s].of_one_deck = decks.size() > 1;
    for (const DeckInScale& more : decks.subspan(1))
        Merger(all, *more.deck, options, context).merge(more.scale / decks.front().scale);
    return all;
}

} // namespace lacuna::io
