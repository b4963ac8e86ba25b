// SPDX-License-Identifier: MIT
#include <lacuna/io/msh_reader.h>

#include <lacuna/core/error.h>
#include <lacuna/io/detail/facet_collector.h>
#include <lacuna/io/detail/input_file.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace lacuna::io {
namespace {

/// What must be known of an element type to read or to skip it.
struct ElementType {
    int type, dimension, nodes, order;
};

constexpr ElementType kTypes[] = {
    {15, 0, 1, 1},  {1, 1, 2, 1},   {8, 1, 3, 2},   {26, 1, 4, 3},  {27, 1, 5, 4},  {28, 1, 6, 5},
    {2, 2, 3, 1},   {9, 2, 6, 2},   {20, 2, 9, 3},  {21, 2, 10, 3}, {22, 2, 12, 4}, {23, 2, 15, 4},
    {24, 2, 15, 5}, {25, 2, 21, 5}, {3, 2, 4, 1},   {10, 2, 9, 2},  {16, 2, 8, 2},  {36, 2, 16, 3},
    {37, 2, 25, 4}, {38, 2, 36, 5}, {4, 3, 4, 1},   {11, 3, 10, 2}, {29, 3, 20, 3}, {30, 3, 35, 4},
    {31, 3, 56, 5}, {5, 3, 8, 1},   {12, 3, 27, 2}, {17, 3, 20, 2}, {92, 3, 64, 3}, {93, 3, 125, 4},
    {6, 3, 6, 1},   {13, 3, 18, 2}, {18, 3, 15, 2}, {90, 3, 40, 3}, {7, 3, 5, 1},   {14, 3, 14, 2},
    {19, 3, 13, 2}};

bool is_hex(int type) { return type == 5 || type == 12 || type == 17 || type == 92 || type == 93; }
bool is_quad(int type) { return type == 3 || type == 10 || type == 16 || (type >= 36 && type <= 38); }
bool is_triangle(const ElementType& type) { return type.dimension == 2 && !is_quad(type.type); }

ElementType type_of(const Cursor& cursor, int type)
{
    for (const ElementType& known : kTypes)
        if (known.type == type) return known;
    cursor.fail("element type " + std::to_string(type) + " is not known");
}

class Reader {
public:
    explicit Reader(Cursor& cursor) : cursor_(cursor) {}

    MshCells read()
    {
        for (std::string_view line; !(line = cursor_.full_line()).empty();) {
            if (line.front() != '$')
                cursor_.fail("expected a section, as $Nodes; this is no MSH file, or it is damaged");
            read_section(std::string(line.substr(1)));
        }
        if (version_ == 0) cursor_.fail("this is no MSH file: it has no $MeshFormat");
        if (!nodes_known_) cursor_.fail("the file has no $Nodes");
        take_groups();
        return std::move(cells_);
    }

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
        const auto value = parse_integer<int>(cursor_.word("a number"));
        if (!value) cursor_.fail("expected a small whole number");
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

    void begin_nodes(std::uint64_t count, std::uint64_t bytes, std::uint64_t values)
    {
        if (nodes_known_) cursor_.fail("a second $Nodes");
        cursor_.plausible(count, bytes, values);
        if (count > static_cast<std::uint64_t>(std::numeric_limits<Index>::max()))
            cursor_.fail("too many nodes");
        cells_.nodes.reserve(count);
        tags_.reserve(count);
    }

    void end_nodes(std::uint64_t count)
    {
        if (cells_.nodes.size() != count)
            cursor_.fail("the file announces " + std::to_string(count) + " nodes and holds " +
                         std::to_string(cells_.nodes.size()));
        tags_.finish([&](Index, Index node) {
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
            if (count > total - cells_.nodes.size()) cursor_.fail("more nodes than announced");
            for (std::uint64_t i = 0; i < count && !first_of_4_; ++i) tags_.add(cursor_.size());
            for (std::uint64_t i = 0; i < count; ++i) {
                if (first_of_4_) tags_.add(node_tag());
                cells_.nodes.push_back(cursor_.point());
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
            tags_.add(node_tag());
            cells_.nodes.push_back(cursor_.point());
        }
        end_nodes(static_cast<std::uint64_t>(count));
    }

    /// Room for cells that are announced.
    void expect_cells(const ElementType& type, std::uint64_t count)
    {
        if (!nodes_known_) cursor_.fail("$Elements before $Nodes");
        if (count + cells_.hexes.size() > static_cast<std::uint64_t>(std::numeric_limits<Index>::max()))
            cursor_.fail("too many cells");
        // Many small blocks must not each copy what is there.
        if (is_hex(type.type) && count > cells_.hexes.size()) {
            cells_.hexes.reserve(cells_.hexes.size() + count);
            cells_.hex_entity.reserve(cells_.hexes.size() + count);
        }
    }

    /// One cell; `next_tag` reads the tag of each of its nodes.
    template <class NextTag>
    void take_cell(const ElementType& type, int entity, const NextTag& next_tag)
    {
        const auto take = [&](auto& cells, std::vector<int>& entities) {
            auto& cell = cells.emplace_back();
            for (Index& node : cell) node = position(next_tag());
            for (int i = static_cast<int>(cell.size()); i < type.nodes; ++i) next_tag();
            entities.push_back(entity);
        };
        if (is_hex(type.type)) {
            take(cells_.hexes, cells_.hex_entity);
            cells_.order = std::max(cells_.order, type.order);
        } else if (is_quad(type.type)) {
            take(cells_.quads, cells_.quad_entity);
        } else if (is_triangle(type)) {
            take(cells_.triangles, cells_.triangle_entity);
        } else {
            for (int i = 0; i < type.nodes; ++i) next_tag();
            ++others_[{type.dimension, type.type}];
        }
    }

    Index position(std::uint64_t tag) const
    {
        const Index node = tags_.find(tag);
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
                next_tag();
                take_cell(type, entity, next_tag);
            }
        }
    }

    void read_cell_2(const ElementType& type, int tags)
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
        take_cell(type, entity, [&] { return node_tag(); });
    }

    void read_elements_2()
    {
        const std::int64_t announced = cursor_.text_integer();
        cursor_.line();
        if (announced < 0) cursor_.fail("a negative number of cells");
        const std::uint64_t total = cursor_.plausible(static_cast<std::uint64_t>(announced), 8, 4);
        for (std::uint64_t done = 0; done < total;) {
            if (cursor_.coding == Coding::text) cursor_.integer();
            const ElementType type = type_of(cursor_, cursor_.integer());
            const int count = cursor_.coding == Coding::text ? 1 : cursor_.integer();
            const int tags = cursor_.integer();
            if (count < 1 || tags < 0 || static_cast<std::uint64_t>(count) > total - done)
                cursor_.fail("a block of " + std::to_string(count) + " cells with " + std::to_string(tags) +
                             " tags");
            const auto values = static_cast<std::uint64_t>(type.nodes) + static_cast<std::uint64_t>(tags);
            cursor_.plausible(static_cast<std::uint64_t>(count), 4 * (values + 1), values);
            if (count > 1) expect_cells(type, static_cast<std::uint64_t>(count));
            if (!nodes_known_) cursor_.fail("$Elements before $Nodes");
            for (int i = 0; i < count; ++i) {
                if (cursor_.coding != Coding::text) cursor_.integer();
                read_cell_2(type, tags);
            }
            done += static_cast<std::uint64_t>(count);
        }
    }

    void take_groups()
    {
        for (const auto& [key, name] : names_) members_[key];
        for (const auto& [key, entities] : members_) {
            const auto name = names_.find(key);
            cells_.groups.push_back({key.first,
                                     key.second,
                                     name == names_.end() ? "" : name->second,
                                     {entities.begin(), entities.end()}});
        }
        for (const auto& [key, count] : others_) cells_.others.push_back({key.first, key.second, count});
    }

    using Key = std::pair<int, int>; // dimension, tag
    Cursor& cursor_;
    MshCells cells_;
    NodeTags tags_;
    std::map<Key, std::string> names_;
    std::map<Key, std::set<int>> members_;
    std::map<Key, std::size_t> others_;
    int version_ = 0;
    bool first_of_4_ = false; ///< version 4.0, which counts tags in 4 bytes and has them in another order
    bool nodes_known_ = false;
};

} // namespace

MshCells read_msh(const std::string& path)
{
    const std::string data = read_file(path);
    Cursor cursor(path, data);
    return Reader(cursor).read();
}

void read_msh_facets(Cursor& cursor, FacetCollector& into)
{
    MshCells cells = Reader(cursor).read();
    into.points() = std::move(cells.nodes);
    std::map<int, std::string> names;
    for (const MshGroup& group : cells.groups) {
        if (group.dimension != 2 || trimmed(group.name).empty()) continue;
        for (const int entity : group.entities) names.try_emplace(entity, group.name);
    }
    const auto take = [&](const auto& faces, const std::vector<int>& entities) {
        for (std::size_t f = 0; f < faces.size(); ++f) {
            const auto name = names.find(entities[f]);
            const int label = into.label_of(entities[f], name == names.end() ? "" : name->second);
            into.add_face(faces[f], label, cursor);
        }
    };
    take(cells.triangles, cells.triangle_entity);
    take(cells.quads, cells.quad_entity);
    into.pass_over_solid("hexahedra", cells.hexes.size());
    for (const OtherCells& other : cells.others) {
        const std::string what = "cells of type " + std::to_string(other.type);
        other.dimension == 3 ? into.pass_over_solid(what, other.count) : into.pass_over(what, other.count);
    }
    into.sort_by_label();
}

} // namespace lacuna::io
