// SPDX-License-Identifier: MIT
#include <lacuna/io/deck_file.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/join_sets.h>

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

namespace lacuna::io {
namespace {

template <class Visit>
void each_element(const Deck& deck, int dimension, const Visit& visit)
{
    for (const DeckBlock& block : deck.blocks)
        if (shape_info(block.shape).dimension == dimension)
            for (std::size_t e = 0; e < block.count(); ++e) visit(block, e);
}

/// For each two-dimensional element, by its corners, the side of a solid that it lies on; side 0: none.
std::map<Quad, DeckSide> sides_below(const Deck& deck)
{
    std::map<Quad, DeckSide> below;
    std::vector<char> on(deck.points.size(), 0);
    each_element(deck, 2, [&](const DeckBlock& block, std::size_t e) {
        below.try_emplace(shell_key(block, e));
        for (const Index point : block.element(e)) on[index(point)] = 1;
    });
    each_element(deck, 3, [&](const DeckBlock& block, std::size_t e) {
        const std::span<const Quad> faces = face_corners(block.shape);
        for (std::size_t f = 0; f < faces.size(); ++f) {
            const Quad key = face_key(block, e, faces[f]);
            if (!std::ranges::all_of(key, [&](Index point) { return point < 0 || on[index(point)] != 0; }))
                continue;
            const auto found = below.find(key);
            if (found != below.end() && found->second.side == 0)
                found->second = {block.tags[e], static_cast<int>(f) + 1};
        }
    });
    return below;
}

} // namespace

Deck skin_as_sets(Deck deck, DeckFormat format)
{
    const Format& from = format_of(deck.format);
    const bool has_faces = from.is_mesh && from.skin == Format::Skin::quads && deck.format != DeckFormat::unv;
    if (!has_faces || format_of(format).skin == Format::Skin::quads) return deck;
    const std::map<Quad, DeckSide> below = sides_below(deck);
    std::unordered_map<DeckTag, std::vector<std::string>> names; // for the elements that become sets
    each_element(deck, 2, [&](const DeckBlock& block, std::size_t e) {
        if (below.at(shell_key(block, e)).side > 0) names[block.tags[e]];
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
    for (DeckBlock& block : deck.blocks) {
        if (shape_info(block.shape).dimension != 2) continue;
        DeckBlock kept{.shape = block.shape, .type = block.type};
        for (std::size_t e = 0; e < block.count(); ++e) {
            const std::span<const Index> nodes = block.element(e);
            const auto found = names.find(block.tags[e]);
            if (found == names.end()) {
                copy_element(block, e, kept);
                continue;
            }
            if (const Index r = block.regions[e]; found->second.empty() && r >= 0) {
                const DeckRegion& region = deck.regions[index(r)];
                found->second.push_back(region.name.empty() ? "surface:" + std::to_string(region.tag)
                                                            : region.name);
            }
            for (const std::string& name : found->second) {
                for (const Index node : nodes) sets[name].first.insert(deck.point_tags[index(node)]);
                sets[name].second.insert(below.at(shell_key(block, e)));
            }
        }
        block = std::move(kept);
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
