// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/large_pages.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/exodus.h>
#include <lacuna/io/detail/vtk_cells.h>
#include <lacuna/io/shared/units.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

namespace lacuna::io {
namespace {

/// An array of a netCDF file.
struct NcArray {
    std::vector<std::size_t> lengths; ///< lengths of its dimensions
    std::string element_type{};       ///< attribute `elem_type`
    std::string name{}, units{};      ///< attributes of these names
    const VtkType* type = nullptr;
    std::uint64_t begin = 0;
    bool records = false; ///< the array exists once per time step
};

/// The header of a netCDF file in a classic format: with 32-bit offsets, with 64-bit offsets, or with all
/// counts of 64 bits.
class NcHead {
public:
    NcHead(Cursor& cursor) : cursor_(cursor)
    {
        cursor_.has_bytes = true;
        if (cursor_.rest().starts_with("\x89HDF"))
            cursor_.fail(Message(kUnreadable, "this file is netCDF-4 (HDF5); expected the classic format")
                             .remedy("convert it with nccopy -k 64-bit-offset in.exo out.exo"));
        const std::string_view magic = cursor_.bytes(4);
        const char version = magic[3];
        if (!magic.starts_with("CDF") || (version != 1 && version != 2 && version != 5))
            cursor_.fail("expected a netCDF file, which begins with CDF");
        cursor_.coding = Coding::big;
        wide_ = version == 5;
        wide_offsets_ = version != 1;
        count(); // number of time steps
        read_dimensions();
        skip_attributes(nullptr);
        read_arrays();
    }

    [[nodiscard]] const NcArray* find(const std::string& name) const
    {
        const auto found = arrays_.find(name);
        return found == arrays_.end() ? nullptr : &found->second;
    }
    [[nodiscard]] std::size_t dimension(const std::string& name) const
    {
        const auto found = lengths_.find(name);
        return found == lengths_.end() ? 0 : found->second;
    }

    /// The bytes of an array. @param values  the number of values that it must have.
    [[nodiscard]] std::string_view bytes(const NcArray& array, const std::string& name,
                                         std::size_t values) const
    {
        if (array.records) cursor_.fail("expected {} once, found it for each time step", name);
        std::size_t all = 1;
        const std::string_view file = whole_.rest();
        for (const std::size_t length : array.lengths) {
            if (length > file.size()) all = file.size() + 1;
            if (length == 0) all = 0;
            all = all > file.size() ? file.size() + 1 : all * length;
        }
        if (array.type == nullptr) cursor_.fail("expected numbers or text as {}", name);
        if (all != values)
            cursor_.fail("expected {} values of {}, found {}", needed(values), name,
                         found(all > file.size() ? "more than the file holds" : std::to_string(all)));
        if (array.begin > file.size() || values > (file.size() - array.begin) / array.type->bytes)
            cursor_.fail("the file is cut off: expected {} values of {}", needed(values), name);
        taken_ += values * array.type->bytes;
        if (taken_ > kMostTimes * file.size()) cursor_.fail("its arrays overlap");
        return file.substr(array.begin, values * array.type->bytes);
    }

    [[nodiscard]] std::vector<std::int64_t> wholes(const NcArray& array, const std::string& name,
                                                   std::size_t values) const
    {
        const std::string_view raw = bytes(array, name, values);
        if (array.type->wholes == nullptr) cursor_.fail("expected whole numbers as {}", name);
        std::vector<std::int64_t> all(values);
        array.type->wholes(raw.data(), true, values, all.data());
        return all;
    }

private:
    std::uint64_t count()
    {
        if (!wide_) return static_cast<std::uint32_t>(cursor_.integer());
        return cursor_.size();
    }

    std::string name()
    {
        const std::uint64_t length = count();
        const std::string_view text = cursor_.bytes(length);
        cursor_.bytes((4 - length % 4) % 4);
        return std::string(text);
    }

    /// Number of dimensions, attributes or arrays that follow.
    std::uint64_t list(int tag)
    {
        const int found = cursor_.integer();
        const std::uint64_t length = count();
        if (found != tag && (found != 0 || length != 0))
            cursor_.fail("expected a list of kind {}, found {}", needed(tag), lacuna::found(found));
        return cursor_.plausible(length, 8, 1);
    }

    void read_dimensions()
    {
        const std::uint64_t all = list(10);
        for (std::uint64_t d = 0; d < all; ++d) {
            const std::string of = name();
            const std::uint64_t length = count();
            dimensions_.push_back(length);
            lengths_[of] = length;
        }
    }

    /// @param array  receives the texts of attributes that describe it; may be null.
    void skip_attributes(NcArray* array)
    {
        const std::uint64_t all = list(12);
        for (std::uint64_t a = 0; a < all; ++a) {
            const std::string of = name();
            const VtkType* type = type_of(cursor_.integer());
            const std::uint64_t length = count();
            if (type == nullptr) cursor_.fail("expected numbers or text in the attribute {}", shown(of));
            const std::uint64_t size = cursor_.plausible(length, type->bytes, 1) * type->bytes;
            const std::string_view text = cursor_.bytes(size);
            cursor_.bytes((4 - size % 4) % 4);
            if (array == nullptr) continue;
            if (of == "elem_type") array->element_type = text.substr(0, text.find('\0'));
            if (of == "name") array->name = text.substr(0, text.find('\0'));
            if (of == "units") array->units = text.substr(0, text.find('\0'));
        }
    }

    void read_arrays()
    {
        const std::uint64_t all = list(11);
        for (std::uint64_t v = 0; v < all; ++v) {
            const std::string of = name();
            NcArray array;
            const std::uint64_t rank = cursor_.plausible(count(), 4, 1);
            for (std::uint64_t d = 0; d < rank; ++d) {
                const std::uint64_t dimension = count();
                if (dimension >= dimensions_.size())
                    cursor_.fail("expected a dimension of {} for {}, found number {}", dimensions_.size(),
                                 shown(of), found(dimension));
                array.lengths.push_back(dimensions_[dimension]);
                array.records = array.records || (d == 0 && array.lengths.back() == 0);
            }
            skip_attributes(&array);
            array.type = type_of(cursor_.integer());
            count(); // skip the number of bytes, which follows from the dimensions
            array.begin = wide_offsets_ ? cursor_.size() : static_cast<std::uint32_t>(cursor_.integer());
            arrays_.insert_or_assign(of, std::move(array));
        }
    }

    static const VtkType* type_of(int number)
    {
        constexpr std::string_view kNames[] = {"",        "Int8",  "UInt8",  "Int16",  "Int32", "Float32",
                                               "Float64", "UInt8", "UInt16", "UInt32", "Int64", "UInt64"};
        return number < 1 || number > 11 ? nullptr : vtk_type(kNames[number]);
    }

    static constexpr std::uint64_t kMostTimes = 3; // limit on the bytes read, relative to the size of the
                                                   // file: each array is read at most twice

    Cursor& cursor_;
    /// Bytes read so far; stops files in which many arrays share the same bytes.
    mutable std::uint64_t taken_ = 0;
    Cursor whole_ = cursor_; ///< cursor at the beginning of the file
    bool wide_ = false, wide_offsets_ = false;
    std::vector<std::size_t> dimensions_;
    std::map<std::string, std::size_t> lengths_;
    std::map<std::string, NcArray> arrays_;
};

class ExodusReader {
public:
    ExodusReader(Cursor& cursor, DeckBuilder& into) : cursor_(cursor), into_(into), head_(cursor) {}

    void read()
    {
        read_points();
        read_blocks();
        const TagPlaces places(numbers_, [&](Index, Index at) {
            cursor_.fail("{} has the same number as an earlier one",
                         numbered("element", numbers_[index(at)]));
        });
        read_sets("ns", "node_ns", "num_nod_ns", DeckSet::Kind::nodes);
        read_sets("els", "elem_els", "num_ele_els", DeckSet::Kind::elements);
        read_sets("ss", "elem_ss", "num_side_ss", DeckSet::Kind::sides);
    }

private:
    const NcArray& needed(const std::string& name) const
    {
        const NcArray* array = head_.find(name);
        if (array == nullptr) cursor_.fail("expected the array {}, found none", name);
        return *array;
    }

    /// Numbers of nodes or elements: from a map, or consecutive if there is none.
    std::vector<DeckTag> numbers(const char* map, const char* older, std::size_t count) const
    {
        const char* const name = head_.find(map) != nullptr ? map : older;
        std::vector<DeckTag> all = ids(name, count);
        for (const DeckTag tag : all)
            if (tag < 0) cursor_.fail("{} has the number {}", name, tag);
        return all;
    }

    void read_points()
    {
        const std::size_t count = head_.dimension("num_nodes");
        const std::size_t axes = head_.dimension("num_dim");
        if (axes < 2 || axes > 3) cursor_.fail("expected 2 or 3 as num_dim, found {}", found(axes));
        if (!is_index(count)) cursor_.fail("too many nodes");
        const NcArray* together = head_.find("coord");
        std::string_view all;
        if (together != nullptr) all = head_.bytes(*together, "coord", axes * count);
        std::vector<Vec3>& points = into_.points();
        for (std::size_t axis = 0; axis < axes; ++axis) {
            const std::string name = std::string("coord") + "xyz"[axis];
            const NcArray& array = together != nullptr ? *together : needed(name);
            if (is_unit(array.units)) into_.deck().unit = array.units;
            const std::string_view raw = together != nullptr ? all.substr(axis * count * array.type->bytes)
                                                             : head_.bytes(array, name, count);
            if (axis == 0) {
                reserve_large(points, count);
                points.resize(count, Vec3::Zero());
            }
            auto point = points.begin();
            each_part<double>(*array.type, raw.substr(0, count * array.type->bytes), true,
                              [&](std::span<const double> values) {
                                  for (const double value : values) {
                                      if (!std::isfinite(value))
                                          cursor_.fail("expected finite coordinates in {}", name);
                                      (*point++)[static_cast<Index>(axis)] = value;
                                  }
                              });
        }
        std::vector<DeckTag> tags = numbers("node_num_map", "node_map", count);
        const TagPlaces unique(tags, [&](Index, Index at) {
            cursor_.fail("{} has the same number as an earlier one", numbered("node", tags[index(at)]));
        });
        into_.deck().point_tags = std::move(tags);
    }

    /// Names of blocks or sets. Those without a name get "what_id".
    std::vector<std::string> names(const std::string& array, const std::string& what,
                                   const std::vector<std::int64_t>& ids) const
    {
        std::vector<std::string> all;
        for (const std::int64_t id : ids) all.push_back(what + "_" + std::to_string(id));
        const NcArray* named = head_.find(array);
        if (named == nullptr || named->lengths.size() != 2) return all;
        const std::size_t length = named->lengths[1];
        const std::string_view text = head_.bytes(*named, array, ids.size() * length);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::string_view own = text.substr(i * length, length);
            if (const auto name = trimmed(own.substr(0, own.find('\0'))); !name.empty()) all[i] = name;
        }
        return all;
    }

    /// Whole numbers from an array, or from 1 up if there is no such array.
    std::vector<std::int64_t> ids(const std::string& array, std::size_t count) const
    {
        if (const NcArray* known = head_.find(array)) return head_.wholes(*known, array, count);
        cursor_.plausible(count, 4, 1);
        std::vector<std::int64_t> all(count);
        std::iota(all.begin(), all.end(), 1);
        return all;
    }

    static int tag_of(std::int64_t id)
    {
        return static_cast<int>(std::clamp<std::int64_t>(id, 0, std::numeric_limits<int>::max() - 1));
    }

    void read_blocks()
    {
        const std::size_t count = head_.dimension("num_el_blk");
        cursor_.plausible(count, 4, 1);
        const std::vector<std::int64_t> id = ids("eb_prop1", count);
        const std::vector<std::string> name = names("eb_names", "block", id);
        numbers_ = numbers("elem_num_map", "elem_map", elements_of(count));
        shapes_.resize(numbers_.size());
        const NcArray* property = head_.find("eb_prop2");
        const bool several = property != nullptr && property->name == kRegionProperty;
        const std::vector<std::int64_t> whole = several ? head_.wholes(*property, "eb_prop2", count) : id;
        std::map<std::int64_t, std::optional<Index>> regions; // region of each group of blocks, by the id of
                                                              // its first block
        std::size_t first = 0;
        for (std::size_t b = 0; b < count; ++b) {
            std::optional<Index> own;
            first += read_block("connect" + std::to_string(b + 1), name[b], tag_of(id[b]), first,
                                several ? regions[whole[b]] : own);
        }
    }

    std::size_t elements_of(std::size_t blocks) const
    {
        std::size_t all = 0;
        for (std::size_t b = 1; b <= blocks; ++b)
            if (const NcArray* array = head_.find("connect" + std::to_string(b));
                array != nullptr && array->lengths.size() == 2 && array->lengths[1] > 0)
                all +=
                    head_.bytes(*array, "connect" + std::to_string(b), array->lengths[0] * array->lengths[1])
                        .size() /
                    array->type->bytes / array->lengths[1];
        return all;
    }

    /// @param region  region of the block's elements; none: one is added.
    /// @return  number of the block's elements
    std::size_t read_block(const std::string& array, const std::string& name, int id, std::size_t first,
                           std::optional<Index>& region)
    {
        const NcArray* connect = head_.find(array);
        if (connect == nullptr || connect->lengths.size() != 2 || connect->lengths[1] == 0) return 0;
        const auto [count, nodes] = std::pair(connect->lengths[0], connect->lengths[1]);
        const std::vector<std::int64_t> all = head_.wholes(*connect, array, count * nodes);
        const std::optional<DeckShape> shape = shape_of(connect->element_type, nodes, name);
        if (!shape) {
            into_.pass_over("elements " + connect->element_type, count);
            return count;
        }
        if (!region) region = into_.add_region(id, name);
        const std::size_t block = into_.block_of(*shape, connect->element_type);
        const DeckBuilder::Room room = into_.add_elements(block, count, *region);
        const auto places = node_places(NodeOrder::exodus, *shape);
        const auto last = static_cast<std::int64_t>(into_.points().size());
        const auto kept = static_cast<std::size_t>(shape_info(*shape).nodes);
        for (std::size_t e = 0; e < count; ++e) {
            room.tags[e] = numbers_[first + e];
            shapes_[first + e] = shape;
            for (std::size_t k = 0; k < kept; ++k) {
                const std::int64_t node = all[e * nodes + places[k]];
                if (node < 1 || node > last)
                    cursor_.fail("{} names {} of {}", array, numbered("node", node), last);
                room.nodes[e * kept + k] = static_cast<Index>(node - 1);
            }
        }
        return count;
    }

    /// The shape of elements, from the beginning of their type word and their number of nodes; empty for
    /// point elements, which are ignored.
    std::optional<DeckShape> shape_of(const std::string& type, std::size_t nodes,
                                      const std::string& name) const
    {
        struct Family {
            std::string_view word;
            int dimension, corners;
        };
        constexpr Family kFamilies[] = {{"HEX", 3, 8},    {"TET", 3, 4},    {"WEDGE", 3, 6}, {"PYRA", 3, 5},
                                        {"QUAD", 2, 4},   {"TRI", 2, 3},    {"SHELL", 2, 4}, {"BEAM", 1, 2},
                                        {"TRUSS", 1, 2},  {"BAR", 1, 2},    {"EDGE", 1, 2},  {"ROD", 1, 2},
                                        {"SPHERE", 0, 1}, {"CIRCLE", 0, 1}, {"POINT", 0, 1}};
        for (const Family& family : kFamilies) {
            if (!same_word(std::string_view(type).substr(0, family.word.size()), family.word)) continue;
            if (family.dimension == 0) return {};
            const bool triangle = family.word == "SHELL" && (nodes == 3 || nodes == 6);
            if (const auto shape = find_shape(family.dimension, triangle ? 3 : family.corners,
                                              static_cast<int>(nodes)))
                return shape;
        }
        cursor_.fail("block {}: elements {} with {} nodes are unknown", shown(name), shown(type), nodes);
    }

    void read_sets(const std::string& kind, const std::string& list, const std::string& length,
                   DeckSet::Kind of)
    {
        const std::size_t count = cursor_.plausible(
            head_.dimension(of == DeckSet::Kind::nodes   ? "num_node_sets"
                            : of == DeckSet::Kind::sides ? "num_side_sets"
                                                         : "num_elem_sets"),
            4, 1);
        const std::vector<std::int64_t> id = ids(kind + "_prop1", count);
        const std::vector<std::string> name = names(kind + "_names", kind, id);
        for (std::size_t s = 0; s < count; ++s) {
            const std::string number = std::to_string(s + 1);
            const NcArray* members = head_.find(list + number);
            if (members == nullptr) continue; // an empty set
            DeckSet set{.kind = of, .tag = tag_of(id[s]), .name = name[s]};
            const std::size_t many = head_.dimension(length + number);
            const std::vector<std::int64_t> all = head_.wholes(*members, list + number, many);
            std::vector<std::int64_t> sides;
            if (of == DeckSet::Kind::sides)
                sides = head_.wholes(needed("side_ss" + number), "side_ss" + number, many);
            const std::vector<DeckTag>& tags = of == DeckSet::Kind::nodes ? into_.deck().point_tags
                                                                          : numbers_;
            for (std::size_t i = 0; i < many; ++i) {
                if (all[i] < 1 || all[i] > static_cast<std::int64_t>(tags.size()))
                    cursor_.fail("{}{} names {} of {}", list, number, all[i], tags.size());
                const auto at = static_cast<std::size_t>(all[i] - 1);
                if (of != DeckSet::Kind::sides)
                    set.members.push_back(tags[at]);
                else if (shapes_[at])
                    set.sides.push_back({tags[at], side_of(*shapes_[at], sides[i], "side_ss" + number)});
            }
            tidy(set);
            if (!set.members.empty() || !set.sides.empty()) into_.deck().sets.push_back(std::move(set));
        }
    }

    int side_of(DeckShape shape, std::int64_t exodus, const std::string& array) const
    {
        int side = 0;
        if (exodus < 1 || exodus > 6 || !abaqus_side(shape, static_cast<int>(exodus), side))
            cursor_.fail("{} names side {}, which the element does not have", array, exodus);
        return side;
    }

    Cursor& cursor_;
    DeckBuilder& into_;
    NcHead head_;
    std::vector<DeckTag> numbers_;                 ///< numbers of all elements, block after block
    std::vector<std::optional<DeckShape>> shapes_; ///< the shapes of these elements; empty: the element is
                                                   ///< ignored
};

} // namespace

int exodus_side(DeckShape shape, int side)
{
    const DeckShapeInfo& info = shape_info(shape);
    if (info.dimension == 2) return side == 0 ? 1 : side == -1 ? 2 : side + 2;
    const int ends = info.corners == 4 || info.corners == 5 ? 1 : 2;
    const int faces = static_cast<int>(face_corners(shape).size());
    return side <= ends ? faces - ends + side : side - ends;
}

bool abaqus_side(DeckShape shape, int exodus, int& side)
{
    const int sides = shape_info(shape).dimension == 2 ? shape_info(shape).corners
                                                       : static_cast<int>(face_corners(shape).size());
    for (side = shape_info(shape).dimension == 2 ? -1 : 1; side <= sides; ++side)
        if (exodus_side(shape, side) == exodus) return true;
    return false;
}

void read_exodus(Cursor& cursor, DeckBuilder& into) { ExodusReader(cursor, into).read(); }

} // namespace lacuna::io
