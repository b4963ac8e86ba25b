// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/large_pages.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/deck_builder.h>

#include <algorithm>
#include <bit>
#include <compare>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace lacuna::io {

namespace {

/// How an element type is read or skipped, and the shape that it becomes.
struct ElementType {
    int type, dimension, nodes;
    DeckShape shape = DeckShape::line2;
    bool is_kept = true; ///< if false, elements are only counted
};

// Types without a DeckShape: points, and elements of order 3 and more, which are reduced to their corners.
using enum DeckShape;
constexpr ElementType kFurtherTypes[] = {
    {15, 0, 1, line2, false}, {26, 1, 4, line2, false}, {27, 1, 5, line2, false}, {28, 1, 6, line2, false},
    {20, 2, 9, tri3},         {21, 2, 10, tri3},        {22, 2, 12, tri3},        {23, 2, 15, tri3},
    {24, 2, 15, tri3},        {25, 2, 21, tri3},        {36, 2, 16, quad4},       {37, 2, 25, quad4},
    {38, 2, 36, quad4},       {29, 3, 20, tet4},        {30, 3, 35, tet4},        {31, 3, 56, tet4},
    {92, 3, 64, hex8},        {93, 3, 125, hex8},       {90, 3, 40, wedge6}};

ElementType type_of(const Cursor& cursor, int type)
{
    if (const auto shape = shape_numbered(&ShapeWords::gmsh, type))
        return {type, shape_info(*shape).dimension, shape_info(*shape).nodes, *shape};
    const auto known = std::ranges::find(kFurtherTypes, type, &ElementType::type);
    if (known == std::end(kFurtherTypes)) cursor.fail("element type {} is not known", type);
    return *known;
}

class Reader {
public:
    Reader(Cursor& cursor, DeckBuilder& into) : cursor_(cursor), into_(into) {}

    void read()
    {
        for (std::string_view line; !(line = cursor_.full_line()).empty();) {
            if (line.front() != '$')
                cursor_.fail("expected a section such as $Nodes; this is no MSH file, or it is damaged");
            read_section(std::string(line.substr(1)));
        }
        if (version_ == 0) cursor_.fail("this is no MSH file: it has no $MeshFormat");
        if (!nodes_known_) cursor_.fail("the file has no $Nodes");
        if (version_ != 4) merge_copies();
        take_groups();
    }

private:
    using Key = std::pair<int, int>; // dimension, tag

    void read_section(const std::string& name)
    {
        if (version_ <= 1 && (name == "NOD" || name == "ELM")) {
            into_.deck().version = version_ = 1;
            name == "NOD" ? read_nodes_2() : read_elements_1();
        } else if (name == "MeshFormat")
            read_format();
        else if (version_ == 0 && name != "Comments")
            cursor_.fail("expected $MeshFormat first");
        else if (name == "PhysicalNames")
            read_names();
        else if (name == "Entities" && version_ == 4)
            read_entities(false);
        else if (name == "PartitionedEntities" && version_ == 4 && !first_of_4_)
            read_parts();
        else if (name == "Nodes")
            version_ == 4 ? read_nodes_4() : read_nodes_2();
        else if (name == "Elements")
            version_ == 4 ? read_elements_4() : read_elements_2();
        else if (!cursor_.skip_past("$End" + name))
            cursor_.fail("the file ends within ${}", name);
        else
            return void(cursor_.line());
        if (!same_word(cursor_.full_line(), "$End" + name))
            cursor_.fail("expected $End{}: ${} holds more than it announces", name, name);
    }

    void read_format()
    {
        const double version = cursor_.text_real();
        const std::int64_t binary = cursor_.text_integer();
        const std::int64_t bytes = cursor_.text_integer();
        if (version != 4.1 && version != 4 && !(version >= 2 && version < 3))
            cursor_.fail(Message(kUnreadable, "expected version 1.0, 2.2, 4.0 or 4.1")
                             .remedy("save the mesh in one of these versions"));
        if (bytes != 8)
            cursor_.fail("numbers of {} bytes are not read; expected {}", found(bytes), needed(8));
        version_ = version >= 4 ? 4 : 2;
        into_.deck().version = version;
        first_of_4_ = version == 4;
        cursor_.line();
        if (binary == 1) {
            cursor_.coding = std::endian::native == std::endian::little ? Coding::little : Coding::big;
            if (cursor_.integer() != 1)
                cursor_.fail(Message(kUnreadable, "the file has the byte order of another machine")
                                 .remedy("save the mesh as text"));
        } else if (binary != 0) {
            cursor_.fail("expected 0 for text or 1 for binary in $MeshFormat");
        }
    }

    void read_names()
    {
        const std::int64_t count = cursor_.text_integer();
        cursor_.line();
        for (std::int64_t i = 0; i < count; ++i) {
            if (!cursor_.more()) cursor_.fail("the file ends within $PhysicalNames");
            const std::string_view line = cursor_.line();
            const std::size_t first = line.find('"');
            const std::size_t last = line.rfind('"');
            if (first == std::string_view::npos || last == first) cursor_.fail("expected a name in quotes");
            Cursor numbers = cursor_.part(line.substr(0, first));
            const auto next = [&] { return small_int(numbers.more() ? numbers.word() : std::string_view()); };
            // Version 2.0 does not store the dimension.
            int dimension = -1, tag = next();
            if (numbers.more() || into_.deck().version > 2) {
                dimension = tag;
                tag = next();
            }
            names_[{dimension, tag}] = std::string(line.substr(first + 1, last - first - 1));
        }
    }

    int small_int(std::string_view word) const
    {
        const auto value = parse_integer<int>(word);
        if (!value) cursor_.fail("expected a small whole number, found {}", found(shown(word)));
        return *value;
    }

    /// Read which entity each partitioned entity is a part of, so that a partitioned mesh is read as a whole
    /// one.
    void read_parts()
    {
        cursor_.size(); // number of parts
        const std::uint64_t ghosts = cursor_.plausible(cursor_.size(), 8, 2);
        for (std::uint64_t i = 0; i < 2 * ghosts; ++i) cursor_.integer();
        read_entities(true);
    }

    /// The entity of which a partitioned entity is a part. If it has no such entity, or one of another
    /// dimension, the entity itself.
    [[nodiscard]] int whole_of(int dimension, int entity) const
    {
        const auto found = whole_of_.find({dimension, entity});
        return found == whole_of_.end() ? entity : found->second;
    }

    void read_entities(bool parts)
    {
        std::uint64_t counts[4];
        for (std::uint64_t& count : counts) count = cursor_.size();
        for (int dimension = 0; dimension < 4; ++dimension) {
            const int reals = dimension == 0 && !first_of_4_ ? 3 : 6;
            for (std::uint64_t i = 0; i < counts[dimension]; ++i) {
                int tag = cursor_.integer();
                if (parts) {
                    const int of_dimension = cursor_.integer(), whole = cursor_.integer();
                    if (of_dimension == dimension) whole_of_[{dimension, tag}] = whole;
                    tag = whole_of(dimension, tag);
                    const std::uint64_t own = cursor_.plausible(cursor_.size(), 4, 1);
                    for (std::uint64_t k = 0; k < own; ++k) cursor_.integer();
                }
                for (int k = 0; k < reals; ++k) cursor_.real();
                const std::uint64_t physical = cursor_.plausible(cursor_.size(), 4, 1);
                for (std::uint64_t k = 0; k < physical; ++k) members_[{dimension, group_tag()}].insert(tag);
                const std::uint64_t bounds = dimension == 0 ? 0 : cursor_.plausible(cursor_.size(), 4, 1);
                for (std::uint64_t k = 0; k < bounds; ++k) cursor_.integer();
            }
        }
    }

    /// A negative tag means that the group contains the entity with reversed orientation.
    int group_tag()
    {
        const int tag = cursor_.integer();
        if (tag == std::numeric_limits<int>::min()) cursor_.fail("a group's tag is too large");
        return tag < 0 ? -tag : tag;
    }

    /// A node tag in versions 2 and 4.0.
    std::uint64_t node_tag()
    {
        const int tag = cursor_.integer();
        if (tag < 0) cursor_.fail("node tag {} is negative", tag);
        return static_cast<std::uint64_t>(tag);
    }

    void add_tag(std::uint64_t tag)
    {
        into_.deck().point_tags.push_back(static_cast<DeckTag>(tag));
        if (into_.deck().point_tags.back() < 0) cursor_.fail("a node's tag is too large");
    }

    void begin_nodes(std::uint64_t count, std::uint64_t bytes, std::uint64_t values)
    {
        if (nodes_known_) cursor_.fail("$Nodes occurs twice");
        cursor_.plausible(count, bytes, values);
        if (!is_index(count)) cursor_.fail("too many nodes");
        reserve_large(into_.points(), count);
        reserve_large(into_.deck().point_tags, count);
    }

    void end_nodes(std::uint64_t count)
    {
        if (into_.points().size() != count)
            cursor_.fail("the file announces {} nodes and holds {}", count, into_.points().size());
        tags_.emplace(into_.deck().point_tags, [&](Index, Index node) {
            cursor_.fail("{} of the file has the same tag as an earlier one", numbered("node", node + 1));
        });
        nodes_known_ = true;
    }

    void read_nodes_4()
    {
        const std::uint64_t blocks = cursor_.plausible(cursor_.size(), 20, 4);
        const std::uint64_t total = cursor_.size();
        for (int i = 0; i < 2 && !first_of_4_; ++i) cursor_.size();
        begin_nodes(total, 28, 4);
        for (std::uint64_t b = 0; b < blocks; ++b) {
            int dimension = cursor_.integer();
            if (const int entity = cursor_.integer(); first_of_4_) dimension = entity;
            const bool parametric = cursor_.integer() != 0;
            if (dimension < 0 || dimension > 3)
                cursor_.fail("expected nodes of dimension 0 to 3, found {}", dimension);
            const std::uint64_t count = cursor_.plausible(cursor_.size(), 28, 4);
            if (count > total - into_.points().size()) cursor_.fail("more nodes than announced");
            if (cursor_.coding != Coding::text && !first_of_4_ && !parametric) {
                take_nodes_4(count);
                continue;
            }
            for (std::uint64_t i = 0; i < count && !first_of_4_; ++i) add_tag(cursor_.size());
            for (std::uint64_t i = 0; i < count; ++i) {
                if (first_of_4_) add_tag(node_tag());
                into_.points().push_back(cursor_.point());
                for (int k = 0; parametric && k < dimension; ++k) cursor_.real();
            }
        }
        end_nodes(total);
    }

    /// Read tags and then points from binary data.
    void take_nodes_4(std::size_t count)
    {
        const std::size_t first = into_.points().size();
        std::vector<DeckTag>& tags = into_.deck().point_tags;
        std::vector<Vec3>& points = into_.points();
        tags.resize(first + count);
        std::memcpy(tags.data() + first, cursor_.bytes(8 * count).data(), 8 * count);
        for (std::size_t i = first; i < tags.size(); ++i)
            if (tags[i] < 0) cursor_.fail("a node's tag is too large");
        points.resize(first + count);
        const std::string_view bytes = cursor_.bytes(sizeof(Vec3) * count);
        std::memcpy(static_cast<void*>(points.data() + first), bytes.data(), bytes.size());
        for (std::size_t i = first; i < points.size(); ++i)
            if (!points[i].allFinite()) {
                Cursor at = cursor_.part(bytes.substr((i - first) * sizeof(Vec3)));
                at.point(); // reports which number is invalid
            }
    }

    void read_nodes_2()
    {
        const std::int64_t count = cursor_.text_integer();
        cursor_.line();
        if (count < 0) cursor_.fail("the number of nodes is negative");
        begin_nodes(static_cast<std::uint64_t>(count), 28, 4);
        for (std::int64_t i = 0; i < count; ++i) {
            add_tag(node_tag());
            into_.points().push_back(cursor_.point());
        }
        end_nodes(static_cast<std::uint64_t>(count));
    }

    /// Choose the block for the announced cells.
    void expect_cells(const ElementType& type, std::uint64_t count)
    {
        if (!nodes_known_) cursor_.fail("$Elements before $Nodes");
        if (!is_index(count + cells_)) cursor_.fail("too many cells");
        if (type.is_kept) block_ = into_.block_of(type.shape, std::to_string(type.type));
    }

    static std::string name_of(const ElementType& type)
    {
        return "cells of type " + std::to_string(type.type);
    }

    /// Set the region for cells of an entity and, in version 2, of a physical group; 0: none.
    void enter(const ElementType& type, int entity, int physical)
    {
        const Place place{type.dimension, entity, physical};
        if (region_ >= 0 && place == last_place_) return;
        last_place_ = place;
        if (physical != 0) members_[{type.dimension, physical}].insert(entity);
        const auto [found, fresh] = regions_.try_emplace(place, into_.deck().regions.size());
        if (fresh) {
            into_.add_region(entity, "");
            place_of_.push_back(place);
        }
        region_ = static_cast<Index>(found->second);
    }

    /// Read binary cells. Each consists of its tag and its nodes, all of type `Tag`.
    template <class Tag>
    void take_cells(const ElementType& type, std::size_t count)
    {
        const std::size_t numbers = 1 + static_cast<std::size_t>(type.nodes);
        const std::string_view bytes = cursor_.bytes(count * numbers * sizeof(Tag));
        if (!type.is_kept) return into_.pass_over(name_of(type), count);
        const auto kept = static_cast<std::size_t>(shape_info(type.shape).nodes);
        const DeckBuilder::Room room = into_.add_elements(block_, count, region_);
        std::array<std::size_t, 27> from{};
        const auto places = node_places(NodeOrder::gmsh, type.shape);
        for (std::size_t k = 0; k < kept; ++k) from[k] = 1 + places[k];
        const char* at = bytes.data();
        Index* node = room.nodes;
        for (std::size_t i = 0; i < count; ++i, at += numbers * sizeof(Tag)) {
            room.tags[i] = tag_at<Tag>(at, "an element's");
            for (std::size_t k = 0; k < kept; ++k)
                *node++ = position(tag_at<Tag>(at + from[k] * sizeof(Tag), "a node's"));
        }
        cells_ += count;
    }

    template <class Tag>
    DeckTag tag_at(const char* at, const char* whose) const
    {
        Tag own; // in the byte order of this machine; files in another order are refused
        std::memcpy(&own, at, sizeof own);
        const auto tag = static_cast<DeckTag>(own);
        if (tag < 0) cursor_.fail("{} tag is too large or negative", whose);
        return tag;
    }

    /// Read one cell; `next_tag` reads the tag of each of its nodes.
    template <class NextTag>
    void take_cell(const ElementType& type, std::uint64_t tag, const NextTag& next_tag)
    {
        if (!type.is_kept) {
            for (int i = 0; i < type.nodes; ++i) next_tag();
            return into_.pass_over(name_of(type));
        }
        const auto kept = static_cast<std::size_t>(shape_info(type.shape).nodes);
        std::array<Index, 27> read{}, nodes{};
        for (std::size_t i = 0; i < index(type.nodes); ++i) {
            const std::uint64_t node = next_tag();
            if (i < kept) read[i] = position(static_cast<DeckTag>(node));
        }
        const auto places = node_places(NodeOrder::gmsh, type.shape);
        for (std::size_t i = 0; i < kept; ++i) nodes[i] = read[places[i]];
        if (static_cast<DeckTag>(tag) < 0) cursor_.fail("an element's tag is too large");
        ++cells_;
        into_.add_element(block_, static_cast<DeckTag>(tag), region_, {nodes.data(), kept});
    }

    Index position(DeckTag tag) const
    {
        const Index node = tags_->find(tag);
        if (node < 0) cursor_.fail("a cell names {}, which does not exist", numbered("node", tag));
        return node;
    }

    void read_elements_4()
    {
        const std::uint64_t blocks = cursor_.plausible(cursor_.size(), 20, 4);
        for (int i = 0; i < (first_of_4_ ? 1 : 3); ++i) cursor_.size();
        for (std::uint64_t b = 0; b < blocks; ++b) {
            const int first = cursor_.integer();
            const int second = cursor_.integer();
            const ElementType type = type_of(cursor_, cursor_.integer());
            const int entity = whole_of(type.dimension, first_of_4_ ? first : second);
            const auto values = static_cast<std::uint64_t>(type.nodes) + 1;
            const std::uint64_t count = cursor_.plausible(cursor_.size(), (first_of_4_ ? 4 : 8) * values,
                                                          values);
            expect_cells(type, count);
            if (type.is_kept) enter(type, entity, 0);
            if (cursor_.coding != Coding::text) {
                first_of_4_ ? take_cells<int>(type, count) : take_cells<std::int64_t>(type, count);
                continue;
            }
            const auto next_tag = [&] { return first_of_4_ ? node_tag() : cursor_.size(); };
            for (std::uint64_t i = 0; i < count; ++i) {
                const std::uint64_t tag = next_tag();
                take_cell(type, tag, next_tag);
            }
        }
    }

    void read_cell_2(const ElementType& type, std::uint64_t tag, int tags)
    {
        const int physical = tags > 0 ? group_tag() : 0, entity = tags > 1 ? cursor_.integer() : 0;
        for (int k = 2; k < tags; ++k) cursor_.integer();
        add_cell(type, tag, physical, entity);
    }

    void read_elements_1()
    {
        const std::uint64_t count = cursor_.plausible(cursor_.size(), 24, 6);
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint64_t tag = node_tag();
            const ElementType type = type_of(cursor_, cursor_.integer());
            const int physical = group_tag(), entity = cursor_.integer(), nodes = cursor_.integer();
            if (nodes != type.nodes)
                cursor_.fail("a cell of type {} has {} nodes, not {}", type.type, type.nodes, nodes);
            expect_cells(type, 0);
            add_cell(type, tag, physical, entity);
        }
    }

    void add_cell(const ElementType& type, std::uint64_t tag, int physical, int entity)
    {
        if (type.is_kept) enter(type, entity, physical);
        take_cell(type, tag, [&] { return node_tag(); });
    }

    void read_elements_2()
    {
        const std::int64_t announced = cursor_.text_integer();
        cursor_.line();
        if (announced < 0) cursor_.fail("the number of elements is negative");
        const std::uint64_t total = cursor_.plausible(static_cast<std::uint64_t>(announced), 8, 4);
        for (std::uint64_t done = 0; done < total;) {
            const bool text = cursor_.coding == Coding::text;
            const std::uint64_t tag = text ? node_tag() : 0;
            const ElementType type = type_of(cursor_, cursor_.integer());
            const int count = text ? 1 : cursor_.integer();
            const int tags = cursor_.integer();
            if (count < 1 || tags < 0 || static_cast<std::uint64_t>(count) > total - done)
                cursor_.fail("a block cannot have {} elements with {} tags", count, tags);
            const auto values = static_cast<std::uint64_t>(type.nodes) + static_cast<std::uint64_t>(tags);
            cursor_.plausible(static_cast<std::uint64_t>(count), 4 * (values + 1), values);
            expect_cells(type, count > 1 ? static_cast<std::uint64_t>(count) : 0);
            for (int i = 0; i < count; ++i) read_cell_2(type, text ? tag : node_tag(), tags);
            done += static_cast<std::uint64_t>(count);
        }
    }

    void take_groups()
    {
        for (const auto& [key, entities] : members_)
            if (const auto name = names_.find({-1, key.second}); name != names_.end())
                names_.try_emplace(key, name->second);
        std::erase_if(names_, [](const auto& name) { return name.first.first < 0; });
        for (const auto& [key, name] : names_) members_[key];
        Deck& deck = into_.deck();
        for (const auto& [key, entities] : members_)
            if (key.first >= 1) take_set(key, entities);
        std::erase_if(deck.sets, [](const DeckSet& set) { return set.members.empty(); });
    }

    /// Whether the cells of a region belong to a group.
    bool holds(const Key& group, const std::set<int>& entities, std::size_t region) const
    {
        const auto& [dimension, tag] = group;
        const Place& place = place_of_[region];
        if (place.dimension != dimension) return false;
        if (version_ == 4) return entities.contains(place.entity);
        const auto more = more_groups_.find(static_cast<Index>(region));
        return place.physical == tag || (more != more_groups_.end() && more->second.contains(tag));
    }

    void take_set(const Key& group, const std::set<int>& entities)
    {
        const auto named = names_.find(group);
        const std::string_view name = named == names_.end() ? std::string_view() : trimmed(named->second);
        Deck& deck = into_.deck();
        std::vector<bool> held(deck.regions.size(), false);
        for (std::size_t r = 0; r < held.size(); ++r) held[r] = holds(group, entities, r);
        DeckSet set{.tag = group.second,
                    .name = name.empty() ? unnamed_group(group.second) : std::string(name)};
        for (const DeckBlock& block : deck.blocks)
            for (std::size_t e = 0; e < block.count(); ++e)
                if (held[index(block.regions[e])]) set.members.push_back(block.tags[e]);
        tidy(set.members);
        // A region is named after the group with the fewest cells, preferring groups with a name.
        const std::pair<std::size_t, bool> rank(set.members.size(), name.empty());
        for (std::size_t r = 0; r < held.size(); ++r) {
            if (!held[r]) continue;
            const auto [before, fresh] = named_by_.try_emplace(r, rank);
            if (!fresh && before->second <= rank) continue;
            before->second = rank;
            deck.regions[r].name = set.name;
        }
        deck.sets.push_back(std::move(set));
    }

    /// In version 2 a cell in several groups is listed once for each group. Keep one of these cells, in all
    /// of the groups.
    void merge_copies()
    {
        std::map<std::pair<int, int>, int> groups_of; // number of groups of each entity
        for (const Place& place : place_of_) ++groups_of[{place.dimension, place.entity}];
        Deck& deck = into_.deck();
        std::vector<bool> several;
        for (const Place& place : place_of_)
            several.push_back(groups_of[{place.dimension, place.entity}] > 1);
        if (std::ranges::find(several, true) == several.end()) return;
        // new regions, by the region of the first copy and the groups of the others
        std::map<std::pair<Index, std::set<int>>, Index> joined;
        for (DeckBlock& block : deck.blocks) merge_copies(block, several, joined);
    }

    void merge_copies(DeckBlock& block, const std::vector<bool>& several,
                      std::map<std::pair<Index, std::set<int>>, Index>& joined)
    {
        std::vector<std::uint32_t> cells;
        for (std::size_t e = 0; e < block.count(); ++e)
            if (several[index(block.regions[e])]) cells.push_back(static_cast<std::uint32_t>(e));
        const auto place = [&](std::size_t e) { return place_of_[index(block.regions[e])]; };
        const auto compare = [&](std::size_t a, std::size_t b) {
            if (const auto by = place(a).entity <=> place(b).entity; by != 0) return by;
            const auto left = block.element(a), right = block.element(b);
            return std::lexicographical_compare_three_way(left.begin(), left.end(), right.begin(),
                                                          right.end());
        };
        std::sort(cells.begin(), cells.end(), [&](std::uint32_t a, std::uint32_t b) {
            const auto by = compare(a, b);
            return by != 0 ? by < 0 : a < b;
        });
        std::map<std::size_t, std::set<int>> further; // further groups of cells that occur more than once
        std::vector<bool> copy(block.count(), false);
        for (std::size_t i = 0, first = 0; i < cells.size(); ++i) {
            if (i == first || compare(cells[first], cells[i]) != 0) {
                first = i;
                continue;
            }
            // listed twice with the same group: keep both
            if (place(cells[i]).physical == place(cells[first]).physical) continue;
            further[cells[first]].insert(place(cells[i]).physical);
            copy[cells[i]] = true;
        }
        for (const auto& [e, groups_of] : further) {
            Index& region = block.regions[e];
            const auto [found, fresh] = joined.try_emplace({region, groups_of},
                                                           static_cast<Index>(into_.deck().regions.size()));
            if (fresh) {
                const Place own = place_of_[index(region)];
                into_.add_region(own.entity, "");
                place_of_.push_back(own);
                more_groups_[found->second] = groups_of;
            }
            region = found->second;
        }
        into_.pass_over("cells that are repeated for a further group",
                        static_cast<std::size_t>(std::ranges::count(copy, true)));
        block = without_elements(block, [&](std::size_t e) { return copy[e]; });
    }

    Cursor& cursor_;
    DeckBuilder& into_;
    std::optional<TagPlaces> tags_;
    std::size_t block_ = 0, cells_ = 0;
    Index region_ = -1;
    /// Entity and physical group of a region's cells.
    struct Place {
        int dimension, entity, physical;
        friend auto operator<=>(const Place&, const Place&) = default;
    };
    Place last_place_{};
    std::map<Place, std::size_t> regions_;
    std::vector<Place> place_of_;                ///< entity and group of each region
    std::map<Index, std::set<int>> more_groups_; ///< further physical groups of regions, in version 2
    /// For each region: the number of cells in the group that names it, and whether that group has a number
    /// only.
    std::map<std::size_t, std::pair<std::size_t, bool>> named_by_;
    std::map<Key, std::string> names_; ///< dimension -1: not given
    std::map<Key, std::set<int>> members_;
    std::map<Key, int> whole_of_; ///< entity of which a partitioned entity is a part
    int version_ = 0;
    bool first_of_4_ = false; ///< version 4.0, which has 4-byte counts and another order of tags
    bool nodes_known_ = false;
};

} // namespace

std::string unnamed_group(int tag) { return "physical_" + std::to_string(tag); }

void read_msh(Cursor& cursor, DeckBuilder& into) { Reader(cursor, into).read(); }

} // namespace lacuna::io
