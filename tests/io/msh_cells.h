// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::test {

/// A named group of an MSH file, with the entities that belong to it.
struct MshGroup {
    int dimension = 0;
    int tag = 0;
    std::string name;
    std::set<int> entities;
};

/// The hexahedra of an MSH file and the faces beside them.
struct MshCells {
    std::vector<Vec3> nodes;
    std::vector<Hex> hexes;      ///< corners
    std::vector<int> hex_entity; ///< volume entity of each
    std::vector<Quad> quads;
    std::vector<int> quad_entity;
    std::vector<MshGroup> groups;
    std::vector<io::DeckBlock> others;
    int order = 1; ///< highest order among the hexahedra
    std::vector<std::string> notes;
};

inline MshCells read_msh_cells(const std::string& path)
{
    io::Deck deck = io::read_deck(path);
    MshCells cells;
    for (const io::DeckSet& set : deck.sets) cells.groups.push_back({0, set.tag, set.name, {}});
    for (const io::DeckBlock& block : deck.blocks) {
        const io::DeckShapeInfo& info = io::shape_info(block.shape);
        const auto take = [&](auto& all, std::vector<int>& entities) {
            for (std::size_t e = 0; e < block.count(); ++e) {
                auto& cell = all.emplace_back();
                std::copy_n(block.element(e).begin(), cell.size(), cell.begin());
                entities.push_back(deck.regions[index(block.regions[e])].tag);
            }
        };
        if (info.corners == 8)
            take(cells.hexes, cells.hex_entity);
        else if (info.dimension == 2 && info.corners == 4)
            take(cells.quads, cells.quad_entity);
        else
            cells.others.push_back(block);
        if (info.corners == 8 && info.nodes > 8) cells.order = 2;
        for (std::size_t s = 0; s < deck.sets.size(); ++s)
            for (std::size_t e = 0; e < block.count(); ++e) {
                if (!std::ranges::binary_search(deck.sets[s].members, block.tags[e])) continue;
                cells.groups[s].dimension = info.dimension;
                cells.groups[s].entities.insert(deck.regions[index(block.regions[e])].tag);
            }
    }
    cells.nodes = std::move(deck.points);
    cells.notes = std::move(deck.notes);
    return cells;
}

} // namespace lacuna::test
