// SPDX-License-Identifier: MIT
#include <lacuna/io/deck_file.h>
#include <lacuna/io/detail/deck_builder.h>

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

namespace lacuna::io {
namespace {

/// For each element, if it is two-dimensional: the side of a solid on which it lies. Side 0: none.
std::vector<DeckSide> sides_below(const Deck& deck)
{
    const std::vector<DeckTag> tags = element_tags(deck);
    std::vector<DeckSide> below(tags.size());
    each_with_same_nodes(deck, [&](std::span<const NumberedCell> alike) {
        const auto solid = std::ranges::find_if(alike, [](const auto& of) { return of.number % 8 > 0; });
        for (const auto& [others, number] : alike)
            if (solid != alike.end() && number % 8 == 0)
                below[number / 8] = {tags[solid->number / 8], static_cast<int>(solid->number % 8)};
    });
    return below;
}

} // namespace

Deck skin_as_sets(Deck deck, DeckFormat format)
{
    const Format& from = format_of(deck.format);
    const bool has_faces = from.is_mesh && from.skin == Format::Skin::quads && deck.format != DeckFormat::unv;
    if (!has_faces || format_of(format).skin == Format::Skin::quads) return deck;
    const std::vector<DeckSide> below = sides_below(deck);
    std::unordered_map<DeckTag, std::vector<std::string>> names; // for each element that becomes sets: the
                                                                 // names of these sets
    each_element(deck, [&](const DeckBlock& block, std::size_t e, std::size_t i) {
        if (below[i].side > 0) names[block.tags[e]];
    });
    for (DeckSet& set : deck.sets)
        if (set.kind == DeckSet::Kind::elements)
            std::erase_if(set.members, [&](DeckTag tag) {
                const auto found = names.find(tag);
                if (found != names.end()) found->second.push_back(set.name);
                return found != names.end();
            });
    std::erase_if(deck.sets, [](const DeckSet& set) {
        return set.kind == DeckSet::Kind::elements && set.members.empty();
    });
    std::map<std::string, std::pair<std::set<DeckTag>, std::set<DeckSide>>> sets; // nodes and sides
    std::size_t first = 0;                                                        // elements before the block
    for (DeckBlock& block : deck.blocks) {
        const std::size_t count = block.count();
        const auto become_sets = [&](std::size_t e) {
            const DeckSide& side = below[first + e];
            if (side.side == 0) return false;
            std::vector<std::string>& own = names.at(block.tags[e]);
            if (const Index r = block.regions[e]; own.empty() && r >= 0) {
                const DeckRegion& region = deck.regions[index(r)];
                own.push_back(region.name.empty() ? "surface:" + std::to_string(region.tag) : region.name);
            }
            for (const std::string& name : own) {
                for (const Index node : block.element(e))
                    sets[name].first.insert(deck.point_tags[index(node)]);
                sets[name].second.insert(side);
            }
            return true;
        };
        if (shape_info(block.shape).dimension == 2) block = without_elements(block, become_sets);
        first += count;
    }
    std::erase_if(deck.blocks, [](const DeckBlock& block) { return block.count() == 0; });
    for (const auto& [name, of] : sets) {
        deck.sets.push_back({DeckSet::Kind::nodes, 0, name, {of.first.begin(), of.first.end()}, {}});
        if (format != DeckFormat::nastran)
            deck.sets.push_back({DeckSet::Kind::sides, 0, name, {}, {of.second.begin(), of.second.end()}});
    }
    return deck;
}

} // namespace lacuna::io
