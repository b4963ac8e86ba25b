// SPDX-License-Identifier: MIT
#include <lacuna/io/vtk.h>

#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/msh_content.h>
#include <lacuna/io/detail/node_reader.h>
#include <lacuna/io/detail/vtk_file.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <utility>

namespace lacuna::io {
namespace {

/// How the mesh that a file holds lies in the whole mesh.
struct Window {
    int first = 0;                ///< its first layer is this one of the whole
    int skin_first = 0, skin = 0; ///< of its layers, those whose skin the file has, and their number
    bool source = true, target = true;
};

/// Cells of the file by kind: hexahedra, wedges, quads of the skin, triangles of the skin.
struct Cells {
    /// Cells of one type in a row.
    struct Kind {
        std::size_t first = 0, count = 0, nodes = 0; ///< cells of the file before them, them, nodes of each
        int type = 0;                                ///< VTK's
    };
    const mesh::HexMesh& mesh;
    mesh::CellKinds kinds;
    Window window;
    std::size_t triangles = 0, quads = 0; ///< of the source
    std::array<Kind, 4> kind;

    explicit Cells(const mesh::HexMesh& cells) : Cells(cells, {0, 0, cells.layers}) {}
    Cells(const mesh::HexMesh& cells, const Window& own)
        : mesh(cells),
          kinds(cells),
          window(own),
          triangles(cells.triangle_count()),
          quads(cells.quads.size() - triangles)
    {
        const bool second = mesh.order() == 2, full = second && mesh.middles.full;
        kind[0] = {0, kinds.hexes(), cell_size(mesh), full ? 29 : second ? 25 : 12};
        kind[1] = {0, mesh.cell_count() - kinds.hexes(), 6, 13};
        kind[2] = {0, ends() * quads + rims(window.skin), skin_size(mesh), full ? 28 : second ? 23 : 9};
        kind[3] = {0, ends() * triangles, 3, 5};
        for (std::size_t k = 1; k < kind.size(); ++k) kind[k].first = kind[k - 1].first + kind[k - 1].count;
    }

    [[nodiscard]] std::size_t solids() const { return kind[2].first; }
    [[nodiscard]] std::size_t count() const { return kind[3].first + kind[3].count; }
    [[nodiscard]] const Kind& kind_of(std::size_t i) const
    {
        std::size_t k = 0;
        while (i >= kind[k].first + kind[k].count) ++k;
        return kind[k];
    }
    /// Nodes of all cells together.
    [[nodiscard]] std::size_t nodes() const { return nodes_to(count()); }
    /// Nodes of all cells before cell `end`.
    [[nodiscard]] std::size_t nodes_to(std::size_t end) const
    {
        std::size_t sum = 0;
        for (const Kind& own : kind) sum += std::min(end - std::min(end, own.first), own.count) * own.nodes;
        return sum;
    }
    /// The quad or triangle of the skin that cell `i` is. @pre i >= solids()
    [[nodiscard]] std::size_t skin(std::size_t i) const
    {
        const bool triangle = i >= kind[3].first;
        std::size_t at = i - kind[triangle ? 3 : 2].first;
        const std::size_t each_end = triangle ? triangles : quads;
        if (at >= ends() * each_end) // a quad of the walls
            at += (2 - ends()) * each_end + rims(window.skin_first);
        else if (!window.source)
            at += each_end;
        return kinds.skin(triangle ? kinds.skin_quads() + at : at);
    }
    /// Of cell `i`, in VTK's order, in which a wedge's triangle 0-1-2 looks away from 3-4-5.
    [[nodiscard]] mesh::CellNodes nodes_of(std::size_t i) const
    {
        if (i >= solids()) return skin_nodes(mesh, skin(i));
        mesh::CellNodes nodes = cell_nodes(mesh, kinds.cell(i));
        if (i >= kind[1].first) {
            std::swap(nodes.node[1], nodes.node[2]);
            std::swap(nodes.node[4], nodes.node[5]);
        }
        return nodes;
    }
    /// Tag of the patch cell `i` lies on; 0 inside.
    [[nodiscard]] int entity(std::size_t i) const
    {
        if (i < solids()) return 0;
        const Index patch = skin_quad(mesh, skin(i)).patch;
        return mesh.patches[static_cast<std::size_t>(patch)].tag;
    }
    /// A cell or a quad of the skin in the whole mesh.
    [[nodiscard]] std::size_t whole_cell(std::size_t cell) const
    {
        return cell + index(window.first) * mesh.quads.size();
    }
    [[nodiscard]] std::size_t whole_skin(std::size_t quad) const
    {
        return quad < 2 * mesh.quads.size() ? quad : quad + rims(window.first);
    }

    [[nodiscard]] std::size_t ends() const { return std::size_t(window.source) + std::size_t(window.target); }
    [[nodiscard]] std::size_t rims(int layers) const { return index(layers) * mesh.rim.size(); }
};

/// Fields of cells and skin of a whole mesh, what of the skin is looked up by the cell a quad belongs to.
struct Fields {
    const std::vector<FieldReader>& fields;
    std::vector<std::uint32_t> skin_cells;

    Fields(const mesh::HexMesh& mesh, const std::vector<FieldReader>& given) : fields(given)
    {
        if (!given.empty()) skin_cells = cells_of_skin(mesh);
    }
    /// Call `put_value(out, value)` for the cells [begin, end) of a file.
    template <class PutValue>
    char* put_values(const Cells& cells, const FieldReader& field, std::size_t begin, std::size_t end,
                     char* out, const PutValue& put_value) const
    {
        const auto put_one = [&](std::size_t, double value) { out = put_value(out, value); };
        const std::size_t solids = std::clamp(cells.solids(), begin, end);
        field.each_cell(
            begin, solids, [&](std::size_t i) { return cells.whole_cell(cells.kinds.cell(i)); }, put_one);
        field.each_behind_skin(
            solids, end, skin_cells, [&](std::size_t i) { return cells.whole_skin(cells.skin(i)); }, put_one);
        return out;
    }
};

/// The entities of each group.
VtkTable groups_of(const mesh::HexMesh& mesh)
{
    VtkTable table;
    const auto add = [&](const std::string& name, int entity) {
        auto found = std::ranges::find(table, name, &VtkTable::value_type::first);
        if (found == table.end()) found = table.insert(found, {name, {}});
        found->second.push_back(entity);
    };
    for (const mesh::SkinPatch& patch : mesh.patches)
        for (const std::string& name : patch.groups) add(name, patch.tag);
    for (const std::string& name : mesh.volume_groups) add(name, 0);
    return table;
}

// ---- XML

/// Nodes [first, second) of the whole mesh.
using Nodes = std::pair<std::size_t, std::size_t>;

std::size_t count_of(const std::vector<Nodes>& ranges)
{
    std::size_t count = 0;
    for (const Nodes& range : ranges) count += range.second - range.first;
    return count;
}

/// @param points  the nodes that are the file's points.
std::vector<VtuArray> vtu_arrays(const Cells& cells, const NodeReader& nodes,
                                 const std::vector<Nodes>& points, const Fields& fields)
{
    const std::size_t count = cells.count();
    const auto section = [](std::size_t records, std::size_t bytes, Fill fill) {
        return Section{{}, records, bytes, std::move(fill)};
    };
    std::vector<Section> connectivity;
    for (const Cells::Kind& kind : cells.kind) {
        const auto put_nodes = [&cells, first = kind.first](std::size_t i, char* out) {
            const mesh::CellNodes own = cells.nodes_of(first + i);
            std::memcpy(out, own.node.data(), own.count * sizeof(Index));
            return out + own.count * sizeof(Index);
        };
        connectivity.push_back(section(kind.count, kind.nodes * sizeof(Index), each(put_nodes)));
    }
    const auto put_offset = [&cells](std::size_t i, char* out) {
        return put(out, static_cast<std::int64_t>(cells.nodes_to(i + 1)));
    };
    const auto put_type = [&cells](std::size_t i, char* out) {
        return put(out, static_cast<std::uint8_t>(cells.kind_of(i).type));
    };
    const auto put_entity = [&cells](std::size_t i, char* out) {
        return put(out, static_cast<std::int32_t>(cells.entity(i)));
    };
    std::vector<Section> coordinates;
    for (const Nodes& range : points) {
        const auto put_points = [&nodes, from = range.first](std::size_t begin, std::size_t end, char* out) {
            return nodes.copy(from + begin, from + end, out);
        };
        coordinates.push_back(section(range.second - range.first, sizeof(Vec3), put_points));
    }
    using Place = VtuArray::Place;
    std::vector<VtuArray> arrays{
        {Place::points, "type=\"Float64\" NumberOfComponents=\"3\"", count_of(points) * sizeof(Vec3),
         std::move(coordinates)},
        {Place::cells, "type=\"Int32\" Name=\"connectivity\"", cells.nodes() * sizeof(Index),
         std::move(connectivity)},
        {Place::cells, "type=\"Int64\" Name=\"offsets\"", count * 8, {section(count, 8, each(put_offset))}},
        {Place::cells, "type=\"UInt8\" Name=\"types\"", count, {section(count, 1, each(put_type))}},
        {Place::cell_data,
         "type=\"Int32\" Name=\"entity\"",
         count * 4,
         {section(count, 4, each(put_entity))}}};
    for (const FieldReader& field : fields.fields) {
        const auto put_values = [&cells, &fields, &field](std::size_t begin, std::size_t end, char* out) {
            return fields.put_values(cells, field, begin, end, out,
                                     [](char* at, double value) { return put(at, value); });
        };
        arrays.push_back({Place::cell_data,
                          "type=\"Float64\" Name=\"" + field.name() + "\"",
                          count * sizeof(double),
                          {section(count, sizeof(double), put_values)}});
    }
    return arrays;
}

// ---- Pieces

/// A range of layers as a mesh, with the part's ghosts. Its nodes are not held.
mesh::HexMesh layers_of(const mesh::HexMesh& mesh, const LayerPart& part)
{
    mesh::HexMesh own;
    own.nodes_per_layer = mesh.nodes_per_layer;
    own.layers = part.with_last - part.with_first;
    own.quads = mesh.quads;
    own.rim = mesh.rim;
    own.patches = mesh.patches;
    own.source_patch = mesh.source_patch;
    own.target_patch = mesh.target_patch;
    const auto at = [&](int layer) {
        return mesh.wall_patch.begin() + static_cast<std::ptrdiff_t>(index(layer) * mesh.rim.size());
    };
    own.wall_patch.assign(at(part.with_first), at(part.with_last));
    own.volume_groups = mesh.volume_groups;
    own.middles.full = mesh.middles.full;
    own.middles.sides = mesh.middles.sides;
    own.middles.side_of = mesh.middles.side_of;
    own.middles.rim_side = mesh.middles.rim_side;
    return own;
}

/// A file of a part. What its sections refer to lives as long as they do.
struct Piece {
    const mesh::HexMesh& whole;
    LayerPart part;
    mesh::HexMesh mesh;
    Cells cells;
    std::vector<Nodes> points;

    Piece(const mesh::HexMesh& all, const LayerPart& own)
        : whole(all),
          part(own),
          mesh(layers_of(all, own)),
          cells(mesh, {own.with_first, own.first - own.with_first, own.last - own.first, own.first == 0,
                       own.last == all.layers})
    {
        const std::size_t row = index(whole.nodes_per_layer), first = index(part.with_first);
        points.emplace_back(first * row, (index(part.with_last) + 1) * row);
        if (whole.order() == 1) return;
        const mesh::MiddlePlaces places(whole);
        const std::size_t begin = mesh::corner_count(whole) + places.side(first, 0);
        points.emplace_back(begin, begin + mesh::MiddlePlaces(mesh).count());
    }

    /// Number of a cell in the file of the whole, from 1.
    [[nodiscard]] std::int64_t cell_number(std::size_t i, const Cells& all) const
    {
        std::size_t k = 0;
        while (i >= cells.kind[k].first + cells.kind[k].count) ++k;
        std::size_t at = i - cells.kind[k].first;
        const std::size_t each_end = k == 2 ? cells.quads : cells.triangles;
        if (k < 2)
            at += index(part.with_first) * (k == 0 ? cells.quads : cells.triangles);
        else if (const std::size_t ends = cells.ends() * each_end; at >= ends)
            at += 2 * each_end - ends + cells.rims(part.first);
        else if (!cells.window.source)
            at += each_end;
        return static_cast<std::int64_t>(all.kind[k].first + at) + 1;
    }
    /// Whether a cell is another part's.
    [[nodiscard]] bool is_ghost(std::size_t i) const
    {
        if (i >= cells.solids()) return false;
        const auto layer = static_cast<int>(cells.kinds.cell(i) / mesh.quads.size()) + part.with_first;
        return layer < part.first || layer >= part.last;
    }
    /// Of a point that stands in several pieces the one above its level owns it, of the highest the last.
    [[nodiscard]] bool is_ghost_point(std::size_t node) const
    {
        const std::size_t corners = mesh::corner_count(whole);
        std::size_t level = node / index(whole.nodes_per_layer);
        if (node >= corners) level = (node - corners) / mesh::MiddlePlaces(whole).side(1, 0);
        const int at = static_cast<int>(level);
        return at < part.first || (at >= part.last && (part.last < whole.layers || at > part.last));
    }
};

/// The arrays of a piece: those of the whole file, numbers in it and, where asked for, what are ghosts.
std::vector<VtuArray> piece_arrays(const std::shared_ptr<const Piece>& piece, const Cells& whole,
                                   const NodeReader& nodes, const Fields& fields, bool ghosts)
{
    using Place = VtuArray::Place;
    std::vector<VtuArray> arrays = vtu_arrays(piece->cells, nodes, piece->points, fields);
    const auto of_cells = [&](const char* attributes, std::size_t bytes, Fill fill) {
        const std::size_t count = piece->cells.count();
        arrays.push_back(
            {Place::cell_data, attributes, count * bytes, {Section{{}, count, bytes, std::move(fill)}}});
    };
    const auto of_points = [&](const char* attributes, std::size_t bytes, const auto& put_node) {
        std::vector<Section> sections;
        for (const Nodes& range : piece->points)
            sections.push_back({{},
                                range.second - range.first,
                                bytes,
                                each([put_node, from = range.first](std::size_t i, char* out) {
                                    return put_node(from + i, out);
                                })});
        arrays.push_back(
            {Place::point_data, attributes, count_of(piece->points) * bytes, std::move(sections)});
    };
    of_points("type=\"Int64\" Name=\"node_number\"", 8,
              [](std::size_t node, char* out) { return put(out, static_cast<std::int64_t>(node) + 1); });
    of_cells("type=\"Int64\" Name=\"cell_number\"", 8, each([piece, &whole](std::size_t i, char* out) {
                 return put(out, piece->cell_number(i, whole));
             }));
    if (!ghosts) return arrays;
    of_points("type=\"UInt8\" Name=\"vtkGhostType\"", 1, [piece](std::size_t node, char* out) {
        return put(out, static_cast<std::uint8_t>(piece->is_ghost_point(node)));
    });
    of_cells("type=\"UInt8\" Name=\"vtkGhostType\"", 1, each([piece](std::size_t i, char* out) {
                 return put(out, static_cast<std::uint8_t>(piece->is_ghost(i)));
             }));
    return arrays;
}

void write_pieces(const mesh::HexMesh& mesh, const NodeReader& nodes, const std::vector<FieldReader>& readers,
                  const OutputPath& path, const PartitionOptions& options, const RunContext& context,
                  const Team* team = nullptr)
{
    const Fields fields(mesh, readers);
    const Cells whole(mesh);
    const bool ghosts = options.ghosts > 0;
    std::vector<FileOfSet> files;
    std::vector<std::string> names;
    std::string head;
    for (const LayerPart& part : layer_parts(mesh.layers, options)) {
        names.push_back(piece_name(path.text(), names.size()));
        files.push_back({path.beside(names.back()), [&, part] {
                             const auto piece = std::make_shared<const Piece>(mesh, part);
                             return vtu_file(count_of(piece->points), piece->cells.count(),
                                             piece_arrays(piece, whole, nodes, fields, ghosts),
                                             groups_of(mesh));
                         }});
        if (head.empty())
            head = pvtu_head(
                piece_arrays(std::make_shared<const Piece>(mesh, part), whole, nodes, fields, ghosts),
                options.ghosts);
    }
    write_files(files, path, head + pvtu_end(names), context, team);
}

// ---- Legacy

std::vector<Section> vtk_sections(const Cells& cells, const NodeReader& nodes, const Fields& fields,
                                  bool binary)
{
    const mesh::HexMesh& mesh = cells.mesh;
    const std::size_t count = cells.count();
    const std::string number = std::to_string(count);
    const auto bytes = [binary](std::size_t numbers, std::size_t each_bytes) {
        return binary ? numbers * each_bytes : numbers * kNumberBytes + 1;
    };
    const auto put_points = [&nodes, binary](std::size_t begin, std::size_t end, char* out) {
        nodes.each(begin, end, [&](std::size_t, const Vec3& node) {
            for (const double value : node) out = put_number(out, value, binary);
            out = end_line(out, binary);
        });
        return out;
    };
    const auto put_type = [&cells, binary](std::size_t i, char* out) {
        return end_line(put_number(out, static_cast<std::int32_t>(cells.kind_of(i).type), binary), binary);
    };
    const auto put_entity = [&cells, binary](std::size_t i, char* out) {
        return end_line(put_number(out, static_cast<std::int32_t>(cells.entity(i)), binary), binary);
    };
    std::string head = vtk_head(groups_of(mesh), binary);
    head.append("POINTS ").append(std::to_string(nodes.count())).append(" double\n");
    std::vector<Section> sections{{head, nodes.count(), bytes(3, 8), put_points}};
    std::string text = "\nCELLS " + number + " " + std::to_string(cells.nodes() + count) + "\n";
    for (const Cells::Kind& kind : cells.kind) {
        const auto put_cell = [&cells, first = kind.first, binary](std::size_t i, char* out) {
            const mesh::CellNodes own = cells.nodes_of(first + i);
            out = put_number(out, static_cast<std::int32_t>(own.count), binary);
            for (const Index node : own.all()) out = put_number(out, node, binary);
            return end_line(out, binary);
        };
        sections.push_back({text, kind.count, bytes(kind.nodes + 1, 4), each(put_cell)});
        text.clear();
    }
    sections.push_back({"\nCELL_TYPES " + number + "\n", count, bytes(1, 4), each(put_type)});
    sections.push_back({"\nCELL_DATA " + number + "\nSCALARS entity int 1\nLOOKUP_TABLE default\n", count,
                        bytes(1, 4), each(put_entity)});
    for (const FieldReader& field : fields.fields) {
        const auto put_values = [&cells, &fields, &field, binary](std::size_t begin, std::size_t end,
                                                                  char* out) {
            return fields.put_values(cells, field, begin, end, out, [binary](char* at, double value) {
                return end_line(put_number(at, value, binary), binary);
            });
        };
        sections.push_back({"\nSCALARS " + field.name() + " double 1\nLOOKUP_TABLE default\n", count,
                            bytes(1, 8), put_values});
    }
    sections.push_back({"\n", 0, 0, {}});
    return sections;
}

void write_xml(const mesh::HexMesh& mesh, const NodeReader& nodes, const std::vector<FieldReader>& readers,
               const OutputPath& path, const RunContext& context, const Team* team = nullptr)
{
    const Fields fields(mesh, readers);
    const Cells cells(mesh);
    const std::vector<Section> sections = vtu_file(nodes.count(), cells.count(),
                                                   vtu_arrays(cells, nodes, {{0, nodes.count()}}, fields),
                                                   groups_of(mesh));
    write_file(path, sections, Sizes::exact, context, team);
}

void write_legacy(const mesh::HexMesh& mesh, const NodeReader& nodes, const std::vector<FieldReader>& readers,
                  const OutputPath& path, bool binary, const RunContext& context, const Team* team = nullptr)
{
    const Fields fields(mesh, readers);
    const Cells cells(mesh);
    write_file(path, vtk_sections(cells, nodes, fields, binary), binary ? Sizes::exact : Sizes::varying,
               context, team);
}

} // namespace

void write_vtu(const mesh::HexMesh& mesh, const OutputPath& path, const VtuOptions& options,
               const RunContext& context)
{
    check_skin(mesh);
    write_xml(mesh, NodeReader(mesh), readers_of(mesh, options.fields), path, context);
}

void write_vtu(const mesh::LayeredMesh& layered, const OutputPath& path,
               const std::vector<LayeredField>& fields, const RunContext& context, const Team* team)
{
    check_skin(layered.mesh);
    const NodeReader nodes(layered, context);
    write_xml(layered.mesh, nodes, readers_of(layered, fields, context, team), path, context, team);
}

void write_vtk(const mesh::HexMesh& mesh, const OutputPath& path, const VtkOptions& options,
               const RunContext& context)
{
    check_skin(mesh);
    write_legacy(mesh, NodeReader(mesh), readers_of(mesh, options.fields), path, options.binary, context);
}

void write_vtk(const mesh::LayeredMesh& layered, const OutputPath& path, const VtkOptions& options,
               const std::vector<LayeredField>& fields, const RunContext& context, const Team* team)
{
    check_skin(layered.mesh);
    const NodeReader nodes(layered, context);
    write_legacy(layered.mesh, nodes, readers_of(layered, fields, context, team), path, options.binary,
                 context, team);
}

void write_pvtu(const mesh::HexMesh& mesh, const OutputPath& path, const PartitionOptions& partition,
                const VtuOptions& options, const RunContext& context)
{
    check_skin(mesh);
    write_pieces(mesh, NodeReader(mesh), readers_of(mesh, options.fields), path, partition, context);
}

void write_pvtu(const mesh::LayeredMesh& layered, const OutputPath& path, const PartitionOptions& partition,
                const std::vector<LayeredField>& fields, const RunContext& context, const Team* team)
{
    check_skin(layered.mesh);
    const NodeReader nodes(layered, context);
    write_pieces(layered.mesh, nodes, readers_of(layered, fields, context, team), path, partition, context,
                 team);
}

} // namespace lacuna::io
