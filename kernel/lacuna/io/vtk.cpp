// SPDX-License-Identifier: MIT
#include <lacuna/io/vtk.h>

#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/msh_content.h>
#include <lacuna/io/detail/node_reader.h>
#include <lacuna/io/detail/vtk_file.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace lacuna::io {
namespace {

/// Cells of the file by kind: hexahedra, wedges, quads of the skin, triangles of the skin.
struct Cells {
    /// Cells of one type in a row.
    struct Kind {
        std::size_t first = 0, count = 0, nodes = 0; ///< cells of the file before them, them, nodes of each
        int type = 0;                                ///< VTK's
    };
    const mesh::HexMesh& mesh;
    mesh::CellKinds kinds;
    std::array<Kind, 4> kind;

    explicit Cells(const mesh::HexMesh& cells) : mesh(cells), kinds(cells)
    {
        const bool second = mesh.order() == 2, full = second && mesh.middles.full;
        kind[0] = {0, kinds.hexes(), cell_size(mesh), full ? 29 : second ? 25 : 12};
        kind[1] = {0, mesh.cell_count() - kinds.hexes(), 6, 13};
        kind[2] = {0, kinds.skin_quads(), skin_size(mesh), full ? 28 : second ? 23 : 9};
        kind[3] = {0, mesh.skin_count() - kinds.skin_quads(), 3, 5};
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
    /// Of cell `i`, in VTK's order, in which a wedge's triangle 0-1-2 looks away from 3-4-5.
    [[nodiscard]] mesh::CellNodes nodes_of(std::size_t i) const
    {
        if (i >= solids()) return skin_nodes(mesh, kinds.skin(i - solids()));
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
        const Index patch = skin_quad(mesh, kinds.skin(i - solids())).patch;
        return mesh.patches[static_cast<std::size_t>(patch)].tag;
    }
};

/// Fields of cells and skin, what of the skin is looked up by the cell a quad belongs to.
struct Fields {
    const std::vector<FieldReader>& fields;
    std::vector<std::uint32_t> skin_cells;
    mesh::CellKinds kinds;
    std::size_t cells;

    Fields(const mesh::HexMesh& mesh, const std::vector<FieldReader>& given)
        : fields(given), kinds(mesh), cells(mesh.cell_count())
    {
        if (!given.empty()) skin_cells = cells_of_skin(mesh);
    }
    /// Call `put_value(out, value)` for the cells [begin, end) of the file.
    template <class PutValue>
    char* put_values(const FieldReader& field, std::size_t begin, std::size_t end, char* out,
                     const PutValue& put_value) const
    {
        FieldReader::Cursor at(field);
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t quad = i < cells ? 0 : kinds.skin(i - cells);
            out = put_value(out,
                            i < cells ? at.cell(kinds.cell(i)) : field.behind_skin(quad, skin_cells[quad]));
        }
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

std::vector<VtuArray> vtu_arrays(const Cells& cells, const NodeReader& nodes, const Fields& fields)
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
    const auto put_points = [&nodes](std::size_t begin, std::size_t end, char* out) {
        return nodes.copy(begin, end, out);
    };
    using Place = VtuArray::Place;
    std::vector<VtuArray> arrays{
        {Place::points,
         "type=\"Float64\" NumberOfComponents=\"3\"",
         nodes.count() * sizeof(Vec3),
         {section(nodes.count(), sizeof(Vec3), put_points)}},
        {Place::cells, "type=\"Int32\" Name=\"connectivity\"", cells.nodes() * sizeof(Index),
         std::move(connectivity)},
        {Place::cells, "type=\"Int64\" Name=\"offsets\"", count * 8, {section(count, 8, each(put_offset))}},
        {Place::cells, "type=\"UInt8\" Name=\"types\"", count, {section(count, 1, each(put_type))}},
        {Place::cell_data,
         "type=\"Int32\" Name=\"entity\"",
         count * 4,
         {section(count, 4, each(put_entity))}}};
    for (const FieldReader& field : fields.fields) {
        const auto put_values = [&fields, &field](std::size_t begin, std::size_t end, char* out) {
            return fields.put_values(field, begin, end, out,
                                     [](char* at, double value) { return put(at, value); });
        };
        arrays.push_back({Place::cell_data,
                          "type=\"Float64\" Name=\"" + field.name() + "\"",
                          count * sizeof(double),
                          {section(count, sizeof(double), put_values)}});
    }
    return arrays;
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
        const auto put_values = [&fields, &field, binary](std::size_t begin, std::size_t end, char* out) {
            return fields.put_values(field, begin, end, out, [binary](char* at, double value) {
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
                                                   vtu_arrays(cells, nodes, fields), groups_of(mesh));
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

} // namespace lacuna::io
