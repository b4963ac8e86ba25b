// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/format_table.h>

#include <lacuna/core/message.h>
#include <lacuna/core/shared/team.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/texts.h>
#include <lacuna/io/detail/view_piece.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <set>
#include <utility>

namespace lacuna::io {

namespace {

using mesh::MeshView;

/// The position of VTK's node `k` in the order of DeckShape. In VTK's wedges the triangle 0-1-2 faces away
/// from 3-4-5.
std::size_t place_of_node(DeckShape shape, std::size_t k)
{
    constexpr std::array<std::size_t, 6> kWedge{0, 2, 1, 3, 5, 4};
    return shape == DeckShape::wedge6 ? kWedge[k] : k;
}

std::size_t size_of(const MeshView::Block& block)
{
    return static_cast<std::size_t>(shape_info(block.shape).nodes);
}

/// The total length of the connectivity lists.
std::size_t list_size(const MeshView& view)
{
    std::size_t sum = 0;
    for (const MeshView::Block& block : view.blocks) sum += block.count * size_of(block);
    return sum;
}

/// Writes the records of the cells [begin, end) of a block to `out`.
using FillBlock = std::function<char*(std::size_t block, std::size_t begin, std::size_t end, char* out)>;

/// Make one section for each block. @param bytes  returns the size of a record of a block
std::vector<Section> by_blocks(const MeshView& view,
                               const std::function<std::size_t(const MeshView::Block&)>& bytes,
                               const FillBlock& fill)
{
    std::vector<Section> sections;
    for (std::size_t b = 0; b < view.blocks.size(); ++b)
        sections.push_back(
            {{},
             view.blocks[b].count,
             bytes(view.blocks[b]),
             [b, fill](std::size_t begin, std::size_t end, char* out) { return fill(b, begin, end, out); }});
    if (sections.empty()) sections.emplace_back();
    return sections;
}

/// Writes one value `of(entity)` for each cell.
template <class Of, class Put>
FillBlock by_entity(const View& view, Of of, Put put_one)
{
    return [=](std::size_t b, std::size_t begin, std::size_t end, char* out) {
        mesh::each_run(view->blocks[b].entities, begin, end,
                       [&](std::size_t first, std::size_t last, Index entity) {
                           const std::int32_t value = of(view->entities[index(entity)]);
                           for (; first < last; ++first) out = put_one(out, value);
                       });
        return out;
    };
}

template <class Put>
FillBlock by_field(const View& view, std::size_t f, Put put_one)
{
    return [=](std::size_t b, std::size_t begin, std::size_t end, char* out) {
        view->fields[f].each(b, begin, end, [&](std::size_t, double value) { out = put_one(out, value); });
        return out;
    };
}

template <class Put>
FillBlock by_tag(const View& view, Put put_one)
{
    return [=](std::size_t b, std::size_t begin, std::size_t end, char* out) {
        view->blocks[b].tags.each(begin, end,
                                  [&](std::size_t, std::int64_t tag) { out = put_one(out, tag); });
        return out;
    };
}

int entity_number(const MeshView::Entity& entity) { return entity.number; }
int region_number(const MeshView::Entity& entity) { return entity.region; }

// ---- XML

/// An array of numbers in native byte order; the header of the file names that order.
struct VtuArray {
    enum class Place { points, cells, point_data, cell_data };
    Place place;
    std::string attributes;
    std::vector<Section> sections;

    [[nodiscard]] std::size_t bytes() const
    {
        std::size_t sum = 0;
        for (const Section& section : sections) sum += section.records * section.record_bytes;
        return sum;
    }
};

/// Choose the order of the arrays in the appended data. meshio 5 finds an array by its offset. It reads a
/// wrong array if the offset equals the base64 offset of an earlier array. The order is changed to avoid such
/// equal offsets.
std::vector<std::size_t> order_behind(const std::vector<VtuArray>& arrays)
{
    std::vector<std::size_t> left(arrays.size()), order;
    std::iota(left.begin(), left.end(), std::size_t(0));
    std::set<std::size_t> in_base64;
    std::size_t raw = 0, base64 = 0;
    const auto bytes = [&](std::size_t a) { return sizeof(std::uint64_t) + arrays[a].bytes(); };
    while (!left.empty()) {
        in_base64.insert(base64);
        auto next = std::ranges::find_if(left,
                                         [&](std::size_t a) { return !in_base64.contains(raw + bytes(a)); });
        if (next == left.end()) next = left.begin();
        order.push_back(*next);
        raw += bytes(*next);
        base64 += 4 * ((bytes(*next) + 2) / 3);
        left.erase(next);
    }
    return order;
}

std::string opening(const std::string& type)
{
    const char* order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"1.0\" byte_order=\"" + order +
           "\" header_type=\"UInt64\">\n<" + type;
}

constexpr std::array<std::pair<VtuArray::Place, std::string_view>, 4> kPlaces{
    {{VtuArray::Place::points, "Points"},
     {VtuArray::Place::cells, "Cells"},
     {VtuArray::Place::point_data, "PointData"},
     {VtuArray::Place::cell_data, "CellData"}}};

std::string_view end_of_place(VtuArray::Place place)
{
    return place == VtuArray::Place::cell_data ? " Scalars=\"entity\">\n" : ">\n";
}

std::string pvtu_head(const std::vector<VtuArray>& arrays, int ghosts)
{
    std::string text = formatted("{} GhostLevel=\"{}\">\n", opening("PUnstructuredGrid"), ghosts);
    for (const auto& [place, word] : kPlaces) {
        if (place == VtuArray::Place::cells) continue;
        text.append("<P").append(word).append(end_of_place(place));
        for (const VtuArray& array : arrays)
            if (array.place == place) text.append("<PDataArray ").append(array.attributes).append("/>\n");
        text.append("</P").append(word).append(">\n");
    }
    return text;
}

std::string pvtu_end(const std::vector<std::string>& pieces)
{
    std::string text;
    for (const std::string& name : pieces) text += "<Piece Source=\"" + xml_text(name) + "\"/>\n";
    return text + "</PUnstructuredGrid>\n</VTKFile>\n";
}

std::string piece_name(const std::string& path, std::size_t number)
{
    return std::filesystem::path(path).stem().string() + "_" + std::to_string(number) + ".vtu";
}

std::vector<Section> xml_sections(const MeshView& view, std::vector<VtuArray> arrays)
{
    std::string text = opening("UnstructuredGrid") + ">\n";
    if (!view.lists.empty()) text += "<FieldData>\n";
    // Lists are written as text: they are short, and more binary arrays are harder to order, see
    // `order_behind()`.
    for (const auto& [name, values] : view.lists) {
        text += formatted("<DataArray type=\"Int32\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">",
                          xml_text(name), values.size());
        for (const int value : values) text.append(" ").append(std::to_string(value));
        text += "</DataArray>\n";
    }
    if (!view.lists.empty()) text += "</FieldData>\n";
    text += formatted("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", view.points, view.cells());
    const std::vector<std::size_t> order_of = order_behind(arrays);
    std::vector<std::size_t> offsets(arrays.size());
    std::vector<Section> sections(1);
    std::size_t offset = 0;
    for (const std::size_t a : order_of) {
        offsets[a] = offset;
        const std::size_t bytes = arrays[a].bytes();
        offset += sizeof(std::uint64_t) + bytes;
        put(arrays[a].sections.front().text, static_cast<std::uint64_t>(bytes));
        for (Section& section : arrays[a].sections) sections.push_back(std::move(section));
    }
    for (const auto& [place, word] : kPlaces) {
        text.append("<").append(word).append(end_of_place(place));
        for (std::size_t a = 0; a < arrays.size(); ++a) {
            if (arrays[a].place != place) continue;
            text.append("<DataArray ").append(arrays[a].attributes);
            text.append(" format=\"appended\" offset=\"").append(std::to_string(offsets[a])).append("\"/>\n");
        }
        text.append("</").append(word).append(">\n");
    }
    sections.front().text = text + "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    sections.push_back({"\n</AppendedData>\n</VTKFile>\n", 0, 0, {}});
    return sections;
}

/// The arrays of a view. @param ghosts  the piece whose ghosts are marked; null: none are
std::vector<VtuArray> arrays_of(const View& view, const PieceView* ghosts = nullptr)
{
    using Place = VtuArray::Place;
    std::vector<VtuArray> arrays;
    const auto put_one = [](char* out, auto value) { return put(out, value); };
    const auto of_points = [&](Place place, const std::string& attributes, std::size_t bytes, Fill fill) {
        arrays.push_back({place, attributes, {{{}, view->points, bytes, std::move(fill)}}});
    };
    const auto of_cells = [&](Place place, const std::string& attributes, std::size_t bytes,
                              const FillBlock& fill) {
        arrays.push_back({place, attributes,
                          by_blocks(
                              *view, [=](const MeshView::Block&) { return bytes; }, fill)});
    };
    const bool numbered = view->is_deck || view->point_tags.given();
    const auto number_points = [&] {
        of_points(Place::point_data, "type=\"Int64\" Name=\"node_number\"", 8,
                  fill_numbers(view->point_tags, put_one));
    };
    of_points(Place::points, "type=\"Float64\" NumberOfComponents=\"3\"", sizeof(Vec3),
              [view](std::size_t begin, std::size_t end, char* out) {
                  view->each_point(begin, end, [&](std::span<const Vec3> points) {
                      std::memcpy(out, points.data(), points.size_bytes());
                      out += points.size_bytes();
                  });
                  return out;
              });
    if (view->is_deck) number_points();
    arrays.push_back({Place::cells, "type=\"Int32\" Name=\"connectivity\"",
                      by_blocks(
                          *view, [](const MeshView::Block& block) { return size_of(block) * sizeof(Index); },
                          [view](std::size_t b, std::size_t begin, std::size_t end, char* out) {
                              const MeshView::Block& block = view->blocks[b];
                              block.each_cell(begin, end, [&](std::size_t, std::span<const Index> nodes) {
                                  if (block.shape != DeckShape::wedge6) {
                                      std::memcpy(out, nodes.data(), nodes.size_bytes());
                                      out += nodes.size_bytes();
                                      return;
                                  }
                                  for (std::size_t k = 0; k < nodes.size(); ++k)
                                      out = put(out, nodes[place_of_node(block.shape, k)]);
                              });
                              return out;
                          })});
    std::vector<std::size_t> before{0}; // number of list entries before each block
    for (const MeshView::Block& block : view->blocks)
        before.push_back(before.back() + block.count * size_of(block));
    of_cells(Place::cells, "type=\"Int64\" Name=\"offsets\"", 8,
             [view, before](std::size_t b, std::size_t begin, std::size_t end, char* out) {
                 const std::size_t nodes = size_of(view->blocks[b]);
                 for (; begin < end; ++begin)
                     out = put(out, static_cast<std::int64_t>(before[b] + nodes * (begin + 1)));
                 return out;
             });
    of_cells(Place::cells, "type=\"UInt8\" Name=\"types\"", 1,
             [view](std::size_t b, std::size_t begin, std::size_t end, char* out) {
                 return std::fill_n(out, end - begin, static_cast<char>(words_of(view->blocks[b].shape).vtk));
             });
    of_cells(Place::cell_data, "type=\"Int32\" Name=\"entity\"", 4, by_entity(view, entity_number, put_one));
    if (view->is_deck)
        of_cells(Place::cell_data, "type=\"Int32\" Name=\"region\"", 4,
                 by_entity(view, region_number, put_one));
    for (std::size_t f = 0; f < view->fields.size(); ++f)
        of_cells(Place::cell_data,
                 "type=\"Float64\" Name=\"" + view->fields[f].name + "\"" +
                     (view->fields[f].components == 3 ? " NumberOfComponents=\"3\"" : ""),
                 8 * view->fields[f].components, by_field(view, f, put_one));
    if (numbered && !view->is_deck) number_points();
    if (numbered) of_cells(Place::cell_data, "type=\"Int64\" Name=\"cell_number\"", 8, by_tag(view, put_one));
    if (ghosts == nullptr) return arrays;
    const auto mark = [](const mesh::Runs& runs, std::size_t begin, std::size_t end, char* out) {
        mesh::each_run(runs, begin, end, [&](std::size_t first, std::size_t last, Index ghost) {
            out = std::fill_n(out, last - first, static_cast<char>(ghost));
        });
        return out;
    };
    of_points(Place::point_data, "type=\"UInt8\" Name=\"vtkGhostType\"", 1,
              [=, of = ghosts->ghost_points](std::size_t begin, std::size_t end, char* out) {
                  return mark(of, begin, end, out);
              });
    of_cells(Place::cell_data, "type=\"UInt8\" Name=\"vtkGhostType\"", 1,
             [=, of = ghosts->ghost_cells](std::size_t b, std::size_t begin, std::size_t end, char* out) {
                 return mark(of[b], begin, end, out);
             });
    return arrays;
}

// ---- Legacy

/// Legacy files are big-endian.
template <class Value>
char* put_number(char* out, Value value, bool binary)
{
    if (binary) return put_big(out, value);
    out = put_text(out, value);
    *out++ = ' ';
    return out;
}

char* end_line(char* out, bool binary)
{
    if (!binary) *out++ = '\n';
    return out;
}

/// Percent-encode blanks and special characters of a name, as VTK does: %20.
std::string vtk_name(std::string_view name)
{
    std::string text;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte > 32 && byte < 127 && c != '%' && c != '"')
            text += c;
        else
            text += formatted("%{:02X}", byte);
    }
    return text;
}

/// Version, title and, if there are any, the named lists.
std::string vtk_head(const MeshView& view, bool binary, const std::string& unit)
{
    std::string head = "# vtk DataFile Version 3.0\nhexahedra";
    head.append(unit.empty() ? "" : ", lengths are in " + unit).append("\n");
    head.append(binary ? "BINARY" : "ASCII").append("\nDATASET UNSTRUCTURED_GRID\n");
    if (view.lists.empty()) return head;
    head.append("FIELD FieldData ").append(std::to_string(view.lists.size())).append("\n");
    for (const auto& [name, values] : view.lists) {
        head.append(vtk_name(name)).append(" 1 ").append(std::to_string(values.size())).append(" int\n");
        std::string numbers(values.size() * kNumberBytes, '\0');
        char* out = numbers.data();
        for (const int value : values) out = put_number(out, static_cast<std::int32_t>(value), binary);
        head.append(numbers, 0, static_cast<std::size_t>(out - numbers.data())).append("\n");
    }
    return head;
}

std::vector<Section> vtk_sections(const View& view, bool binary, const std::string& unit)
{
    const auto room = [binary](std::size_t numbers, std::size_t bytes) {
        return binary ? numbers * bytes : numbers * kNumberBytes + 1;
    };
    const auto put_line = [binary](char* out, auto value) {
        return end_line(put_number(out, value, binary), binary);
    };
    const std::string count = std::to_string(view->cells());
    std::vector<Section> all{
        {vtk_head(*view, binary, unit) + "POINTS " + std::to_string(view->points) + " double\n", view->points,
         room(3, 8), fill_points(view, [binary](char* out, const Vec3& point) {
             for (const double x : point) out = put_number(out, x, binary);
             return end_line(out, binary);
         })}};
    const auto add = [&](const std::string& before, std::vector<Section> sections) {
        sections.front().text = before;
        for (Section& section : sections) all.push_back(std::move(section));
    };
    const auto of_cells = [&](const std::string& before, std::size_t bytes, const FillBlock& fill,
                              std::size_t values = 1) {
        add(before, by_blocks(
                        *view, [=](const MeshView::Block&) { return values * room(1, bytes); }, fill));
    };
    const auto scalars = [](const std::string& name, const char* type) {
        return "SCALARS " + name + " " + type + " 1\nLOOKUP_TABLE default\n";
    };
    add("\nCELLS " + count + " " + std::to_string(view->cells() + list_size(*view)) + "\n",
        by_blocks(
            *view, [room](const MeshView::Block& block) { return room(size_of(block) + 1, 4); },
            [view, binary](std::size_t b, std::size_t begin, std::size_t end, char* out) {
                const MeshView::Block& block = view->blocks[b];
                block.each_cell(begin, end, [&](std::size_t, std::span<const Index> nodes) {
                    out = put_number(out, static_cast<std::int32_t>(nodes.size()), binary);
                    for (std::size_t k = 0; k < nodes.size(); ++k)
                        out = put_number(out, nodes[place_of_node(block.shape, k)], binary);
                    out = end_line(out, binary);
                });
                return out;
            }));
    of_cells("\nCELL_TYPES " + count + "\n", 4,
             [view, put_line](std::size_t b, std::size_t begin, std::size_t end, char* out) {
                 const std::int32_t type = words_of(view->blocks[b].shape).vtk;
                 for (; begin < end; ++begin) out = put_line(out, type);
                 return out;
             });
    of_cells("\nCELL_DATA " + count + "\n" + scalars("entity", "int"), 4,
             by_entity(view, entity_number, put_line));
    if (view->is_deck) of_cells("\n" + scalars("region", "int"), 4, by_entity(view, region_number, put_line));
    for (std::size_t f = 0; f < view->fields.size(); ++f)
        of_cells("\n" + (view->fields[f].components == 3 ? "VECTORS " + view->fields[f].name + " double\n"
                                                         : scalars(view->fields[f].name, "double")),
                 8, by_field(view, f, put_line), view->fields[f].components);
    if (view->is_deck) {
        of_cells("\n" + scalars("cell_number", "long"), 8, by_tag(view, put_line));
        all.push_back({"\nPOINT_DATA " + std::to_string(view->points) + "\n" + scalars("node_number", "long"),
                       view->points, room(1, 8), fill_numbers(view->point_tags, put_line)});
    }
    all.push_back({"\n", 0, 0, {}});
    return all;
}

/// A copy of the view in which pyramids lack the centre node of their base, because VTK has no such pyramid.
View vtk_view(const View& view, std::vector<std::string>& notes)
{
    auto own = std::make_shared<MeshView>(*view);
    std::size_t pyramids = 0;
    for (MeshView::Block& block : own->blocks) {
        if (block.shape == DeckShape::pyramid14) {
            pyramids += block.count;
            block.shape = DeckShape::pyramid13;
            block.nodes = [all = block.nodes](std::size_t begin, std::size_t end, Index* out) {
                std::array<Index, 14> nodes;
                for (; begin < end; ++begin) {
                    all(begin, begin + 1, nodes.data());
                    out = std::copy_n(nodes.begin(), 13, out);
                }
            };
        }
        if (words_of(block.shape).vtk == 0) refuse_element(block, "VTK", "there is no such cell");
    }
    if (pyramids == 0) return view;
    notes.push_back(formatted(
        "VTK has no pyramid of 14 nodes: {} are written without the centre of their base", pyramids));
    return own;
}

} // namespace

DeckFile vtu_file(const View& view, const MeshFileOptions& options, const mesh::ViewParts* /*parts*/)
{
    DeckFile file{.sections = {}, .notes = {}, .sizes = Sizes::exact};
    const View own = vtk_view(view, file.notes);
    file.sections = xml_sections(*own, arrays_of(own));
    std::string& head = file.sections.front().text;
    if (!options.unit.empty())
        head.insert(head.find('\n') + 1, "<!-- lengths are in " + options.unit + " -->\n");
    return file;
}

DeckFile vtk_file(const View& view, const MeshFileOptions& options, const mesh::ViewParts* /*parts*/)
{
    DeckFile file{.sections = {}, .notes = {}, .sizes = options.binary ? Sizes::exact : Sizes::varying};
    file.sections = vtk_sections(vtk_view(view, file.notes), options.binary, options.unit);
    return file;
}

void write_pieces(const View& view, const mesh::ViewParts& parts, int ghosts, const OutputPath& path,
                  const RunContext& context, const Team* team)
{
    const auto arrays = [ghosts](const PieceView& of) {
        return arrays_of(of.view, ghosts > 0 ? &of : nullptr);
    };
    std::vector<FileOfSet> files;
    std::vector<std::string> names;
    for (Index p = 0; p < parts.parts; ++p) {
        names.push_back(piece_name(path.text(), index(p)));
        files.push_back({path.beside(names.back()), [&, p] {
                             const PieceView own = piece_of(view, parts, p);
                             return xml_sections(*own.view, arrays(own));
                         }});
    }
    const std::string head = pvtu_head(arrays(piece_of(view, parts, 0)), ghosts);
    write_files(files, path, head + pvtu_end(names), context, team);
}

} // namespace lacuna::io
