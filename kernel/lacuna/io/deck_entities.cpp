// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/deck_entities.h>

#include <lacuna/io/detail/deck_builder.h>

#include <algorithm>
#include <tuple>

namespace lacuna::io {

int SetLists::extended(int list, int set)
{
    const auto [found, fresh] = next_.try_emplace({list, set}, static_cast<int>(lists_.size()));
    if (fresh) {
        lists_.push_back(lists_[index(list)]);
        lists_.back().push_back(set);
    }
    return found->second;
}

DeckEntities entities_of(const Deck& deck, const BulkReader& bulk)
{
    std::vector<DeckTag> tags;
    for (const DeckBlock& block : deck.blocks) tags.insert(tags.end(), block.tags.begin(), block.tags.end());
    const TagPlaces places(tags, [](Index, Index) {});
    SetLists lists;
    std::vector<int> list(tags.size(), 0);
    for (std::size_t s = 0; s < deck.sets.size(); ++s) {
        if (deck.sets[s].kind != DeckSet::Kind::elements) continue;
        for (const DeckTag tag : deck.sets[s].members)
            if (const Index e = places.find(tag); e >= 0)
                list[index(e)] = lists.extended(list[index(e)], static_cast<int>(s));
    }

    // All cells of a part that is made are in the same sets.
    std::map<const BulkPart*, int> list_of_part;
    for (std::size_t s = 0; s < deck.sets.size(); ++s)
        for (const BulkPart* part : bulk.parts_of(deck.sets[s]))
            list_of_part[part] = lists.extended(list_of_part[part], static_cast<int>(s));

    DeckEntities found;
    std::map<std::tuple<int, Index, int>, Index> known;
    const auto entity_of = [&](int dimension, Index region, int own_list) {
        const auto [at, fresh] = known.try_emplace(std::tuple(dimension, region, own_list),
                                                   static_cast<Index>(found.all.size()));
        if (fresh) {
            DeckEntity& entity = found.all.emplace_back();
            entity.dimension = dimension;
            entity.region = region;
            for (const int set : lists[own_list]) entity.groups.push_back(deck.sets[index(set)].name);
            if (entity.region >= 0) entity.groups.push_back(deck.regions[index(entity.region)].name);
        }
        return at->second;
    };
    std::size_t e = 0;
    for (const DeckBlock& block : deck.blocks) {
        std::vector<Index>& of = found.of.emplace_back(block.count());
        auto& made = found.made.emplace_back();
        const int dimension = shape_info(block.shape).dimension;
        for (const BulkReader::MadeRun& run : bulk.made_runs(block)) {
            const Index place = entity_of(dimension, run.region, list_of_part[run.part]);
            made.emplace_back(run.end, place);
        }
        std::pair<Index, int> last{-2, 0};
        Index place = 0;
        for (std::size_t b = 0; b < block.count(); ++b, ++e) {
            const std::pair<Index, int> key{block.regions[b], list[e]};
            if (key != last) place = entity_of(dimension, block.regions[b], list[e]);
            last = key;
            of[b] = place;
        }
    }

    std::map<std::pair<std::string, int>, std::size_t> at;
    for (std::size_t n = 0; n < found.all.size(); ++n) {
        std::vector<std::string>& groups = found.all[n].groups;
        std::erase(groups, "");
        for (auto name = groups.begin(); name != groups.end();)
            name = std::find(groups.begin(), name, *name) != name ? groups.erase(name) : name + 1;
        for (const std::string& name : groups) {
            const auto [place, fresh] = at.try_emplace({name, found.all[n].dimension}, found.groups.size());
            if (fresh) found.groups.push_back({name, {}});
            found.groups[place->second].second.push_back(static_cast<int>(n) + 1);
        }
    }
    for (const auto& [key, place] : at)
        if (key.second == 2 && at.contains({key.first, 3})) found.groups[place].first += ":faces";
    return found;
}

} // namespace lacuna::io
