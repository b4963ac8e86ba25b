// SPDX-License-Identifier: MIT
#include <lacuna/io/vtk.h>

#include <lacuna/io/detail/msh_content.h>
#include <lacuna/io/detail/vtk_file.h>

#include <algorithm>
#include <cstring>

namespace lacuna::io {
namespace {

constexpr int kVtkTriangle = 5;
constexpr int kVtkQuad = 9;
constexpr int kVtkHex = 12;
constexpr int kVtkWedge = 13;

/// Cells of the file: hexahedra, wedges, quads of the skin, triangles of the skin.
struct Cells {
    const mesh::HexMesh& mesh;
    mesh::CellKinds kinds{mesh};
    std::size_t hexes = kinds.hexes();
    std::size_t wedges = mesh.cell_count() - hexes;
    std::size_t quads = kinds.skin_quads();
    std::size_t triangles = mesh.skin_count() - quads;

    [[nodiscard]] std::size_t count() const { return hexes + wedges + quads + triangles; }
    [[nodiscard]] std::size_t corners() const { return 8 * hexes + 6 * wedges + 4 * quads + 3 * triangles; }
    [[nodiscard]] int type(std::size_t i) const
    {
        if (i < hexes) return kVtkHex;
        if (i < hexes + wedges) return kVtkWedge;
        return i < hexes + wedges + quads ? kVtkQuad : kVtkTriangle;
    }
    /// Corners of all cells up to and with cell `i`.
    [[nodiscard]] std::size_t corners_to(std::size_t i) const
    {
        std::size_t left = i + 1, sum = 0;
        for (const auto& [of_kind, corners] :
             {std::pair(hexes, 8), std::pair(wedges, 6), std::pair(quads, 4), std::pair(triangles, 3)}) {
            const std::size_t here = std::min(left, of_kind);
            sum += here * static_cast<std::size_t>(corners);
            left -= here;
        }
        return sum;
    }
    [[nodiscard]] Hex hex(std::size_t i) const { return mesh.hex(kinds.cell(i)); }
    /// In VTK's order, in which the triangle 0-1-2 looks away from 3-4-5.
    [[nodiscard]] mesh::Wedge wedge(std::size_t i) const
    {
        const mesh::Wedge w = mesh::wedge_of(mesh.hex(kinds.cell(hexes + i)));
        return {w[0], w[2], w[1], w[3], w[5], w[4]};
    }
    [[nodiscard]] Quad quad(std::size_t i) const { return skin_quad(mesh, kinds.skin(i)).nodes; }
    [[nodiscard]] Triangle triangle(std::size_t i) const
    {
        const Quad nodes = skin_quad(mesh, kinds.skin(quads + i)).nodes;
        return {nodes[0], nodes[1], nodes[2]};
    }
    /// Tag of the patch cell `i` lies on; 0 inside.
    [[nodiscard]] int entity(std::size_t i) const
    {
        if (i < hexes + wedges) return 0;
        const Index patch = skin_quad(mesh, kinds.skin(i - hexes - wedges)).patch;
        return mesh.patches[static_cast<std::size_t>(patch)].tag;
    }
};

/// Fields of cells and skin, what of the skin is looked up by the cell a quad belongs to.
struct Fields {
    const std::vector<CellField>& fields;
    std::vector<std::uint32_t> skin_cells;
    mesh::CellKinds kinds;

    Fields(const mesh::HexMesh& mesh, const std::vector<CellField>& given) : fields(given), kinds(mesh)
    {
        check_fields(mesh, given);
        if (!given.empty()) skin_cells = cells_of_skin(mesh);
    }
    /// Of cell `i` of the file.
    [[nodiscard]] double value(const CellField& field, std::size_t i) const
    {
        const std::size_t cells = field.values.size();
        return field.values[i < cells ? kinds.cell(i) : skin_cells[kinds.skin(i - cells)]];
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

std::vector<VtuArray> vtu_arrays(const mesh::HexMesh& mesh, const Fields& fields)
{
    const Cells cells{mesh};
    const std::size_t count = cells.count();
    const auto section = [](std::size_t records, std::size_t bytes, Fill fill) {
        return Section{{}, records, bytes, std::move(fill)};
    };
    const auto put_hex = [cells](std::size_t i, char* out) { return put(out, cells.hex(i)); };
    const auto put_wedge = [cells](std::size_t i, char* out) { return put(out, cells.wedge(i)); };
    const auto put_quad = [cells](std::size_t i, char* out) { return put(out, cells.quad(i)); };
    const auto put_triangle = [cells](std::size_t i, char* out) { return put(out, cells.triangle(i)); };
    const auto put_offset = [cells](std::size_t i, char* out) {
        return put(out, static_cast<std::int64_t>(cells.corners_to(i)));
    };
    const auto put_type = [cells](std::size_t i, char* out) {
        return put(out, static_cast<std::uint8_t>(cells.type(i)));
    };
    const auto put_entity = [cells](std::size_t i, char* out) {
        return put(out, static_cast<std::int32_t>(cells.entity(i)));
    };
    const auto put_point = [&mesh](std::size_t i, char* out) {
        std::memcpy(out, mesh.nodes[i].data(), sizeof(Vec3));
        return out + sizeof(Vec3);
    };
    using Place = VtuArray::Place;
    std::vector<VtuArray> arrays{
        {Place::points,
         "type=\"Float64\" NumberOfComponents=\"3\"",
         mesh.nodes.size() * sizeof(Vec3),
         {section(mesh.nodes.size(), sizeof(Vec3), each(put_point))}},
        {Place::cells,
         "type=\"Int32\" Name=\"connectivity\"",
         cells.corners() * sizeof(Index),
         {section(cells.hexes, sizeof(Hex), each(put_hex)),
          section(cells.wedges, sizeof(mesh::Wedge), each(put_wedge)),
          section(cells.quads, sizeof(Quad), each(put_quad)),
          section(cells.triangles, sizeof(Triangle), each(put_triangle))}},
        {Place::cells, "type=\"Int64\" Name=\"offsets\"", count * 8, {section(count, 8, each(put_offset))}},
        {Place::cells, "type=\"UInt8\" Name=\"types\"", count, {section(count, 1, each(put_type))}},
        {Place::cell_data,
         "type=\"Int32\" Name=\"entity\"",
         count * 4,
         {section(count, 4, each(put_entity))}}};
    for (const CellField& field : fields.fields) {
        const auto put_value = [&fields, &field](std::size_t i, char* out) {
            return put(out, fields.value(field, i));
        };
        arrays.push_back({Place::cell_data,
                          "type=\"Float64\" Name=\"" + field.name + "\"",
                          count * sizeof(double),
                          {section(count, sizeof(double), each(put_value))}});
    }
    return arrays;
}

// ---- Legacy

template <std::size_t N>
char* put_cell(char* out, const std::array<Index, N>& nodes, bool binary)
{
    out = put_number(out, static_cast<std::int32_t>(N), binary);
    for (const Index node : nodes) out = put_number(out, node, binary);
    return end_line(out, binary);
}

std::vector<Section> vtk_sections(const mesh::HexMesh& mesh, const Fields& fields, bool binary)
{
    const Cells cells{mesh};
    const std::size_t count = cells.count();
    const std::string number = std::to_string(count);
    const auto bytes = [binary](std::size_t numbers, std::size_t each_bytes) {
        return binary ? numbers * each_bytes : numbers * kNumberBytes + 1;
    };
    const auto put_point = [&mesh, binary](std::size_t i, char* out) {
        for (const double value : mesh.nodes[i]) out = put_number(out, value, binary);
        return end_line(out, binary);
    };
    const auto put_type = [cells, binary](std::size_t i, char* out) {
        return end_line(put_number(out, static_cast<std::int32_t>(cells.type(i)), binary), binary);
    };
    const auto put_entity = [cells, binary](std::size_t i, char* out) {
        return end_line(put_number(out, static_cast<std::int32_t>(cells.entity(i)), binary), binary);
    };
    const auto kind = [&](std::size_t own, std::size_t corners, const auto& nodes) {
        return Section{{}, own, bytes(corners + 1, 4), each([nodes, binary](std::size_t i, char* out) {
                           return put_cell(out, nodes(i), binary);
                       })};
    };
    std::string head = vtk_head(groups_of(mesh), binary);
    head.append("POINTS ").append(std::to_string(mesh.nodes.size())).append(" double\n");
    const std::string sizes =
        std::string(1, ' ').append(std::to_string(cells.corners() + count)).append("\n");
    std::vector<Section> sections{
        {head, mesh.nodes.size(), bytes(3, 8), each(put_point)},
        kind(cells.hexes, 8, [cells](std::size_t i) { return cells.hex(i); }),
        kind(cells.wedges, 6, [cells](std::size_t i) { return cells.wedge(i); }),
        kind(cells.quads, 4, [cells](std::size_t i) { return cells.quad(i); }),
        kind(cells.triangles, 3, [cells](std::size_t i) { return cells.triangle(i); }),
        {"\nCELL_TYPES " + number + "\n", count, bytes(1, 4), each(put_type)},
        {"\nCELL_DATA " + number + "\nSCALARS entity int 1\nLOOKUP_TABLE default\n", count, bytes(1, 4),
         each(put_entity)}};
    sections[1].text = "\nCELLS " + number + sizes;
    for (const CellField& field : fields.fields) {
        const auto put_value = [&fields, &field, binary](std::size_t i, char* out) {
            return end_line(put_number(out, fields.value(field, i), binary), binary);
        };
        sections.push_back({"\nSCALARS " + field.name + " double 1\nLOOKUP_TABLE default\n", count,
                            bytes(1, 8), each(put_value)});
    }
    sections.push_back({"\n", 0, 0, {}});
    return sections;
}

} // namespace

void write_vtu(const mesh::HexMesh& mesh, const OutputPath& path, const VtuOptions& options,
               const RunContext& context)
{
    check_skin(mesh);
    const Fields fields(mesh, options.fields);
    const std::vector<Section> sections = vtu_file(mesh.nodes.size(), mesh.cell_count() + mesh.skin_count(),
                                                   vtu_arrays(mesh, fields), groups_of(mesh));
    WholeFile file(path);
    write_sections(file, sections, Sizes::exact, context);
    file.commit();
}

void write_vtk(const mesh::HexMesh& mesh, const OutputPath& path, const VtkOptions& options,
               const RunContext& context)
{
    check_skin(mesh);
    const Fields fields(mesh, options.fields);
    WholeFile file(path);
    write_sections(file, vtk_sections(mesh, fields, options.binary),
                   options.binary ? Sizes::exact : Sizes::varying, context);
    file.commit();
}

} // namespace lacuna::io
