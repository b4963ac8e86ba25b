// SPDX-License-Identifier: MIT
#include <lacuna/io/msh_reader.h>

#include <lacuna/core/error.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/input_file.h>
#include <lacuna/io/detail/msh_shapes.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>

namespace lacuna::io {

namespace {

/// What must be known of an element type to read or to skip it, and what it is read as: types of order 3 and
/// more give their corners.
struct ElementType {
    int type, dimension, nodes, order;
    DeckShape shape = DeckShape::line2;
};

using enum DeckShape;
constexpr ElementType kTypes[] = {{15, 0, 1, 1},
                                  {1, 1, 2, 1},
                                  {8, 1, 3, 2},
                                  {26, 1, 4, 3},
                                  {27, 1, 5, 4},
                                  {28, 1, 6, 5},
                                  {2, 2, 3, 1, tri3},
                                  {9, 2, 6, 2, tri6},
                                  {20, 2, 9, 3, tri3},
                                  {21, 2, 10, 3, tri3},
                                  {22, 2, 12, 4, tri3},
                                  {23, 2, 15, 4, tri3},
                                  {24, 2, 15, 5, tri3},
                                  {25, 2, 21, 5, tri3},
                                  {3, 2, 4, 1, quad4},
                                  {10, 2, 9, 2, quad9},
                                  {16, 2, 8, 2, quad8},
                                  {36, 2, 16, 3, quad4},
                                  {37, 2, 25, 4, quad4},
                                  {38, 2, 36, 5, quad4},
                                  {4, 3, 4, 1, tet4},
                                  {11, 3, 10, 2, tet10},
                                  {29, 3, 20, 3, tet4},
                                  {30, 3, 35, 4, tet4},
                                  {31, 3, 56, 5, tet4},
                                  {5, 3, 8, 1, hex8},
                                  {12, 3, 27, 2, hex27},
                                  {17, 3, 20, 2, hex20},
                                  {92, 3, 64, 3, hex8},
                                  {93, 3, 125, 4, hex8},
                                  {6, 3, 6, 1, wedge6},
                                  {13, 3, 18, 2, wedge18},
                                  {18, 3, 15, 2, wedge15},
                                  {90, 3, 40, 3, wedge6},
                                  {7, 3, 5, 1, pyramid5},
                                  {14, 3, 14, 2, pyramid14},
                                  {19, 3, 13, 2, pyramid13}};

ElementType type_of(const Cursor& cursor, int type)
{
    for (const ElementType& known : kTypes)
        if (known.type == type) return known;
    cursor.fail("element type " + std::to_string(type) + " is not known");
}

class Reader {
public:
    Reader(Cursor& cursor, DeckBuilder& into) : cursor_(cursor), into_(into) {}

    void read()
    {
        for (std::string_view line; !(line = cursor_.full_line()).empty();) {
            if (line.front() != '$')
                cursor_.fail("expected a section, as $Nodes; this is no MSH file, or it is damaged");
            read_section(std::string(line.substr(1)));
        }
        if (version_ == 0) cursor_.fail("this is no MSH file: it has no $MeshFormat");
        if (!nodes_known_) cursor_.fail("the file has no $Nodes");
        take_groups();
    }

    /// What a mesh does not keep: groups, and what was passed over.
    std::vector<MshGroup> groups;
    std::vector<OtherCells> others;
    int order = 1;

private:
    void read_section(const std::string& name)
    {
        if (name == "MeshFormat")
            read_format();
        else if (version_ == 0 && name != "Comments")
            cursor_.fail("expected $MeshFormat first");
        else if (name == "PhysicalNames")
            read_names();
        else if (name == "Entities" && version_ == 4)
            read_entities();
        else if (name == "Nodes")
            version_ == 4 ? read_nodes_4() : read_nodes_2();
        else if (name == "Elements")
            version_ == 4 ? read_elements_4() : read_elements_2();
        else if (!cursor_.skip_past("$End" + name))
            cursor_.fail("the file ends within $" + name);
        else
            return void(cursor_.line());
        if (cursor_.full_line() != "$End" + name)
            cursor_.fail("expected $End" + name + ": $" + name + " holds more than it announces");
    }

    void read_format()
    {
        const double version = cursor_.text_real();
        const std::int64_t binary = cursor_.text_integer();
        const std::int64_t bytes = cursor_.text_integer();
        if (version != 4.1 && version != 4 && !(version >= 2 && version < 3))
            cursor_.fail("expected version 2.2, 4.0 or 4.1; save the mesh anew as one of them");
        if (bytes != 8)
            cursor_.fail("numbers of " + std::to_string(bytes) + " bytes are not read; expected 8");
        version_ = version >= 4 ? 4 : 2;
        into_.deck().version = version;
        first_of_4_ = version == 4;
        cursor_.line();
        if (binary == 1) {
            cursor_.coding = std::endian::native == std::endian::little ? Coding::little : Coding::big;
            if (cursor_.raw_integer() != 1)
                cursor_.fail("the bytes are in another machine's order; save the mesh as text");
        } else if (binary != 0) {
            cursor_.fail("expected 0 for text or 1 for binary in $MeshFormat");
        }
    }

    void read_names()
    {
        const std::int64_t count = cursor_.text_integer();
        cursor_.line();
        for (std::int64_t i = 0; i < count; ++i) {
            MshGroup group;
            if (cursor_.at_end()) cursor_.fail("the file ends within $PhysicalNames");
            group.dimension = text_int();
            group.tag = text_int();
            const std::string_view rest = cursor_.line_end();
            const std::size_t first = rest.find('"');
            const std::size_t last = rest.rfind('"');
            if (first == std::string_view::npos || last == first) cursor_.fail("expected a name in quotes");
            names_[{group.dimension, group.tag}] = std::string(rest.substr(first + 1, last - first - 1));
        }
    }

    int text_int()
    {
        const std::string_view word = cursor_.word("a number");
        const auto value = parse_integer<int>(word);
        if (!value) cursor_.fail("expected a small whole number, found " + shown(word));
        return *value;
    }

    void read_entities()
    {
        std::uint64_t counts[4];
        for (std::uint64_t& count : counts) count = cursor_.size();
        for (int dimension = 0; dimension < 4; ++dimension) {
            const int reals = dimension == 0 && !first_of_4_ ? 3 : 6;
            for (std::uint64_t i = 0; i < counts[dimension]; ++i) {
                const int tag = cursor_.integer();
                for (int k = 0; k < reals; ++k) cursor_.real();
                const std::uint64_t physical = cursor_.plausible(cursor_.size(), 4, 1);
                for (std::uint64_t k = 0; k < physical; ++k) members_[{dimension, group_tag()}].insert(tag);
                const std::uint64_t bounds = dimension == 0 ? 0 : cursor_.plausible(cursor_.size(), 4, 1);
                for (std::uint64_t k = 0; k < bounds; ++k) cursor_.integer();
            }
        }
    }

    /// A negative tag says that the group holds the entity turned over.
    int group_tag()
    {
        const int tag = cursor_.integer();
        if (tag == std::numeric_limits<int>::min()) cursor_.fail("a group's tag is too large");
        return tag < 0 ? -tag : tag;
    }

    /// Of versions 2 and 4.0.
    std::uint64_t node_tag()
    {
        const int tag = cursor_.integer();
        if (tag < 0) cursor_.fail("node tag " + std::to_string(tag) + " is negative");
        return static_cast<std::uint64_t>(tag);
    }

    void add_tag(std::uint64_t tag)
    {
        into_.deck().point_tags.push_back(static_cast<DeckTag>(tag));
        if (into_.deck().point_tags.back() < 0) cursor_.fail("a node's tag is too large");
    }

    void begin_nodes(std::uint64_t count, std::uint64_t bytes, std::uint64_t values)
    {
        if (nodes_known_) cursor_.fail("a second $Nodes");
        cursor_.plausible(count, bytes, values);
        if (count > static_cast<std::uint64_t>(std::numeric_limits<Index>::max()))
            cursor_.fail("too many nodes");
        into_.points().reserve(count);
        into_.deck().point_tags.reserve(count);
    }

    void end_nodes(std::uint64_t count)
    {
        if (into_.points().size() != count)
            cursor_.fail("the file announces " + std::to_string(count) + " nodes and holds " +
                         std::to_string(into_.points().size()));
        tags_.emplace(into_.deck().point_tags, [&](Index, Index node) {
            cursor_.fail("node " + std::to_string(node + 1) + " of the file has the tag of one before");
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
                cursor_.fail("nodes of dimension " + std::to_string(dimension));
            const std::uint64_t count = cursor_.plausible(cursor_.size(), 28, 4);
            if (count > total - into_.points().size()) cursor_.fail("more nodes than announced");
            for (std::uint64_t i = 0; i < count && !first_of_4_; ++i) add_tag(cursor_.size());
            for (std::uint64_t i = 0; i < count; ++i) {
                if (first_of_4_) add_tag(node_tag());
                into_.points().push_back(cursor_.point());
                for (int k = 0; parametric && k < dimension; ++k) cursor_.real();
            }
        }
        end_nodes(total);
    }

    void read_nodes_2()
    {
        const std::int64_t count = cursor_.text_integer();
        cursor_.line();
        if (count < 0) cursor_.fail("a negative number of nodes");
        begin_nodes(static_cast<std::uint64_t>(count), 28, 4);
        for (std::int64_t i = 0; i < count; ++i) {
            add_tag(node_tag());
            into_.points().push_back(cursor_.point());
        }
        end_nodes(static_cast<std::uint64_t>(count));
    }

    /// Room for cells that are announced.
    void expect_cells(const ElementType& type, std::uint64_t count)
    {
        if (!nodes_known_) cursor_.fail("$Elements before $Nodes");
        if (count + cells_ > static_cast<std::uint64_t>(std::numeric_limits<Index>::max()))
            cursor_.fail("too many cells");
        if (type.dimension < 2) return;
        block_ = into_.block_of(type.shape, std::to_string(type.type));
        DeckBlock& block = into_.deck().blocks[block_];
        // Many small blocks must not each copy what is there.
        if (count <= block.count()) return;
        block.tags.reserve(block.count() + count);
        block.regions.reserve(block.count() + count);
        block.nodes.reserve((block.count() + count) * static_cast<std::size_t>(shape_info(type.shape).nodes));
    }

    /// One cell; `next_tag` reads the tag of each of its nodes.
    template <class NextTag>
    void take_cell(const ElementType& type, std::uint64_t tag, int entity, const NextTag& next_tag)
    {
        if (type.dimension < 2) {
            for (int i = 0; i < type.nodes; ++i) next_tag();
            ++others_[{type.dimension, type.type}];
            return;
        }
        const auto kept = static_cast<std::size_t>(shape_info(type.shape).nodes);
        std::array<Index, 27> read{}, nodes{};
        for (std::size_t i = 0; i < index(type.nodes); ++i) {
            const std::uint64_t node = next_tag();
            if (i < kept) read[i] = position(node);
        }
        const auto places = gmsh_places(type.shape);
        for (std::size_t i = 0; i < kept; ++i) nodes[i] = read[places.empty() ? i : places[i]];
        if (region_ < 0 || std::pair(type.dimension, entity) != last_entity_) {
            last_entity_ = {type.dimension, entity};
            region_ = into_.region_of(entity, "", type.dimension);
            entity_of_.resize(std::max(entity_of_.size(), index(region_) + 1));
            entity_of_[index(region_)] = last_entity_;
        }
        if (shape_info(type.shape).corners == 8) order = std::max(order, type.order);
        if (static_cast<DeckTag>(tag) < 0) cursor_.fail("an element's tag is too large");
        ++cells_;
        into_.add_element(block_, static_cast<DeckTag>(tag), region_, {nodes.data(), kept});
    }

    Index position(std::uint64_t tag) const
    {
        const Index node = tags_->find(static_cast<DeckTag>(tag));
        if (node < 0) cursor_.fail("a cell names node " + std::to_string(tag) + ", which is not there");
        return node;
    }

    void read_elements_4()
    {
        const std::uint64_t blocks = cursor_.plausible(cursor_.size(), 20, 4);
        for (int i = 0; i < (first_of_4_ ? 1 : 3); ++i) cursor_.size();
        for (std::uint64_t b = 0; b < blocks; ++b) {
            const int first = cursor_.integer();
            const int second = cursor_.integer();
            const int entity = first_of_4_ ? first : second;
            const ElementType type = type_of(cursor_, cursor_.integer());
            const auto values = static_cast<std::uint64_t>(type.nodes) + 1;
            const std::uint64_t count = cursor_.plausible(cursor_.size(), (first_of_4_ ? 4 : 8) * values,
                                                          values);
            expect_cells(type, count);
            const auto next_tag = [&] { return first_of_4_ ? node_tag() : cursor_.size(); };
            for (std::uint64_t i = 0; i < count; ++i) {
                const std::uint64_t tag = next_tag();
                take_cell(type, tag, entity, next_tag);
            }
        }
    }

    void read_cell_2(const ElementType& type, std::uint64_t tag, int tags)
    {
        int physical = 0;
        int entity = 0;
        for (int k = 0; k < tags; ++k) {
            if (k == 0)
                physical = group_tag();
            else if (k == 1)
                entity = cursor_.integer();
            else
                cursor_.integer();
        }
        if (physical != 0) members_[{type.dimension, physical}].insert(entity);
        take_cell(type, tag, entity, [&] { return node_tag(); });
    }

    void read_elements_2()
    {
        const std::int64_t announced = cursor_.text_integer();
        cursor_.line();
        if (announced < 0) cursor_.fail("a negative number of cells");
        const std::uint64_t total = cursor_.plausible(static_cast<std::uint64_t>(announced), 8, 4);
        for (std::uint64_t done = 0; done < total;) {
            const bool text = cursor_.coding == Coding::text;
            std::uint64_t tag = text ? node_tag() : 0;
            const ElementType type = type_of(cursor_, cursor_.integer());
            const int count = text ? 1 : cursor_.integer();
            const int tags = cursor_.integer();
            if (count < 1 || tags < 0 || static_cast<std::uint64_t>(count) > total - done)
                cursor_.fail("a block of " + std::to_string(count) + " cells with " + std::to_string(tags) +
                             " tags");
            const auto values = static_cast<std::uint64_t>(type.nodes) + static_cast<std::uint64_t>(tags);
            cursor_.plausible(static_cast<std::uint64_t>(count), 4 * (values + 1), values);
            expect_cells(type, count > 1 ? static_cast<std::uint64_t>(count) : 0);
            for (int i = 0; i < count; ++i) {
                if (!text) tag = node_tag();
                read_cell_2(type, tag, tags);
            }
            done += static_cast<std::uint64_t>(count);
        }
    }

    void take_groups()
    {
        for (const auto& [key, name] : names_) members_[key];
        Deck& deck = into_.deck();
        for (const auto& [key, entities] : members_) {
            const auto name = names_.find(key);
            groups.push_back({key.first,
                              key.second,
                              name == names_.end() ? "" : name->second,
                              {entities.begin(), entities.end()}});
            if (key.first >= 2) take_set(groups.back());
        }
        for (const auto& [key, count] : others_) {
            others.push_back({key.first, key.second, count});
            into_.pass_over("cells of type " + std::to_string(key.second), count);
        }
        std::erase_if(deck.sets, [](const DeckSet& set) { return set.members.empty(); });
    }

    void take_set(const MshGroup& group)
    {
        const std::string_view name = trimmed(group.name);
        if (name.empty()) return;
        Deck& deck = into_.deck();
        std::vector<bool> held(deck.regions.size(), false);
        for (std::size_t r = 0; r < held.size(); ++r)
            held[r] = entity_of_[r].first == group.dimension &&
                      std::ranges::binary_search(group.entities, entity_of_[r].second);
        for (std::size_t r = 0; r < held.size(); ++r)
            if (held[r] && deck.regions[r].name.empty()) deck.regions[r].name = name;
        DeckSet set{DeckSet::Kind::elements, group.tag, std::string(name), {}, {}};
        for (const DeckBlock& block : deck.blocks)
            for (std::size_t e = 0; e < block.count(); ++e)
                if (held[index(block.regions[e])]) set.members.push_back(block.tags[e]);
        std::sort(set.members.begin(), set.members.end());
        set.members.erase(std::unique(set.members.begin(), set.members.end()), set.members.end());
        deck.sets.push_back(std::move(set));
    }

    using Key = std::pair<int, int>; // dimension, tag
    Cursor& cursor_;
    DeckBuilder& into_;
    std::optional<TagPlaces> tags_;
    std::size_t block_ = 0, cells_ = 0;
    Index region_ = -1;
    std::pair<int, int> last_entity_;
    std::vector<std::pair<int, int>> entity_of_; ///< dimension and tag, of each region
    std::map<Key, std::string> names_;
    std::map<Key, std::set<int>> members_;
    std::map<Key, std::size_t> others_;
    int version_ = 0;
    bool first_of_4_ = false; ///< version 4.0, which counts tags in 4 bytes and has them in another order
    bool nodes_known_ = false;
};

} // namespace

int gmsh_type(DeckShape shape)
{
    for (const ElementType& type : kTypes)
        if (type.dimension > 1 && type.shape == shape && type.nodes == shape_info(shape).nodes)
            return type.type;
    return shape == DeckShape::line3 ? 8 : 1;
}

std::span<const std::uint8_t> gmsh_places(DeckShape shape)
{
    static constexpr std::uint8_t kTet10[] = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
    static constexpr std::uint8_t kPyramid14[] = {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12, 13};
    static constexpr std::uint8_t kWedge18[] = {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11, 15, 17, 16};
    static constexpr std::uint8_t kHex27[] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 13, 9,  16, 18,
                                              19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26};
    const DeckShapeInfo& info = shape_info(shape);
    if (info.dimension < 3 || info.nodes == info.corners) return {};
    const auto count = static_cast<std::size_t>(info.nodes);
    switch (info.corners) {
    case 4:
        return kTet10;
    case 5:
        return std::span(kPyramid14).first(count);
    case 6:
        return std::span(kWedge18).first(count);
    default:
        return std::span(kHex27).first(count);
    }
}

void read_msh(Cursor& cursor, DeckBuilder& into) { Reader(cursor, into).read(); }

MshCells read_msh(const std::string& path)
{
    const std::string data = read_file(path);
    Cursor cursor(path, data);
    DeckBuilder builder(DeckFormat::msh);
    Reader reader(cursor, builder);
    reader.read();
    Deck deck = builder.take(path);
    MshCells cells;
    cells.groups = std::move(reader.groups);
    cells.others = std::move(reader.others);
    cells.order = reader.order;
    for (const DeckBlock& block : deck.blocks) {
        const DeckShapeInfo& info = shape_info(block.shape);
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
        else if (info.dimension == 2)
            take(cells.triangles, cells.triangle_entity);
        else
            cells.others.push_back({3, std::stoi(block.type), block.count()});
    }
    cells.nodes = std::move(deck.points);
    return cells;
}

} // namespace lacuna::io
