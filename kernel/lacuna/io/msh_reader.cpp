// SPDX-License-Identifier: MIT
#include <lacuna/io/msh_reader.h>

#include <lacuna/core/error.h>
#include <lacuna/io/detail/msh_cursor.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
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

ElementType type_of(const MshCursor& cursor, int type)
{
    for (const ElementType& known : kTypes)
        if (known.type == type) return known;
    cursor.fail("element type " + std::to_string(type) + " is not known");
}

/// Positions of nodes by the tags the file gives them, which need not be dense.
class NodeTags {
public:
    void add(std::uint64_t tag) { tags_.push_back(tag); }
    [[nodiscard]] std::size_t count() const { return tags_.size(); }

    /// @pre  all tags are added
    void finish(const MshCursor& cursor)
    {
        const std::uint64_t highest = tags_.empty() ? 0 : *std::max_element(tags_.begin(), tags_.end());
        if (highest <= 4 * tags_.size() + 1024) {
            dense_.assign(highest + 1, -1);
            for (std::size_t i = 0; i < tags_.size(); ++i) {
                if (dense_[tags_[i]] >= 0)
                    cursor.fail("node " + std::to_string(tags_[i]) + " is there twice");
                dense_[tags_[i]] = static_cast<Index>(i);
            }
            return;
        }
        for (std::size_t i = 0; i < tags_.size(); ++i) sparse_.push_back({tags_[i], static_cast<Index>(i)});
        std::sort(sparse_.begin(), sparse_.end());
        for (std::size_t i = 1; i < sparse_.size(); ++i)
            if (sparse_[i].first == sparse_[i - 1].first)
                cursor.fail("node " + std::to_string(sparse_[i].first) + " is there twice");
    }

    [[nodiscard]] Index position(const MshCursor& cursor, std::uint64_t tag) const
    {
        if (tag < dense_.size() && dense_[tag] >= 0) return dense_[tag];
        const auto found = std::lower_bound(sparse_.begin(), sparse_.end(),
                                            std::pair<std::uint64_t, Index>{tag, 0});
        if (found == sparse_.end() || found->first != tag)
            cursor.fail("a cell names node " + std::to_string(tag) + ", which is not there");
        return found->second;
    }

private:
    std::vector<std::uint64_t> tags_;
    std::vector<Index> dense_;
    std::vector<std::pair<std::uint64_t, Index>> sparse_;
};

class Reader {
public:
    Reader(const std::string& path, std::string_view data) : cursor_(path, data) {}

    HexCells read()
    {
        while (!cursor_.at_end()) {
            const std::string_view line = cursor_.line();
            if (line.empty()) continue;
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
        cursor_.leave(name);
    }

    void read_format()
    {
        const double version = cursor_.text_real();
        const std::int64_t binary = cursor_.text_integer();
        const std::int64_t bytes = cursor_.text_integer();
        if (version != 4.1 && !(version >= 2 && version < 3))
            cursor_.fail("only versions 4.1 and 2.2 are read; save the mesh anew as one of them");
        if (bytes != 8)
            cursor_.fail("numbers of " + std::to_string(bytes) + " bytes are not read; expected 8");
        version_ = version == 4.1 ? 4 : 2;
        cursor_.line();
        if (binary == 1) {
            cursor_.binary = true;
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
            group.dimension = static_cast<int>(cursor_.text_integer());
            group.tag = static_cast<int>(cursor_.text_integer());
            const std::string_view rest = cursor_.line();
            const std::size_t first = rest.find('"');
            const std::size_t last = rest.rfind('"');
            if (first == std::string_view::npos || last == first) cursor_.fail("expected a name in quotes");
            names_[{group.dimension, group.tag}] = std::string(rest.substr(first + 1, last - first - 1));
        }
    }

    void read_entities()
    {
        std::uint64_t counts[4];
        for (std::uint64_t& count : counts) count = cursor_.size();
        for (int dimension = 0; dimension < 4; ++dimension) {
            const int reals = dimension == 0 ? 3 : 6;
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

    void begin_nodes(std::uint64_t count, std::uint64_t bytes, std::uint64_t values)
    {
        if (nodes_known_) cursor_.fail("a second $Nodes");
        cursor_.plausible(count, bytes, values);
        if (count > static_cast<std::uint64_t>(std::numeric_limits<Index>::max()))
            cursor_.fail("too many nodes");
        cells_.nodes.reserve(count);
    }

    void end_nodes(std::uint64_t count)
    {
        if (cells_.nodes.size() != count)
            cursor_.fail("the file announces " + std::to_string(count) + " nodes and holds " +
                         std::to_string(cells_.nodes.size()));
        tags_.finish(cursor_);
        nodes_known_ = true;
    }

    void read_point()
    {
        const double x = cursor_.real();
        const double y = cursor_.real();
        const double z = cursor_.real();
        cells_.nodes.emplace_back(x, y, z);
    }

    void read_nodes_4()
    {
        const std::uint64_t blocks = cursor_.plausible(cursor_.size(), 20, 4);
        const std::uint64_t total = cursor_.size();
        cursor_.size();
        cursor_.size();
        begin_nodes(total, 32, 4);
        for (std::uint64_t b = 0; b < blocks; ++b) {
            const int dimension = cursor_.integer();
            cursor_.integer();
            const bool parametric = cursor_.integer() != 0;
            if (dimension < 0 || dimension > 3)
                cursor_.fail("nodes of dimension " + std::to_string(dimension));
            const std::uint64_t count = cursor_.plausible(cursor_.size(), 32, 4);
            if (count > total - cells_.nodes.size()) cursor_.fail("more nodes than announced");
            for (std::uint64_t i = 0; i < count; ++i) tags_.add(cursor_.size());
            for (std::uint64_t i = 0; i < count; ++i) {
                read_point();
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
            const int tag = cursor_.integer();
            if (tag < 0) cursor_.fail("node tag " + std::to_string(tag) + " is negative");
            tags_.add(static_cast<std::uint64_t>(tag));
            read_point();
        }
        end_nodes(static_cast<std::uint64_t>(count));
    }

    /// Room for cells that are announced.
    void expect_cells(const ElementType& type, std::uint64_t count)
    {
        if (!nodes_known_) cursor_.fail("$Elements before $Nodes");
        if (count + cells_.hexes.size() > static_cast<std::uint64_t>(std::numeric_limits<Index>::max()))
            cursor_.fail("too many cells");
        if (is_hex(type.type)) {
            cells_.hexes.reserve(cells_.hexes.size() + count);
            cells_.hex_entity.reserve(cells_.hexes.size() + count);
        }
    }

    /// One cell; `next_tag` reads the tag of each of its nodes.
    template <class NextTag>
    void take_cell(const ElementType& type, int entity, const NextTag& next_tag)
    {
        const auto corners = [&](auto& cell) {
            for (Index& node : cell) node = tags_.position(cursor_, next_tag());
            for (int i = static_cast<int>(cell.size()); i < type.nodes; ++i) next_tag();
            return cell;
        };
        if (is_hex(type.type)) {
            Hex hex;
            cells_.hexes.push_back(corners(hex));
            cells_.hex_entity.push_back(entity);
            cells_.order = std::max(cells_.order, type.order);
        } else if (is_quad(type.type)) {
            Quad quad;
            cells_.quads.push_back(corners(quad));
            cells_.quad_entity.push_back(entity);
        } else {
            for (int i = 0; i < type.nodes; ++i) next_tag();
            ++others_[{type.dimension, type.type}];
        }
    }

    void read_elements_4()
    {
        const std::uint64_t blocks = cursor_.plausible(cursor_.size(), 20, 4);
        for (int i = 0; i < 3; ++i) cursor_.size();
        for (std::uint64_t b = 0; b < blocks; ++b) {
            cursor_.integer();
            const int entity = cursor_.integer();
            const ElementType type = type_of(cursor_, cursor_.integer());
            const auto values = static_cast<std::uint64_t>(type.nodes) + 1;
            const std::uint64_t count = cursor_.plausible(cursor_.size(), 8 * values, values);
            expect_cells(type, count);
            for (std::uint64_t i = 0; i < count; ++i) {
                cursor_.size();
                take_cell(type, entity, [&] { return cursor_.size(); });
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
        take_cell(type, entity, [&] {
            const int tag = cursor_.integer();
            if (tag < 0) cursor_.fail("node tag " + std::to_string(tag) + " is negative");
            return static_cast<std::uint64_t>(tag);
        });
    }

    void read_elements_2()
    {
        const std::int64_t announced = cursor_.text_integer();
        cursor_.line();
        if (announced < 0) cursor_.fail("a negative number of cells");
        const std::uint64_t total = cursor_.plausible(static_cast<std::uint64_t>(announced), 8, 4);
        for (std::uint64_t done = 0; done < total;) {
            if (!cursor_.binary) cursor_.integer();
            const ElementType type = type_of(cursor_, cursor_.integer());
            const int count = cursor_.binary ? cursor_.integer() : 1;
            const int tags = cursor_.integer();
            if (count < 1 || tags < 0 || static_cast<std::uint64_t>(count) > total - done)
                cursor_.fail("a block of " + std::to_string(count) + " cells with " + std::to_string(tags) +
                             " tags");
            const auto values = static_cast<std::uint64_t>(type.nodes) + static_cast<std::uint64_t>(tags);
            cursor_.plausible(static_cast<std::uint64_t>(count), 4 * (values + 1), values);
            if (count > 1) expect_cells(type, static_cast<std::uint64_t>(count));
            if (!nodes_known_) cursor_.fail("$Elements before $Nodes");
            for (int i = 0; i < count; ++i) {
                if (cursor_.binary) cursor_.integer();
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
    MshCursor cursor_;
    HexCells cells_;
    NodeTags tags_;
    std::map<Key, std::string> names_;
    std::map<Key, std::set<int>> members_;
    std::map<Key, std::size_t> others_;
    int version_ = 0;
    bool nodes_known_ = false;
};

std::string contents(const std::string& path)
{
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        throw InvalidInput("io.not_a_file", "cannot read '" + path + "': it is a folder");
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw InvalidInput("io.no_file",
                           "cannot open '" + path + "': is the name right, and may it be read?");
    std::string data;
    const auto size = std::filesystem::file_size(path, ignored);
    if (!ignored) {
        data.resize(size);
        file.read(data.data(), static_cast<std::streamsize>(size));
        data.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
    }
    if (file.bad()) throw BackendError("io.read_failed", "reading '" + path + "' failed");
    return data;
}

} // namespace

HexCells read_msh_hexes(const std::string& path)
{
    const std::string data = contents(path);
    return Reader(path, data).read();
}

} // namespace lacuna::io
