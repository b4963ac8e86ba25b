// SPDX-License-Identifier: MIT
//
// A deck as Gmsh has it: an entity of every region and list of sets, a physical group of every name. All
// nodes are of the first entity.
#include <lacuna/core/error.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_entities.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/msh_content.h>
#include <lacuna/io/detail/msh_shapes.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

namespace lacuna::io {
namespace {

/// Elements of one block that are of one entity.
struct Part {
    std::size_t entity, block;
    std::vector<std::uint32_t> elements;
};

struct Content {
    DeckEntities entities;
    std::vector<int> tag;                   ///< of each entity
    std::vector<std::vector<int>> physical; ///< tags of each entity's groups, rising
    std::vector<int> smallest;              ///< of these the one with the fewest elements
    std::vector<PhysicalName> names;
    std::vector<Part> parts;
    std::size_t elements = 0;
    DeckTag first_element = 0, last_element = 0, first_node = 0, last_node = 0;
    Eigen::AlignedBox3d box;
};

/// Groups of an MSH file keep their tags.
void keep_tags(const Deck& deck, GroupTags& groups)
{
    std::vector<DeckTag> tags;
    std::vector<int> dimension; // of the elements
    for (const DeckBlock& block : deck.blocks) {
        tags.insert(tags.end(), block.tags.begin(), block.tags.end());
        dimension.resize(tags.size(), shape_info(block.shape).dimension);
    }
    const TagPlaces places(tags, [](Index, Index) {});
    for (const DeckSet& set : deck.sets) {
        if (set.kind != DeckSet::Kind::elements || set.members.empty()) continue;
        if (const Index e = places.find(set.members.front()); e >= 0)
            groups.keep(dimension[index(e)], set.name, set.tag);
    }
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

std::shared_ptr<const Content> content_of(const Deck& deck, DeckFile& file)
{
    auto content = std::make_shared<Content>();
    content->entities = entities_of(deck);
    content->tag = entity_tags(deck, content->entities);
    GroupTags groups;
    const bool same = deck.format == DeckFormat::msh;
    if (same) keep_tags(deck, groups);
    for (const DeckEntity& entity : content->entities.all)
        content->physical.push_back(groups.tags_of(entity.dimension, entity.groups, same ? "" : "elements"));
    content->names = groups.take();
    std::map<std::pair<int, int>, std::size_t> size; // of each group, by dimension and tag
    const auto dimension = [&](std::size_t n) { return content->entities.all[n].dimension; };
    for (std::size_t n = 0; n < content->physical.size(); ++n)
        for (const int tag : content->physical[n])
            size[{dimension(n), tag}] += content->entities.all[n].count;
    for (std::size_t n = 0; n < content->physical.size(); ++n) {
        const auto least = std::ranges::min_element(
            content->physical[n], {}, [&](int tag) { return size[std::pair(dimension(n), tag)]; });
        content->smallest.push_back(least == content->physical[n].end() ? 0 : *least);
    }
    std::vector<std::vector<Index>> place(content->entities.all.size());
    for (std::size_t b = 0; b < deck.blocks.size(); ++b) {
        const DeckBlock& block = deck.blocks[b];
        if (std::ranges::find(block.nodes, -1) != block.nodes.end())
            refuse_element(block, "MSH", "some have not all their middle nodes");
        std::vector<Index> part(content->entities.all.size(), -1);
        for (std::size_t e = 0; e < block.count(); ++e) {
            const Index entity = content->entities.of[b][e];
            if (part[index(entity)] < 0) {
                part[index(entity)] = static_cast<Index>(content->parts.size());
                content->parts.push_back({index(entity), b, {}});
            }
            content->parts[index(part[index(entity)])].elements.push_back(static_cast<std::uint32_t>(e));
        }
        content->elements += block.count();
        if (block.count() == 0) continue;
        const auto [low, high] = std::ranges::minmax(block.tags);
        content->first_element = content->last_element == 0 ? low : std::min(content->first_element, low);
        content->last_element = std::max(content->last_element, high);
    }
    std::ranges::stable_sort(content->parts, {}, &Part::entity);
    if (!deck.point_tags.empty()) {
        const auto [low, high] = std::ranges::minmax(deck.point_tags);
        content->first_node = low;
        content->last_node = high;
    }
    if (std::min(content->first_node, content->first_element) < 1)
        throw InvalidInput("io.number_taken", deck.path + " has a node or an element of number 0, which an "
                                                          "MSH file cannot hold; write another format");
    for (const Vec3& point : deck.points) content->box.extend(point);
    const auto count = [&](DeckSet::Kind kind) {
        return static_cast<std::size_t>(std::ranges::count(deck.sets, kind, &DeckSet::kind));
    };
    const std::size_t others = count(DeckSet::Kind::nodes) + count(DeckSet::Kind::sides);
    if (others > 0)
        file.notes.push_back(std::to_string(others) +
                             " sets of nodes or sides are not written: groups of MSH are of elements");
    return content;
}

/// Puts numbers as text or as they lie in memory.
struct Numbers {
    bool binary;

    template <class Value>
    [[nodiscard]] char* add(char* out, Value value) const
    {
        if (binary) return put(out, value);
        if constexpr (std::is_integral_v<Value>)
            out = put_text(out, static_cast<long long>(value));
        else
            out = put_text(out, value);
        *out++ = ' ';
        return out;
    }
    [[nodiscard]] char* end(char* out) const
    {
        if (!binary) *out++ = '\n';
        return out;
    }
    template <class... Value>
    [[nodiscard]] std::string line(Value... values) const
    {
        std::string text(sizeof...(values) * kNumberBytes + 1, '\0');
        char* out = text.data();
        ((out = add(out, values)), ...);
        text.resize(static_cast<std::size_t>(end(out) - text.data()));
        return text;
    }
    [[nodiscard]] std::size_t room(std::size_t numbers, std::size_t bytes) const
    {
        return binary ? bytes : numbers * kNumberBytes + 1;
    }
};

std::uint64_t size_of(std::size_t count) { return count; }

std::string entities_text(const Content& content, const Numbers& numbers)
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
char* put_nodes(const Deck& deck, const DeckBlock& block, std::size_t e, const Numbers& numbers, char* out)
{
    const std::span<const Index> nodes = block.element(e);
    const std::span<const std::uint8_t> places = gmsh_places(block.shape);
    std::array<Tag, 27> tags{};
    for (std::size_t k = 0; k < nodes.size(); ++k)
        tags[places.empty() ? k : places[k]] = static_cast<Tag>(deck.point_tags[index(nodes[k])]);
    for (std::size_t k = 0; k < nodes.size(); ++k) out = numbers.add(out, tags[k]);
    return numbers.end(out);
}

void add_41(const Deck& deck, const std::shared_ptr<const Content>& content, const Numbers& numbers,
            DeckFile& file)
{
    const std::string gap = numbers.binary ? "\n" : "";
    const std::uint64_t nodes = deck.points.size();
    const DeckEntity* const first = content->entities.all.empty() ? nullptr : &content->entities.all.front();
    file.sections.push_back(
        {msh_opening(content->names, "4.1", numbers.binary) + entities_text(*content, numbers) + "$Nodes\n" +
             numbers.line(size_of(1), nodes, static_cast<std::uint64_t>(content->first_node),
                          static_cast<std::uint64_t>(content->last_node)) +
             numbers.line(first == nullptr ? 3 : first->dimension,
                          first == nullptr ? 1 : content->tag.front(), 0, nodes),
         nodes, numbers.room(1, 8), [&deck, numbers](std::size_t begin, std::size_t end, char* out) {
             for (std::size_t p = begin; p < end; ++p)
                 out = numbers.end(numbers.add(out, static_cast<std::uint64_t>(deck.point_tags[p])));
             return out;
         }});
    file.sections.push_back({{},
                             nodes,
                             numbers.room(3, sizeof(Vec3)),
                             [&deck, numbers](std::size_t begin, std::size_t end, char* out) {
                                 for (std::size_t p = begin; p < end; ++p) {
                                     for (const double x : deck.points[p]) out = numbers.add(out, x);
                                     out = numbers.end(out);
                                 }
                                 return out;
                             }});
    std::string head = gap + "$EndNodes\n$Elements\n" +
                       numbers.line(size_of(content->parts.size()), size_of(content->elements),
                                    static_cast<std::uint64_t>(content->first_element),
                                    static_cast<std::uint64_t>(content->last_element));
    for (std::size_t p = 0; p < content->parts.size(); ++p) {
        const Part& part = content->parts[p];
        const DeckBlock& block = deck.blocks[part.block];
        const std::size_t each = static_cast<std::size_t>(shape_info(block.shape).nodes) + 1;
        head += numbers.line(shape_info(block.shape).dimension, content->tag[part.entity],
                             gmsh_type(block.shape), size_of(part.elements.size()));
        file.sections.push_back(
            {head, part.elements.size(), numbers.room(each, 8 * each),
             [content, p, &deck, &block, numbers](std::size_t begin, std::size_t end, char* out) {
                 for (std::size_t i = begin; i < end; ++i) {
                     const std::uint32_t e = content->parts[p].elements[i];
                     out = numbers.add(out, static_cast<std::uint64_t>(block.tags[e]));
                     out = put_nodes<std::uint64_t>(deck, block, e, numbers, out);
                 }
                 return out;
             }});
        head.clear();
    }
    file.sections.push_back({head + gap + "$EndElements\n", 0, 0, {}});
}

/// An element carries one physical group and its entity.
void add_22(const Deck& deck, const std::shared_ptr<const Content>& content, const Numbers& numbers,
            DeckFile& file)
{
    const std::string gap = numbers.binary ? "\n" : "";
    file.sections.push_back({msh_opening(content->names, "2.2", numbers.binary) + "$Nodes\n" +
                                 std::to_string(deck.points.size()) + "\n",
                             deck.points.size(), numbers.room(4, 4 + sizeof(Vec3)),
                             [&deck, numbers](std::size_t begin, std::size_t end, char* out) {
                                 for (std::size_t p = begin; p < end; ++p) {
                                     out = numbers.add(out, static_cast<int>(deck.point_tags[p]));
                                     for (const double x : deck.points[p]) out = numbers.add(out, x);
                                     out = numbers.end(out);
                                 }
                                 return out;
                             }});
    std::string head = gap + "$EndNodes\n$Elements\n" + std::to_string(content->elements) + "\n";
    std::size_t lost = 0;
    for (std::size_t p = 0; p < content->parts.size(); ++p) {
        const Part& part = content->parts[p];
        const DeckBlock& block = deck.blocks[part.block];
        const std::size_t each = static_cast<std::size_t>(shape_info(block.shape).nodes) + 5;
        const int type = gmsh_type(block.shape);
        if (content->physical[part.entity].size() > 1) ++lost;
        if (numbers.binary) head += numbers.line(type, static_cast<int>(part.elements.size()), 2);
        file.sections.push_back(
            {head, part.elements.size(), numbers.room(each, 4 * (each - 2)),
             [content, p, type, &deck, &block, numbers](std::size_t begin, std::size_t end, char* out) {
                 const Part& of = content->parts[p];
                 for (std::size_t i = begin; i < end; ++i) {
                     const std::uint32_t e = of.elements[i];
                     out = numbers.add(out, static_cast<int>(block.tags[e]));
                     if (!numbers.binary) out = numbers.add(numbers.add(out, type), 2);
                     out = numbers.add(out, content->smallest[of.entity]);
                     out = numbers.add(out, content->tag[of.entity]);
                     out = put_nodes<int>(deck, block, e, numbers, out);
                 }
                 return out;
             }});
        head.clear();
    }
    file.sections.push_back({head + gap + "$EndElements\n", 0, 0, {}});
    if (lost > 0)
        file.notes.push_back("MSH 2.2 holds one group an element: elements in several keep the smallest");
}

} // namespace

DeckFile msh_of_deck(const Deck& deck, const DeckFileOptions& options)
{
    DeckFile file;
    file.sizes = options.binary ? Sizes::exact : Sizes::varying;
    const auto content = content_of(deck, file);
    const Numbers numbers{options.binary};
    if (options.msh_version == 2.2)
        add_22(deck, content, numbers, file);
    else
        add_41(deck, content, numbers, file);
    return file;
}

} // namespace lacuna::io
