// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/deck_view.h>

#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/texts.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <tuple>

namespace lacuna::io {
namespace {

using mesh::MeshView;
using mesh::Numbers;
using mesh::Ranges;

/// Index of the kind of solids in a block, as in `SweptCells`: 0 hexahedra, 1 wedges.
std::size_t kind_of(DeckShape shape) { return shape_info(shape).corners == 8 ? 0 : 1; }

/// Swept meshes that the deck does not store. Their blocks in the deck are empty.
struct Bulk {
    explicit Bulk(std::span<const BulkPart> own) : parts(own)
    {
        for (const BulkPart& part : parts) {
            points += own_points(part);
            for (const std::size_t set : part.place.sets) of_set[set].push_back(&part);
        }
    }

    /// Number of cells of a shape in the parts before each part; the last entry is the total.
    [[nodiscard]] std::vector<std::size_t> cells_before(DeckShape shape) const
    {
        const std::size_t kind = kind_of(shape);
        std::vector<std::size_t> before{0};
        for (const BulkPart& part : parts)
            before.push_back(before.back() +
                             (part.cells.shapes()[kind] == shape ? part.cells.count[kind] : 0));
        return before;
    }

    /// Number of nodes that no earlier part has.
    static std::size_t own_points(const BulkPart& part)
    {
        return part.numbers != nullptr ? part.numbers->fresh() : part.nodes->count();
    }

    /// Deliver the points [begin, end) of a part, counted from 0 among the points that no earlier part has.
    static void each_own_point(const BulkPart& part, std::size_t begin, std::size_t end,
                               const MeshView::TakePoints& take)
    {
        if (part.numbers == nullptr || part.numbers->known().empty())
            return part.nodes->each_span(begin, end, take);
        std::size_t node = part.numbers->fresh_node(begin);
        const auto& known = part.numbers->known();
        auto next = std::ranges::lower_bound(known, static_cast<Index>(node), {},
                                             &std::pair<Index, Index>::first);
        const auto take_fresh = [&](std::span<const Vec3> nodes) {
            while (!nodes.empty()) {
                const bool is_last = next == known.end() || index(next->first) - node >= nodes.size();
                const std::size_t run = is_last ? nodes.size() : index(next->first) - node;
                if (run > 0) take(nodes.first(run));
                if (!is_last) ++next; // also skip the known node
                const std::size_t passed = is_last ? run : run + 1;
                node += passed;
                nodes = nodes.subspan(passed);
            }
        };
        part.nodes->each_span(node, part.numbers->fresh_node(end - 1) + 1, take_fresh);
    }

    void each_point(std::size_t begin, std::size_t end, const MeshView::TakePoints& take) const
    {
        for (const BulkPart& part : parts) {
            const std::size_t first = part.numbers != nullptr ? index(part.numbers->first()) : 0;
            const std::size_t low = std::max(begin, first), high = std::min(end, first + own_points(part));
            if (low < high) each_own_point(part, low - first, high - first, take);
        }
    }

    /// Write the nodes of the cells [begin, end) of a shape. @param before  as `cells_before()`
    void put_nodes(DeckShape shape, const std::vector<std::size_t>& before, std::size_t begin,
                   std::size_t end, Index* out) const
    {
        auto p = static_cast<std::size_t>(std::ranges::upper_bound(before, begin) - before.begin()) - 1;
        for (; begin < end; ++p) {
            const std::size_t stop = std::min(end, before[p + 1]);
            Index* const last = parts[p].cells.put_nodes(kind_of(shape), begin - before[p], stop - before[p],
                                                         out);
            if (const mesh::NodeNumbers* const numbers = parts[p].numbers)
                std::transform(out, last, out, [&](Index node) { return numbers->of(node); });
            out = last;
            begin = stop;
        }
    }

    [[nodiscard]] Numbers tags(DeckShape shape) const
    {
        const std::size_t kind = kind_of(shape);
        Ranges tags;
        for (const BulkPart& part : parts) {
            if (part.cells.shapes()[kind] != shape) continue;
            const std::size_t in_layer = part.cells.in_layer(kind);
            for (std::size_t i = 0; i < part.cells.count[kind]; i += in_layer) {
                const std::size_t tag = static_cast<std::size_t>(part.place.first_cell) +
                                        part.cells.cell(kind, i);
                tags.add(tag, tag + in_layer);
            }
        }
        return Numbers(std::move(tags));
    }

    /// Number of the parts' cells in a set of the deck.
    [[nodiscard]] std::size_t cells_in(std::size_t set) const
    {
        std::size_t sum = 0;
        if (const auto own = of_set.find(set); own != of_set.end())
            for (const BulkPart* part : own->second) sum += part->mesh.cell_count();
        return sum;
    }

    /// The members of a set of the deck, rising: the stored ones, and all cells of the parts that belong to
    /// it.
    [[nodiscard]] Numbers members(const DeckSet& set, std::size_t number) const
    {
        if (cells_in(number) == 0) return Numbers(set.members);
        Ranges all;
        auto held = set.members.begin();
        const auto take_held = [&](DeckTag below) {
            for (; held != set.members.end() && *held < below; ++held)
                all.add(static_cast<std::size_t>(*held), static_cast<std::size_t>(*held) + 1);
        };
        for (const BulkPart* part : of_set.at(number)) {
            take_held(part->place.first_cell);
            const auto first = static_cast<std::size_t>(part->place.first_cell);
            all.add(first, first + part->mesh.cell_count());
        }
        take_held(std::numeric_limits<DeckTag>::max());
        return Numbers(std::move(all));
    }

    std::span<const BulkPart> parts;
    std::map<std::size_t, std::vector<const BulkPart*>>
        of_set; ///< parts whose cells are in a set of the deck
    std::size_t points = 0;
};

/// Groups the elements of a deck into entities.
class EntityFinder {
public:
    EntityFinder(const Deck& deck, const Bulk& bulk, MeshView& view) : deck_(deck), bulk_(bulk), view_(view)
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
    /// Groups that come from an MSH file keep their tags.
    void keep_tags(const TagPlaces& places)
    {
        for (std::size_t s = 0; s < deck_.sets.size(); ++s) {
            const DeckSet& set = deck_.sets[s];
            if (set.kind != DeckSet::Kind::elements || view_.sets[s].count == 0) continue;
            const DeckTag first = view_.sets[s].members[0];
            if (set.members.empty() || first != set.members.front())
                view_.group_tags.push_back({3, set.name, set.tag}); // the first member is a cell that is
                                                                    // created on writing
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
        std::vector<int> list_of_part(bulk_.parts.size(), 0);
        for (std::size_t p = 0; p < list_of_part.size(); ++p)
            for (const std::size_t s : bulk_.parts[p].place.sets)
                list_of_part[p] = lists_.extended(list_of_part[p], static_cast<int>(s));
        std::size_t e = 0;
        for (std::size_t b = 0; b < deck_.blocks.size(); ++b) {
            const DeckBlock& block = deck_.blocks[b];
            mesh::Runs& runs = view_.blocks[b].entities;
            const int dimension = shape_info(block.shape).dimension;
            const std::vector<std::size_t> before = bulk_.cells_before(block.shape);
            for (std::size_t p = 0; dimension == 3 && p < list_of_part.size(); ++p)
                if (before[p] < before[p + 1])
                    mesh::add_run(runs, before[p + 1],
                                  entity_of(dimension, bulk_.parts[p].place.region, list_of_part[p]));
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

    /// Entities that come from an MSH file keep their tags if these are unique.
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
    const Bulk& bulk_;
    MeshView& view_;
    SetLists lists_;
    std::vector<int> list_, dimension_; ///< for each element: the number of its list of sets, and its
                                        ///< dimension
    std::map<std::tuple<int, Index, int>, Index> known_;
    std::vector<Index> place_of_region_; ///< index of each entity's region
};

MeshView::Block block_of(const DeckBlock& block, const std::shared_ptr<const Bulk>& bulk)
{
    MeshView::Block own;
    own.shape = block.shape;
    own.type = block.type;
    if (!bulk->parts.empty() && shape_info(block.shape).dimension == 3) {
        const std::vector<std::size_t> before = bulk->cells_before(block.shape);
        own.count = before.back();
        own.tags = bulk->tags(block.shape);
        for (std::size_t p = 0; p < bulk->parts.size(); ++p)
            mesh::add_run(own.regions, before[p + 1], bulk->parts[p].place.region);
        own.nodes = [bulk, before, shape = block.shape](std::size_t begin, std::size_t end, Index* out) {
            bulk->put_nodes(shape, before, begin, end, out);
        };
        return own;
    }
    own.count = block.count();
    own.tags = Numbers(block.tags);
    own.nodes = [&block](std::size_t begin, std::size_t end, Index* out) {
        const auto size = static_cast<std::size_t>(shape_info(block.shape).nodes);
        std::copy_n(block.nodes.data() + begin * size, (end - begin) * size, out);
    };
    for (std::size_t e = 0; e < block.count(); ++e) mesh::add_run(own.regions, e + 1, block.regions[e]);
    return own;
}

std::optional<MeshView::KeptText> kept_text(const Deck& deck, DeckFormat format)
{
    // With several instances, names in the kept text would not be valid in a deck of one mesh.
    if (deck.format != format || deck.instances.size() > 1) return {};
    MeshView::KeptText kept;
    kept.head = text_at(deck, DeckText::Place::head);
    kept.cards = text_at(deck, DeckText::Place::cards);
    kept.tail = text_at(deck, DeckText::Place::tail);
    if (!deck.instances.empty()) kept.instance = deck.instances.front().name;
    if (format == DeckFormat::nastran) kept.highest_set = static_cast<int>(numbers_in_text(deck).set);
    kept.points = deck.point_more;
    for (const DeckBlock& block : deck.blocks) kept.cells.emplace_back(block.more);
    return kept;
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

std::shared_ptr<MeshView> view_of(const Deck& deck, const Format& format, std::span<const BulkPart> parts)
{
    const auto bulk = std::make_shared<const Bulk>(parts);
    auto view = std::make_shared<MeshView>();
    view->is_deck = true;
    view->source = deck.path;
    if (bulk->parts.empty()) {
        view->points = deck.points.size();
        view->point_tags = Numbers(deck.point_tags);
        view->each_point = [&deck](std::size_t begin, std::size_t end, const MeshView::TakePoints& take) {
            take(std::span(deck.points).subspan(begin, end - begin));
        };
    } else {
        view->points = bulk->points;
        view->point_tags = Numbers(static_cast<std::size_t>(bulk->parts.front().place.first_node));
        view->each_point = [bulk](std::size_t begin, std::size_t end, const MeshView::TakePoints& take) {
            bulk->each_point(begin, end, take);
        };
    }
    for (const DeckBlock& block : deck.blocks) view->blocks.push_back(block_of(block, bulk));
    for (const DeckRegion& region : deck.regions) view->regions.push_back({region.tag, region.name});
    for (std::size_t s = 0; s < deck.sets.size(); ++s) {
        const DeckSet& set = deck.sets[s];
        MeshView::Set& own = view->sets.emplace_back(MeshView::Set{set.kind, set.tag, set.name});
        own.sides = set.sides;
        own.listed = set.listed;
        own.members = bulk->members(set, s);
        own.count = set.members.size() + bulk->cells_in(s);
    }
    view->contacts = deck.contacts;
    if (format.is_numbered) {
        view->kept = kept_text(deck, format.deck);
        return view;
    }
    EntityFinder(deck, *bulk, *view).find();
    if (deck.format != DeckFormat::msh) view->unnamed = "elements";
    view->boxes = [&deck, bulk, count = view->entities.size()] {
        Eigen::AlignedBox3d box;
        for (const Vec3& point : deck.points) box.extend(point);
        for (const BulkPart& part : bulk->parts)
            for (std::size_t i = 0; i < part.mesh.skin_count(); ++i)
                for (const Index node : skin_nodes(part.mesh, i)) box.extend(part.nodes->on_skin(node));
        return std::vector<Eigen::AlignedBox3d>(count, box);
    };
    return view;
}

} // namespace lacuna::io
