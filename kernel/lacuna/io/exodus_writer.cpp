// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/cursor.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/exodus.h>
#include <lacuna/io/detail/format_table.h>
#include <lacuna/io/detail/sections.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <set>

namespace lacuna::io {

namespace {

using mesh::MeshView;

enum class NcType : std::int32_t { text = 2, whole = 4, real32 = 5, real = 6 };

std::size_t bytes_of(NcType type) { return type == NcType::text ? 1 : type == NcType::real ? 8 : 4; }
std::size_t padded(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

template <class Value>
void put_big(std::string& out, Value value)
{
    char bytes[sizeof value];
    io::put_big(static_cast<char*>(bytes), value);
    out.append(bytes, sizeof bytes);
}

void put_name(std::string& out, std::string_view name)
{
    put_big(out, static_cast<std::int32_t>(name.size()));
    out += name;
    out.append(padded(name.size()) - name.size(), '\0');
}

struct Attribute {
    std::string name;
    NcType type;
    std::string values{}; ///< bytes as in the file
    std::size_t count = 1;
};

Attribute text_attribute(const std::string& name, const std::string& value)
{
    return {name, NcType::text, value, value.size()};
}
template <class Value>
Attribute number_attribute(const std::string& name, NcType type, Value value)
{
    Attribute attribute{name, type};
    put_big(attribute.values, value);
    return attribute;
}

/// A netCDF file: dimensions, attributes, arrays.
class NcFile {
public:
    int dimension(const std::string& name, std::size_t length)
    {
        dimensions_.emplace_back(name, length);
        return static_cast<int>(dimensions_.size()) - 1;
    }
    void attribute(Attribute attribute) { attributes_.push_back(std::move(attribute)); }
    /// @param fill  writes the records of the array, `record` numbers each, most significant byte first.
    void array(const std::string& name, NcType type, std::vector<int> dimensions, std::size_t record,
               Fill fill, std::vector<Attribute> attributes = {})
    {
        std::size_t count = 1;
        for (const int d : dimensions) count *= dimensions_[index(d)].second;
        arrays_.push_back(
            {name, type, std::move(dimensions), std::move(attributes), count, record, std::move(fill)});
    }
    /// Write numbers one by one with `value(i)`.
    template <class Value>
    void wholes(const std::string& name, std::vector<int> dimensions, Value value,
                std::vector<Attribute> attributes = {})
    {
        array(name, NcType::whole, std::move(dimensions), 1, each([value](std::size_t i, char* out) {
                  return io::put_big(out, static_cast<std::int32_t>(value(i)));
              }),
              std::move(attributes));
    }
    /// Write names, padded with zeros to equal length.
    void names(const std::string& name, std::vector<int> dimensions, std::vector<std::string> all)
    {
        const std::size_t length = dimensions_[index(dimensions.back())].second;
        array(name, NcType::text, std::move(dimensions), length,
              each([length, all = std::move(all)](std::size_t i, char* out) {
                  std::fill_n(out, length, '\0');
                  all[i].copy(out, length - 1);
                  return out + length;
              }));
    }

    /// The file's sections. @throw InvalidInput  an array that the format cannot hold.
    std::vector<Section> take()
    {
        std::string head("CDF\2", 4);
        put_big(head, std::int32_t{0}); // no time steps
        put_big(head, std::int32_t{10});
        put_big(head, static_cast<std::int32_t>(dimensions_.size()));
        for (const auto& [name, length] : dimensions_) {
            put_name(head, name);
            put_big(head, static_cast<std::int32_t>(length));
        }
        put_attributes(head, attributes_);
        put_big(head, std::int32_t{11});
        put_big(head, static_cast<std::int32_t>(arrays_.size()));
        std::size_t begin = head.size();
        for (const Array& array : arrays_) {
            std::string text;
            put_array(text, array, 0, 0);
            begin += text.size();
        }
        std::vector<Section> sections(1);
        for (Array& array : arrays_) {
            const std::size_t bytes = array.count * bytes_of(array.type);
            constexpr std::size_t kMost = 0xffff'fffb; // largest byte count that the format can store
            if (bytes > kMost)
                throw InvalidInput(Message("io.too_large",
                                           "{} would have {} bytes, more than a netCDF array can hold",
                                           array.name, bytes)
                                       .remedy("write another format"));
            // The size of an array that exists once for each time step is that of one step.
            put_array(head, array, padded(array.count == 0 ? array.record * bytes_of(array.type) : bytes),
                      begin);
            begin += padded(bytes);
            sections.push_back({{},
                                array.record == 0 ? 0 : array.count / array.record,
                                array.record * bytes_of(array.type),
                                std::move(array.fill)});
            // zeros up to the next multiple of four, where the following array starts
            sections.push_back({std::string(padded(bytes) - bytes, '\0'), 0, 0, {}});
        }
        sections.front().text = std::move(head);
        return sections;
    }

private:
    struct Array {
        std::string name;
        NcType type;
        std::vector<int> dimensions;
        std::vector<Attribute> attributes;
        std::size_t count, record;
        Fill fill;
    };

    static void put_attributes(std::string& out, const std::vector<Attribute>& all)
    {
        put_big(out, static_cast<std::int32_t>(all.empty() ? 0 : 12));
        put_big(out, static_cast<std::int32_t>(all.size()));
        for (const Attribute& attribute : all) {
            put_name(out, attribute.name);
            put_big(out, static_cast<std::int32_t>(attribute.type));
            put_big(out, static_cast<std::int32_t>(attribute.count));
            out += attribute.values;
            out.append(padded(attribute.values.size()) - attribute.values.size(), '\0');
        }
    }

    static void put_array(std::string& out, const Array& array, std::size_t bytes, std::size_t begin)
    {
        put_name(out, array.name);
        put_big(out, static_cast<std::int32_t>(array.dimensions.size()));
        for (const int d : array.dimensions) put_big(out, static_cast<std::int32_t>(d));
        put_attributes(out, array.attributes);
        put_big(out, static_cast<std::int32_t>(array.type));
        put_big(out, static_cast<std::uint32_t>(bytes));
        put_big(out, static_cast<std::uint64_t>(begin));
    }

    std::vector<std::pair<std::string, std::size_t>> dimensions_;
    std::vector<Attribute> attributes_;
    std::vector<Array> arrays_;
};

/// Write the numbers of an element's nodes in Exodus's order.
/// @param places  from `node_places()`
char* put_nodes(std::span<const std::uint8_t> places, std::span<const Index> nodes, char* out)
{
    std::array<Index, 27> ordered{};
    for (std::size_t k = 0; k < nodes.size(); ++k) ordered[places[k]] = nodes[k];
    for (std::size_t k = 0; k < nodes.size(); ++k)
        out = io::put_big(out, static_cast<std::int32_t>(ordered[k]) + 1);
    return out;
}

/// Elements of one region and shape.
struct Block {
    Index region = -1;
    std::size_t of = 0;      ///< index of the block in the view
    mesh::Ranges elements{}; ///< indices of its cells in that block
    std::size_t first = 0;   ///< number of its first element in the file, from 0
    std::string name{};
    int id = 0;
    int whole = 0; ///< id of the first block of its region
};

/// Maps the numbers of nodes or elements to their positions in the file, from 0.
class Places {
public:
    /// Add numbers. Their positions follow those of the numbers added before.
    void add(const mesh::Numbers& numbers, std::size_t begin, std::size_t end)
    {
        numbers.each_range(begin, end, [&](std::size_t first, std::size_t last) {
            runs_.push_back({first, last, count_});
            count_ += last - first;
        });
    }
    void sort()
    {
        if (!std::ranges::is_sorted(runs_, {}, &Run::first)) std::ranges::stable_sort(runs_, {}, &Run::first);
    }
    /// Call `visit(first, last)` for the positions of the numbers [number, end) that are known.
    template <class Visit>
    void each(std::size_t number, std::size_t end, const Visit& visit) const
    {
        auto run = std::ranges::upper_bound(runs_, number, {}, &Run::first);
        if (run != runs_.begin()) --run;
        for (; run != runs_.end() && run->first < end; ++run) {
            const std::size_t first = std::max(number, run->first), last = std::min(end, run->last);
            if (first < last) visit(run->place + (first - run->first), run->place + (last - run->first));
        }
    }

private:
    struct Run {
        std::size_t first, last, place;
    };
    std::vector<Run> runs_;
    std::size_t count_ = 0;
};

class ExodusWriter {
public:
    ExodusWriter(const View& view, std::string unit) : view_(view), unit_(std::move(unit)) {}

    DeckFile write()
    {
        find_blocks();
        name_blocks();
        find_sets();
        std::size_t longest = kLeastName;
        for (const Block& block : *blocks_) longest = std::max(longest, block.name.size());
        for (const MeshView::Set& set : view_->sets) longest = std::max(longest, set.name.size());
        // Without fields, the time step is a record dimension without records.
        const int time = nc_.dimension("time_step", view_->fields.empty() ? 0 : 1);
        name_ = nc_.dimension("len_name", longest + 1);
        nc_.dimension("len_string", kLeastName + 1);
        nc_.dimension("len_line", 81);
        nc_.dimension("four", 4);
        nc_.attribute(number_attribute("api_version", NcType::real32, 5.22F));
        nc_.attribute(number_attribute("version", NcType::real32, 5.22F));
        nc_.attribute(number_attribute("floating_point_word_size", NcType::whole, std::int32_t{8}));
        nc_.attribute(number_attribute("file_size", NcType::whole, std::int32_t{1}));
        nc_.attribute(
            number_attribute("maximum_name_length", NcType::whole, static_cast<std::int32_t>(longest)));
        nc_.attribute(number_attribute("int64_status", NcType::whole, std::int32_t{0}));
        nc_.attribute(text_attribute("title", "hexahedra"));
        add_points();
        add_blocks();
        add_sets("node_sets", "ns", "num_nod_ns", "node_ns", nodes_);
        add_sets("elem_sets", "els", "num_ele_els", "elem_els", cells_);
        add_sets("side_sets", "ss", "num_side_ss", "elem_ss", sides_);
        if (!view_->fields.empty()) add_fields(time);
        nc_.array("time_whole", NcType::real, {time}, 1,
                  each([](std::size_t, char* out) { return io::put_big(out, 0.0); }));
        file_.sections = nc_.take();
        file_.sizes = Sizes::exact;
        return std::move(file_);
    }

private:
    static constexpr std::size_t kLeastName = 32; // every reader has room for names of this length
                                                  // [characters]

    struct Set {
        std::string name;
        mesh::Ranges members{};                             ///< positions of the members, from 1
        std::shared_ptr<std::vector<std::int32_t>> sides{}; ///< for each member, the number of its side;
                                                            ///< null: not a set of sides
    };

    void find_blocks()
    {
        for (std::size_t b = 0; b < view_->blocks.size(); ++b) {
            const MeshView::Block& block = view_->blocks[b];
            if (*words_of(block.shape).exodus == 0)
                refuse_element(block, "Exodus", "there is no such element");
            std::map<Index, std::size_t> of_region;
            mesh::each_run(block.regions, 0, block.count,
                           [&](std::size_t first, std::size_t last, Index region) {
                               const auto [at, fresh] = of_region.try_emplace(region, blocks_->size());
                               if (fresh) blocks_->push_back({.region = region, .of = b});
                               (*blocks_)[at->second].elements.add(first, last);
                           });
        }
        for (Block& block : *blocks_) {
            block.first = elements_;
            elements_ += block.elements.count();
        }
    }

    /// Name the blocks. The first block of a region has the region's name and tag. Further blocks get the
    /// name with a number appended, and ids above all tags.
    void name_blocks()
    {
        std::set<std::string> names;
        std::set<int> ids;
        std::map<Index, int> wholes;
        int next = highest_tag(view_->regions);
        for (Block& block : *blocks_) {
            const int tag = block.region < 0 ? 0 : view_->regions[index(block.region)].tag;
            block.id = tag > 0 && ids.insert(tag).second ? tag : ++next;
            ids.insert(block.id);
            block.whole = wholes.try_emplace(block.region, block.id).first->second;
            const std::string base = block.region < 0 ? "skin" : view_->regions[index(block.region)].name;
            if (!base.empty())
                block.name = free_name(base, DeckFormat::exodus,
                                       [&](const std::string& name) { return !names.insert(name).second; });
        }
    }

    void find_sets()
    {
        Places points, cells;
        points.add(view_->point_tags, 0, view_->points);
        for (const Block& block : *blocks_)
            block.elements.each(0, block.elements.count(), [&](std::size_t first, std::size_t last) {
                cells.add(view_->blocks[block.of].tags, first, last);
            });
        points.sort();
        cells.sort();
        const auto shape = [&](std::size_t place) {
            const auto next = std::ranges::upper_bound(*blocks_, place, {}, &Block::first);
            return view_->blocks[std::prev(next)->of].shape;
        };
        for (const MeshView::Set& set : view_->sets) {
            const bool of_nodes = set.kind == mesh::SetKind::nodes;
            Set found{set.name};
            const auto add = [&](std::size_t first, std::size_t last) {
                found.members.add(first + 1, last + 1);
            };
            set.members.each_range(0, set.count, [&](std::size_t first, std::size_t last) {
                (of_nodes ? points : cells).each(first, last, add);
            });
            if (set.kind == mesh::SetKind::sides) {
                found.sides = std::make_shared<std::vector<std::int32_t>>();
                for (const DeckSide& side : set.sides) {
                    const auto element = static_cast<std::size_t>(side.element);
                    cells.each(element, element + 1, [&](std::size_t place, std::size_t end) {
                        add(place, end);
                        found.sides->push_back(exodus_side(shape(place), side.side));
                    });
                }
            }
            if (found.members.count() == 0) continue;
            (of_nodes ? nodes_ : found.sides != nullptr ? sides_ : cells_).push_back(std::move(found));
        }
    }

    void add_points()
    {
        const int dimension = nc_.dimension("num_dim", 3);
        const int nodes = nc_.dimension("num_nodes", view_->points);
        nc_.names("coor_names", {dimension, name_}, {"x", "y", "z"});
        for (const int axis : {0, 1, 2})
            nc_.array(
                std::string("coord") + "xyz" [axis], NcType::real, { nodes }, 1,
                fill_points(view_, [axis](char* out, const Vec3& p) { return io::put_big(out, p[axis]); }),
                unit_.empty() ? std::vector<Attribute>() : std::vector{text_attribute("units", unit_)});
        nc_.array("node_num_map", NcType::whole, {nodes}, 1, fill_numbers(view_->point_tags, put_whole));
    }

    static char* put_whole(char* out, std::int64_t value)
    {
        return io::put_big(out, static_cast<std::int32_t>(value));
    }

    void add_blocks()
    {
        const int elements = nc_.dimension("num_elem", elements_);
        const int count = nc_.dimension("num_el_blk", blocks_->size());
        std::vector<std::string> names;
        std::vector<int> ids, wholes;
        for (const Block& block : *blocks_) {
            names.push_back(block.name);
            ids.push_back(block.id);
            wholes.push_back(block.whole);
        }
        nc_.wholes("eb_status", {count}, [](std::size_t) { return 1; });
        nc_.wholes("eb_prop1", {count}, [ids](std::size_t i) { return ids[i]; },
                   {text_attribute("name", "ID")});
        if (wholes != ids)
            nc_.wholes("eb_prop2", {count}, [wholes](std::size_t i) { return wholes[i]; },
                       {text_attribute("name", kRegionProperty)});
        nc_.names("eb_names", {count, name_}, names);
        nc_.array("elem_num_map", NcType::whole, {elements}, 1,
                  [view = view_, blocks = blocks_](std::size_t begin, std::size_t end, char* out) {
                      const auto put = [&](std::size_t, DeckTag tag) { out = put_whole(out, tag); };
                      for (const Block& block : *blocks) {
                          const std::size_t last = block.first + block.elements.count();
                          const std::size_t low = std::max(begin, block.first), high = std::min(end, last);
                          if (low >= high) continue;
                          block.elements.each(low - block.first, high - block.first,
                                              [&](std::size_t from, std::size_t to) {
                                                  view->blocks[block.of].tags.each(from, to, put);
                                              });
                      }
                      return out;
                  });
        for (std::size_t b = 0; b < blocks_->size(); ++b) {
            const std::string number = std::to_string(b + 1);
            const Block& block = (*blocks_)[b];
            const MeshView::Block& of = view_->blocks[block.of];
            const auto nodes = static_cast<std::size_t>(shape_info(of.shape).nodes);
            const int rows = nc_.dimension("num_el_in_blk" + number, block.elements.count());
            rows_.push_back(rows);
            const int columns = nc_.dimension("num_nod_per_el" + number, nodes);
            nc_.array(
                "connect" + number, NcType::whole, {rows, columns}, nodes,
                [view = view_, blocks = blocks_, &block, &of](std::size_t begin, std::size_t end, char* out) {
                    const auto places = node_places(NodeOrder::exodus, of.shape);
                    block.elements.each(begin, end, [&](std::size_t first, std::size_t last) {
                        of.each_cell(first, last, [&](std::size_t, std::span<const Index> own) {
                            out = put_nodes(places, own, out);
                        });
                    });
                    return out;
                },
                {text_attribute("elem_type", words_of(of.shape).exodus)});
        }
    }

    void add_sets(const std::string& kind, const std::string& prefix, const std::string& length,
                  const std::string& list, const std::vector<Set>& sets)
    {
        if (sets.empty()) return;
        const int count = nc_.dimension("num_" + kind, sets.size());
        std::vector<std::string> names;
        for (const Set& set : sets) names.push_back(set.name);
        nc_.wholes(prefix + "_status", {count}, [](std::size_t) { return 1; });
        nc_.wholes(prefix + "_prop1", {count}, [](std::size_t i) { return i + 1; },
                   {text_attribute("name", "ID")});
        nc_.names(prefix + "_names", {count, name_}, names);
        for (std::size_t s = 0; s < sets.size(); ++s) {
            const std::string number = std::to_string(s + 1);
            const int members = nc_.dimension(length + number, sets[s].members.count());
            nc_.array(list + number, NcType::whole, {members}, 1,
                      fill_numbers(mesh::Numbers(sets[s].members), put_whole));
            if (sets[s].sides)
                nc_.wholes("side_ss" + number, {members},
                           [all = sets[s].sides](std::size_t i) { return (*all)[i]; });
        }
    }

    /// Add fields: a variable for each component, at the only time step. Readers join _x, _y and _z to
    /// vectors.
    void add_fields(int time)
    {
        std::vector<std::string> names;
        for (const MeshView::Field& field : view_->fields)
            for (std::size_t c = 0; c < field.components; ++c)
                names.push_back(field.components == 1 ? field.name : field.name + "_" + "xyz"[c]);
        const int count = nc_.dimension("num_elem_var", names.size());
        nc_.names("name_elem_var", {count, name_}, names);
        std::size_t variable = 0;
        for (std::size_t f = 0; f < view_->fields.size(); ++f)
            for (std::size_t c = 0; c < view_->fields[f].components; ++c) {
                ++variable;
                for (std::size_t b = 0; b < blocks_->size(); ++b) {
                    const Block& block = (*blocks_)[b];
                    nc_.array("vals_elem_var" + std::to_string(variable) + "eb" + std::to_string(b + 1),
                              NcType::real, {time, rows_[b]}, 1,
                              [view = view_, blocks = blocks_, &block, f, c](std::size_t begin,
                                                                             std::size_t end, char* out) {
                                  const MeshView::Field& field = view->fields[f];
                                  block.elements.each(begin, end, [&](std::size_t first, std::size_t last) {
                                      std::size_t component = 0;
                                      field.each(block.of, first, last, [&](std::size_t, double value) {
                                          if (component++ % field.components == c)
                                              out = io::put_big(out, value);
                                      });
                                  });
                                  return out;
                              });
                }
            }
    }

    View view_;
    std::string unit_;
    DeckFile file_;
    NcFile nc_;
    std::shared_ptr<std::vector<Block>> blocks_ = std::make_shared<std::vector<Block>>();
    std::vector<Set> nodes_, cells_, sides_;
    std::size_t elements_ = 0;
    int name_ = 0;          ///< dimension of names
    std::vector<int> rows_; ///< dimension of the elements of each block
};

} // namespace

DeckFile exodus_file(const View& view, const MeshFileOptions& options, const mesh::ViewParts* /*parts*/)
{
    check_numbers(*view, std::numeric_limits<std::int32_t>::max(), "an Exodus file",
                  "give first_node and first_cell");
    return ExodusWriter(view, options.unit).write();
}

} // namespace lacuna::io
