// SPDX-License-Identifier: MIT
//
// A deck as Gmsh has it: an entity of every region and list of sets, a physical group of every region or,
// where all are asked for, of every name. All nodes are of the first entity.
#include <lacuna/core/error.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_entities.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/msh_content.h>
#include <lacuna/io/detail/msh_parts.h>
#include <lacuna/io/detail/msh_shapes.h>
#include <lacuna/topology/skin_groups.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

namespace lacuna::io {
namespace {

/// Elements of one block that are of one entity and part.
struct Part {
    std::size_t entity, block;
    std::vector<std::uint32_t> elements;
    Index part = 0;                                          ///< of a partition
    int tag = 0;                                             ///< of the entity they are written under
    std::vector<std::pair<std::size_t, std::size_t>> made{}; ///< elements [first, second), instead

    [[nodiscard]] std::size_t count() const
    {
        std::size_t all = elements.size();
        for (const auto& [begin, end] : made) all += end - begin;
        return all;
    }
    [[nodiscard]] std::size_t element(std::size_t i) const
    {
        if (made.empty()) return elements[i];
        std::size_t run = 0;
        for (; i >= made[run].second - made[run].first; ++run) i -= made[run].second - made[run].first;
        return made[run].first + i;
    }
};

struct Content {
    DeckEntities entities;
    std::vector<int> tag;                   ///< of each entity
    std::vector<std::vector<int>> physical; ///< tags of each entity's groups, rising
    std::vector<PhysicalName> names;
    std::vector<Part> parts;
    std::size_t elements = 0;
    DeckTag first_element = 0, last_element = 0, first_node = 0, last_node = 0;
    Eigen::AlignedBox3d box;
    std::vector<MshPartEntity> of_parts; ///< of a partition; else none
    std::vector<int> ghost_tags;
    std::vector<MshGhosts> ghosts;
    /// Points in the file's order and how many are under one entity of which dimension and tag.
    struct NodeBlock {
        int dimension, tag;
        std::vector<std::uint32_t> points;
    };
    std::vector<NodeBlock> nodes; ///< of a partition; else all are in one
};

/// Groups of an MSH file keep their tags.
void keep_tags(const Deck& deck, const BulkReader& bulk, GroupTags& groups)
{
    std::vector<DeckTag> tags;
    std::vector<int> dimension; // of the elements
    for (const DeckBlock& block : deck.blocks) {
        tags.insert(tags.end(), block.tags.begin(), block.tags.end());
        dimension.resize(tags.size(), shape_info(block.shape).dimension);
    }
    const TagPlaces places(tags, [](Index, Index) {});
    for (const DeckSet& set : deck.sets) {
        if (set.kind != DeckSet::Kind::elements || bulk.count(set) == 0) continue;
        const DeckTag first = bulk.member(set, 0);
        if (set.members.empty() || first != set.members.front())
            groups.keep(3, set.name, set.tag); // a cell that is made
        else if (const Index e = places.find(first); e >= 0)
            groups.keep(dimension[index(e)], set.name, set.tag);
    }
}

/// Physical groups of entities: all, or one each. That is the region's, else the first set's.
/// @return  sets of a deck that was read whose elements are in other groups, in words.
std::string name_groups(const Deck& deck, const BulkReader& bulk, bool all, Content& content)
{
    std::set<std::string> lost;
    GroupTags tags;
    const bool same = deck.format == DeckFormat::msh;
    if (same) keep_tags(deck, bulk, tags);
    std::set<std::pair<int, int>> used; // dimensions and tags
    for (const DeckEntity& entity : content.entities.all) {
        std::vector<std::string> groups = entity.groups;
        if (groups.empty() && !same) groups.emplace_back("elements");
        const std::string region = entity.region < 0 ? "" : deck.regions[index(entity.region)].name;
        if (!all && groups.size() > 1) {
            const std::string one = region.empty() ? groups.front() : region;
            lost.insert(groups.begin(), groups.end());
            lost.erase(one);
            groups = {one};
        }
        content.physical.push_back(tags.tags_of(entity.dimension, groups));
        for (const int tag : content.physical.back()) used.emplace(entity.dimension, tag);
    }
    content.names = tags.take();
    std::erase_if(content.names, [&](const PhysicalName& name) {
        return !used.contains({name.dimension, name.tag});
    });
    std::erase_if(lost, [](const std::string& name) { // what a swept mesh has by itself
        return name == "volume" || topology::is_role_group(name) ||
               topology::is_role_group(name.substr(name.find(':') + 1));
    });
    if (deck.path.empty() || lost.empty()) return {};
    std::string names;
    for (const std::string& name : lost) names += (names.empty() ? "" : ", ") + name;
    return "an element is in one group, so that " + names + (lost.size() > 1 ? " lack" : " lacks") +
           " elements that are in others too; groups = \"all\" keeps them";
}

/// Entities of an MSH file keep their tags, as far as these are one's own.
std::vector<int> entity_tags(const Deck& deck, const DeckEntities& entities)
{
    std::set<std::pair<int, int>> taken;
    int highest = 0;
    std::vector<int> tags;
    for (const DeckEntity& entity : entities.all) {
        const int own = deck.format == DeckFormat::msh && entity.region >= 0
                            ? deck.regions[index(entity.region)].tag
                            : 0;
        tags.push_back(own > 0 && taken.insert({entity.dimension, own}).second ? own : 0);
        highest = std::max(highest, tags.back());
    }
    for (int& tag : tags)
        if (tag == 0) tag = ++highest;
    return tags;
}

/// Nodes are under the first solid of the lowest part that has them.
void part_nodes(const Deck& deck, const DeckPartition& partition, Content& content)
{
    std::vector<Index> part(deck.points.size(), partition.parts);
    for (std::size_t b = 0; b < deck.blocks.size(); ++b)
        for (std::size_t e = 0; e < deck.blocks[b].count(); ++e)
            for (const Index node : deck.blocks[b].element(e))
                part[index(node)] = std::min(part[index(node)], partition.part[b][e]);
    for (int p = 0; p < partition.parts; ++p) {
        const auto solid = std::ranges::find_if(content.of_parts, [&](const MshPartEntity& entity) {
            return entity.dimension == 3 && entity.part == p;
        });
        if (solid != content.of_parts.end()) content.nodes.push_back({3, solid->tag, {}});
    }
    for (std::size_t n = 0; n < part.size(); ++n) {
        const auto at = std::min(index(part[n]), content.nodes.size() - 1);
        content.nodes[at].points.push_back(static_cast<std::uint32_t>(n));
    }
}

/// Give each part of an entity one of its own, and list what are ghosts.
void part_entities(const Deck& deck, const DeckPartition& partition, bool ghosts, Content& content)
{
    int next = 0;
    for (const int tag : content.tag) next = std::max(next, tag);
    std::map<std::pair<std::size_t, Index>, int> tags;
    for (Part& part : content.parts) {
        const auto [at, fresh] = tags.try_emplace({part.entity, part.part}, next + 1);
        part.tag = at->second;
        if (!fresh) continue;
        ++next;
        content.of_parts.push_back({content.entities.all[part.entity].dimension, part.tag,
                                    content.tag[part.entity], part.part, content.physical[part.entity],
                                    content.box});
    }
    part_nodes(deck, partition, content);
    for (int p = 0; ghosts && p < partition.parts; ++p) content.ghost_tags.push_back(++next);
    std::map<std::pair<Index, Index>, std::shared_ptr<std::vector<DeckTag>>> found;
    for (std::size_t b = 0; b < deck.blocks.size(); ++b)
        for (std::size_t e = 0; e < deck.blocks[b].count(); ++e) {
            if (partition.ghost_of[b][e] == 0) continue;
            auto& cells = found[{partition.part[b][e], partition.ghost_of[b][e]}];
            if (!cells) cells = std::make_shared<std::vector<DeckTag>>();
            cells->push_back(deck.blocks[b].tags[e]);
        }
    for (const auto& [key, cells] : found)
        content.ghosts.push_back(
            {cells->size(), key.first, partition.lists[index(key.second)],
             [cells = cells](std::size_t i) { return static_cast<std::uint64_t>((*cells)[i]); }});
}

std::shared_ptr<const Content> content_of(const Deck& deck, const BulkReader& bulk,
                                          const DeckFileOptions& options, DeckFile& file)
{
    const DeckPartition* const partition = options.partition;
    auto content = std::make_shared<Content>();
    content->entities = entities_of(deck, bulk);
    content->tag = entity_tags(deck, content->entities);
    file.changed = name_groups(deck, bulk, options.all_groups, *content);
    for (std::size_t b = 0; b < deck.blocks.size(); ++b) {
        const DeckBlock& block = deck.blocks[b];
        if (std::ranges::find(block.nodes, -1) != block.nodes.end())
            refuse_element(block, "MSH", "some have not all their middle nodes");
        std::map<std::pair<Index, Index>, std::size_t> part; // of entity and part
        for (const BulkReader::MadeRun& run : bulk.made_runs(block)) {
            const Index entity = content->entities.at(b, run.begin);
            const auto [at, fresh] = part.try_emplace({entity, 0}, content->parts.size());
            if (fresh) content->parts.push_back({index(entity), b, {}, 0, content->tag[index(entity)]});
            content->parts[at->second].made.emplace_back(run.begin, run.end);
        }
        for (std::size_t e = 0; e < block.count(); ++e) {
            const Index entity = content->entities.of[b][e];
            const Index own = partition != nullptr ? partition->part[b][e] : 0;
            const auto [at, fresh] = part.try_emplace({entity, own}, content->parts.size());
            if (fresh) content->parts.push_back({index(entity), b, {}, own, content->tag[index(entity)]});
            content->parts[at->second].elements.push_back(static_cast<std::uint32_t>(e));
        }
        content->elements += bulk.count(block);
        if (bulk.count(block) == 0) continue;
        const auto [low, high] = bulk.tags(block);
        content->first_element = content->last_element == 0 ? low : std::min(content->first_element, low);
        content->last_element = std::max(content->last_element, high);
    }
    std::ranges::stable_sort(content->parts, {},
                             [](const Part& part) { return std::pair(part.entity, part.part); });
    if (deck.points.empty() && bulk.points() > 0) {
        content->first_node = 1;
        content->last_node = static_cast<DeckTag>(bulk.points());
    }
    if (!deck.point_tags.empty()) {
        const auto [low, high] = std::ranges::minmax(deck.point_tags);
        content->first_node = low;
        content->last_node = high;
    }
    if (std::min(content->first_node, content->first_element) < 1)
        throw InvalidInput("io.number_taken", deck.path + " has a node or an element of number 0, which an "
                                                          "MSH file cannot hold; write another format");
    for (const Vec3& point : deck.points) content->box.extend(point);
    bulk.each_on_skin([&](const Vec3& point) { content->box.extend(point); });
    if (partition != nullptr) part_entities(deck, *partition, partition->lists.size() > 1, *content);
    const auto count = [&](DeckSet::Kind kind) {
        return static_cast<std::size_t>(std::ranges::count(deck.sets, kind, &DeckSet::kind));
    };
    const std::size_t others = count(DeckSet::Kind::nodes) + count(DeckSet::Kind::sides);
    if (others > 0)
        file.notes.push_back(std::to_string(others) +
                             " sets of nodes or sides are not written: groups of MSH are of elements");
    return content;
}

std::string entities_text(const Content& content, const MshNumbers& numbers)
{
    std::size_t count[4] = {0, 0, 0, 0};
    for (const DeckEntity& entity : content.entities.all) ++count[index(entity.dimension)];
    std::string text = "$Entities\n" +
                       numbers.line(size_of(0), size_of(count[1]), size_of(count[2]), size_of(count[3]));
    for (const int dimension : {1, 2, 3})
        for (std::size_t n = 0; n < content.entities.all.size(); ++n) {
            if (content.entities.all[n].dimension != dimension) continue;
            const Vec3 low = content.box.min(), high = content.box.max();
            text += numbers.line(content.tag[n], low.x(), low.y(), low.z(), high.x(), high.y(), high.z(),
                                 size_of(content.physical[n].size()));
            if (!numbers.binary) text.back() = ' ';
            for (const int tag : content.physical[n]) {
                text += numbers.line(tag);
                if (!numbers.binary) text.back() = ' ';
            }
            text += numbers.line(size_of(0));
        }
    return text + (numbers.binary ? "\n$EndEntities\n" : "$EndEntities\n");
}

template <class Tag>
char* put_nodes(const BulkReader& bulk, DeckShape shape, std::span<const Index> nodes,
                const MshNumbers& numbers, char* out)
{
    const std::span<const std::uint8_t> places = gmsh_places(shape);
    std::array<Tag, 27> tags{};
    for (std::size_t k = 0; k < nodes.size(); ++k)
        tags[places.empty() ? k : places[k]] = static_cast<Tag>(bulk.point_tag(nodes[k]));
    for (std::size_t k = 0; k < nodes.size(); ++k) out = numbers.add(out, tags[k]);
    return numbers.end(out);
}

void add_41(const Deck& deck, const BulkReader& bulk, const std::shared_ptr<const Content>& content,
            const MshNumbers& numbers, DeckFile& file)
{
    const std::string gap = numbers.binary ? "\n" : "";
    std::string text = msh_opening(content->names, "4.1", numbers.binary) + entities_text(*content, numbers);
    if (!content->of_parts.empty())
        text += msh_partitioned(static_cast<int>(content->nodes.size()), content->ghost_tags,
                                content->of_parts, numbers);
    text += "$Nodes\n" + numbers.line(size_of(std::max<std::size_t>(content->nodes.size(), 1)),
                                      size_of(bulk.points()), static_cast<std::uint64_t>(content->first_node),
                                      static_cast<std::uint64_t>(content->last_node));
    const auto put_point = [numbers](const Vec3& point, char* out) {
        for (const double x : point) out = numbers.add(out, x);
        return numbers.end(out);
    };
    /// @param place   of a point in the file's order
    /// @param points  calls back with the points [begin, end) in that order
    const auto add_nodes = [&](int dimension, int tag, std::size_t count, const auto& place,
                               const auto& points) {
        text += numbers.line(dimension, tag, 0, size_of(count));
        file.sections.push_back({text, count, numbers.room(1, 8),
                                 [bulk, place, numbers](std::size_t begin, std::size_t end, char* out) {
                                     for (std::size_t i = begin; i < end; ++i)
                                         out = numbers.end(numbers.add(
                                             out, static_cast<std::uint64_t>(bulk.point_tag(place(i)))));
                                     return out;
                                 }});
        text.clear();
        file.sections.push_back({{},
                                 count,
                                 numbers.room(3, sizeof(Vec3)),
                                 [points, put_point](std::size_t begin, std::size_t end, char* out) {
                                     points(begin, end,
                                            [&](const Vec3& point) { out = put_point(point, out); });
                                     return out;
                                 }});
    };
    const DeckEntity* const first = content->entities.all.empty() ? nullptr : &content->entities.all.front();
    if (content->nodes.empty())
        add_nodes(
            first == nullptr ? 3 : first->dimension, first == nullptr ? 1 : content->tag.front(),
            bulk.points(), [](std::size_t i) { return static_cast<Index>(i); },
            [bulk](std::size_t begin, std::size_t end, const auto& visit) {
                bulk.each_point(begin, end, [&](std::size_t, DeckTag, const Vec3& point) { visit(point); });
            });
    for (std::size_t n = 0; n < content->nodes.size(); ++n) {
        const auto place = [content, n](std::size_t i) {
            return static_cast<Index>(content->nodes[n].points[i]);
        };
        add_nodes(content->nodes[n].dimension, content->nodes[n].tag, content->nodes[n].points.size(), place,
                  [&deck, place](std::size_t begin, std::size_t end, const auto& visit) {
                      for (std::size_t i = begin; i < end; ++i) visit(deck.points[index(place(i))]);
                  });
    }
    std::string head = gap + "$EndNodes\n$Elements\n" +
                       numbers.line(size_of(content->parts.size()), size_of(content->elements),
                                    static_cast<std::uint64_t>(content->first_element),
                                    static_cast<std::uint64_t>(content->last_element));
    for (std::size_t p = 0; p < content->parts.size(); ++p) {
        const Part& part = content->parts[p];
        const DeckBlock& block = deck.blocks[part.block];
        const std::size_t each = static_cast<std::size_t>(shape_info(block.shape).nodes) + 1;
        head += numbers.line(shape_info(block.shape).dimension, part.tag, gmsh_type(block.shape),
                             size_of(part.count()));
        file.sections.push_back(
            {head, part.count(), numbers.room(each, 8 * each),
             [content, p, bulk, &block, numbers](std::size_t begin, std::size_t end, char* out) {
                 const auto put = [&](DeckTag tag, Index, std::span<const Index> nodes) {
                     out = numbers.add(out, static_cast<std::uint64_t>(tag));
                     out = put_nodes<std::uint64_t>(bulk, block.shape, nodes, numbers, out);
                 };
                 for (std::size_t i = begin; i < end; ++i)
                     bulk.element(block, content->parts[p].element(i), put);
                 return out;
             }});
        head.clear();
    }
    file.sections.push_back({head + gap + "$EndElements\n", 0, 0, {}});
    add_ghosts(file.sections, content->ghosts, numbers);
}

/// An element carries one physical group and its entity.
void add_22(const Deck& deck, const BulkReader& bulk, const std::shared_ptr<const Content>& content,
            const MshNumbers& numbers, DeckFile& file)
{
    const std::string gap = numbers.binary ? "\n" : "";
    file.sections.push_back({msh_opening(content->names, "2.2", numbers.binary) + "$Nodes\n" +
                                 std::to_string(bulk.points()) + "\n",
                             bulk.points(), numbers.room(4, 4 + sizeof(Vec3)),
                             [bulk, numbers](std::size_t begin, std::size_t end, char* out) {
                                 bulk.each_point(begin, end,
                                                 [&](std::size_t, DeckTag tag, const Vec3& point) {
                                                     out = numbers.add(out, static_cast<int>(tag));
                                                     for (const double x : point) out = numbers.add(out, x);
                                                     out = numbers.end(out);
                                                 });
                                 return out;
                             }});
    std::string head = gap + "$EndNodes\n$Elements\n" + std::to_string(content->elements) + "\n";
    for (std::size_t p = 0; p < content->parts.size(); ++p) {
        const Part& part = content->parts[p];
        const DeckBlock& block = deck.blocks[part.block];
        const std::size_t each = static_cast<std::size_t>(shape_info(block.shape).nodes) + 5;
        const int type = gmsh_type(block.shape);
        if (numbers.binary) head += numbers.line(type, static_cast<int>(part.count()), 2);
        file.sections.push_back(
            {head, part.count(), numbers.room(each, 4 * (each - 2)),
             [content, p, type, bulk, &block, numbers](std::size_t begin, std::size_t end, char* out) {
                 const Part& of = content->parts[p];
                 const auto put = [&](DeckTag tag, Index, std::span<const Index> nodes) {
                     out = numbers.add(out, static_cast<int>(tag));
                     if (!numbers.binary) out = numbers.add(numbers.add(out, type), 2);
                     const std::vector<int>& physical = content->physical[of.entity];
                     out = numbers.add(out, physical.empty() ? 0 : physical.front());
                     out = numbers.add(out, content->tag[of.entity]);
                     out = put_nodes<int>(bulk, block.shape, nodes, numbers, out);
                 };
                 for (std::size_t i = begin; i < end; ++i) bulk.element(block, of.element(i), put);
                 return out;
             }});
        head.clear();
    }
    file.sections.push_back({head + gap + "$EndElements\n", 0, 0, {}});
}

} // namespace

DeckFile msh_of_deck(const Deck& deck, const DeckFileOptions& options, const LayeredBulk* layered)
{
    DeckFile file;
    file.sizes = options.binary ? Sizes::exact : Sizes::varying;
    const BulkReader bulk(deck, layered);
    const auto content = content_of(deck, bulk, options, file);
    const MshNumbers numbers{options.binary};
    if (options.msh_version == 2.2)
        add_22(deck, bulk, content, numbers, file);
    else
        add_41(deck, bulk, content, numbers, file);
    return file;
}

} // namespace lacuna::io
