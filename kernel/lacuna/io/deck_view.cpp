// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/deck_view.h>

#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/texts.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <tuple>

namespace lacuna::io {
namespace {

using mesh::MeshView;

/// Groups the elements of a deck into entities.
class EntityFinder {
public:
    EntityFinder(const Deck& deck, const BulkReader& bulk, MeshView& view)
        : deck_(deck), bulk_(bulk), view_(view)
    {
    }

    void find()
    {
        for (const DeckBlock& block : deck_.blocks)
            dimension_.resize(dimension_.size() + block.count(), shape_info(block.shape).dimension);
        const TagPlaces places(element_tags(deck_));
        list_.assign(dimension_.size(), 0);
        for (std::size_t s = 0; s < deck_.sets.size(); ++s) {
            if (deck_.sets[s].kind != DeckSet::Kind::elements) continue;
            for (const DeckTag tag : deck_.sets[s].members)
                if (const Index e = places.find(tag); e >= 0)
                    list_[index(e)] = lists_.extended(list_[index(e)], static_cast<int>(s));
        }
        if (deck_.format == DeckFormat::msh) keep_tags(places);
        find_runs();
        tag_entities();
        list_groups();
    }

private:
    /// Groups of an MSH file keep their tags.
    void keep_tags(const TagPlaces& places)
    {
        for (const DeckSet& set : deck_.sets) {
            if (set.kind != DeckSet::Kind::elements || bulk_.count(set) == 0) continue;
            const DeckTag first = bulk_.member(set, 0);
            if (set.members.empty() || first != set.members.front())
                view_.group_tags.push_back({3, set.name, set.tag}); // a cell created on writing
            else if (const Index e = places.find(first); e >= 0)
                view_.group_tags.push_back({dimension_[index(e)], set.name, set.tag});
        }
    }

    Index entity_of(int dimension, Index region, int list)
    {
        const auto [at, fresh] = known_.try_emplace(std::tuple(dimension, region, list),
                                                    static_cast<Index>(view_.entities.size()));
        if (!fresh) return at->second;
        MeshView::Entity& entity = view_.entities.emplace_back();
        entity.dimension = dimension;
        entity.number = static_cast<int>(view_.entities.size());
        place_of_region_.push_back(region);
        for (const int set : lists_[list]) add_once(entity.groups, deck_.sets[index(set)].name);
        if (region < 0) return at->second;
        const DeckRegion& own = deck_.regions[index(region)];
        entity.region = own.tag;
        add_once(entity.groups, own.name);
        if (!own.name.empty())
            entity.main = static_cast<std::size_t>(std::ranges::find(entity.groups, own.name) -
                                                   entity.groups.begin());
        return at->second;
    }

    void find_runs()
    {
        // All created cells of a part are in the same sets.
        std::map<const BulkPart*, int> list_of_part;
        for (std::size_t s = 0; s < deck_.sets.size(); ++s)
            for (const BulkPart* part : bulk_.parts_of(deck_.sets[s]))
                list_of_part[part] = lists_.extended(list_of_part[part], static_cast<int>(s));
        std::size_t e = 0;
        for (std::size_t b = 0; b < deck_.blocks.size(); ++b) {
            const DeckBlock& block = deck_.blocks[b];
            mesh::Runs& runs = view_.blocks[b].entities;
            const int dimension = shape_info(block.shape).dimension;
            for (const BulkReader::MadeRun& run : bulk_.made_runs(block))
                mesh::add_run(runs, run.end, entity_of(dimension, run.region, list_of_part[run.part]));
            std::pair<Index, int> last{-2, 0};
            Index entity = 0;
            for (std::size_t k = 0; k < block.count(); ++k, ++e) {
                const std::pair<Index, int> key{block.regions[k], list_[e]};
                if (key != last) entity = entity_of(dimension, key.first, key.second);
                last = key;
                mesh::add_run(runs, k + 1, entity);
            }
        }
    }

    /// Entities of an MSH file keep their tags where these are unique.
    void tag_entities()
    {
        std::set<std::pair<int, int>> taken;
        int highest = 0;
        for (std::size_t n = 0; n < view_.entities.size(); ++n) {
            MeshView::Entity& entity = view_.entities[n];
            const bool msh = deck_.format == DeckFormat::msh && place_of_region_[n] >= 0;
            const int own = msh ? entity.region : 0;
            if (own > 0 && taken.insert({entity.dimension, own}).second) entity.tag = own;
            highest = std::max(highest, entity.tag);
        }
        for (MeshView::Entity& entity : view_.entities)
            if (entity.tag == 0) entity.tag = ++highest;
    }

    void list_groups()
    {
        std::map<std::pair<std::string, int>, std::size_t> at;
        for (const MeshView::Entity& entity : view_.entities)
            for (const std::string& name : entity.groups) {
                const auto [place, fresh] = at.try_emplace({name, entity.dimension}, view_.lists.size());
                if (fresh) view_.lists.push_back({name, {}});
                view_.lists[place->second].second.push_back(entity.number);
            }
        for (const auto& [key, place] : at)
            if (key.second == 2 && at.contains({key.first, 3})) view_.lists[place].first += ":faces";
        std::optional<TagPlaces> places;
        for (const DeckSet& set : deck_.sets) {
            if (set.kind != DeckSet::Kind::nodes) continue;
            if (!places) places.emplace(deck_.point_tags);
            std::vector<int> points;
            for (const DeckTag tag : set.members)
                if (const Index point = places->find(tag); point >= 0) points.push_back(point);
            if (!points.empty()) view_.lists.push_back({"nodes:" + set.name, std::move(points)});
        }
    }

    const Deck& deck_;
    const BulkReader& bulk_;
    MeshView& view_;
    SetLists lists_;
    std::vector<int> list_, dimension_; ///< for each element
    std::map<std::tuple<int, Index, int>, Index> known_;
    std::vector<Index> place_of_region_; ///< for each entity
};

MeshView::Block block_of(const DeckBlock& block, const BulkReader& bulk)
{
    MeshView::Block own;
    own.shape = block.shape;
    own.type = block.type;
    own.count = bulk.count(block);
    own.tags = bulk.tag_ranges(block);
    own.nodes = [&block, bulk](std::size_t begin, std::size_t end, Index* out) {
        const auto size = static_cast<std::size_t>(shape_info(block.shape).nodes);
        if (!bulk.is_made(block)) {
            std::copy_n(block.nodes.data() + begin * size, (end - begin) * size, out);
            return;
        }
        for (std::size_t e = begin; e < end; ++e)
            bulk.element(block, e, [&](DeckTag, Index, std::span<const Index> nodes) {
                out = std::ranges::copy(nodes, out).out;
            });
    };
    return own;
}

} // namespace

int SetLists::extended(int list, int set)
{
    const auto [found, fresh] = next_.try_emplace({list, set}, static_cast<int>(lists_.size()));
    if (fresh) {
        lists_.push_back(lists_[index(list)]);
        lists_.back().push_back(set);
    }
    return found->second;
}

std::shared_ptr<MeshView> view_of(const Deck& deck, const BulkReader& bulk)
{
    auto view = std::make_shared<MeshView>();
    view->is_deck = true;
    view->source = deck.path;
    view->points = bulk.points();
    view->point_tags = mesh::Numbers(deck.point_tags);
    view->each_point = [&deck, bulk](std::size_t begin, std::size_t end, const MeshView::TakePoints& take) {
        if (begin < end && end <= deck.points.size())
            return take(std::span(deck.points).subspan(begin, end - begin));
        std::array<Vec3, 512> room; // 12 kB, which fits into the first-level cache
        std::size_t count = 0;
        const auto hand_over = [&] { take(std::span<const Vec3>(room).first(std::exchange(count, 0))); };
        bulk.each_point(begin, end, [&](std::size_t, DeckTag, const Vec3& point) {
            room[count++] = point;
            if (count == room.size()) hand_over();
        });
        if (count > 0) hand_over();
    };
    for (const DeckBlock& block : deck.blocks) view->blocks.push_back(block_of(block, bulk));
    EntityFinder(deck, bulk, *view).find();
    if (deck.format != DeckFormat::msh) view->unnamed = "elements";
    view->boxes = [&deck, bulk, count = view->entities.size()] {
        Eigen::AlignedBox3d box;
        for (const Vec3& point : deck.points) box.extend(point);
        bulk.each_on_skin([&](const Vec3& point) { box.extend(point); });
        return std::vector<Eigen::AlignedBox3d>(count, box);
    };
    return view;
}

mesh::ViewParts parts_of(const Deck& deck, const DeckPartition& partition)
{
    mesh::ViewParts parts;
    parts.parts = partition.parts;
    parts.has_ghosts = partition.lists.size() > 1;
    std::vector<Index> lowest(deck.points.size(),
                              partition.parts - 1);                                // part that owns a point
    std::map<std::pair<Index, Index>, std::map<std::size_t, mesh::Ranges>> ghosts; // by part and list, block
    std::vector<std::vector<Index>> used(index(partition.parts));
    for (std::size_t b = 0; b < deck.blocks.size(); ++b) {
        const DeckBlock& block = deck.blocks[b];
        mesh::Runs& runs = parts.of.emplace_back();
        for (std::size_t e = 0; e < block.count(); ++e) {
            const Index part = partition.part[b][e], list = partition.ghost_of[b][e];
            mesh::add_run(runs, e + 1, part);
            for (const Index node : block.element(e)) {
                lowest[index(node)] = std::min(lowest[index(node)], part);
                used[index(part)].push_back(node);
                for (const int other : partition.lists[index(list)]) used[index(other)].push_back(node);
            }
            if (list != 0) ghosts[{part, list}][b].add(e, e + 1);
        }
    }
    for (Index part = 0; part < partition.parts; ++part) {
        mesh::Ranges own;
        for (std::size_t p = 0; p < lowest.size(); ++p)
            if (lowest[p] == part) own.add(p, p + 1);
        parts.points.emplace_back(part, std::move(own));
        mesh::Ranges& points = parts.used.emplace_back();
        tidy(used[index(part)]);
        for (const Index p : used[index(part)]) points.add(index(p), index(p) + 1);
    }
    for (const auto& [key, blocks] : ghosts)
        for (const auto& [block, cells] : blocks)
            parts.ghosts.push_back({key.first, partition.lists[index(key.second)], block, cells});
    return parts;
}

} // namespace lacuna::io
