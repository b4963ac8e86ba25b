// SPDX-License-Identifier: MIT
#include <lacuna/io/vtk.h>

#include <lacuna/io/detail/msh_content.h>
#include <lacuna/io/detail/vtk_file.h>

#include <algorithm>
#include <cstring>

namespace lacuna::io {
namespace {

constexpr int kVtkQuad = 9;
constexpr int kVtkHex = 12;

/// Fields of hexahedra and skin, what of the skin is looked up by the cell a quad belongs to.
struct Fields {
    const std::vector<CellField>& fields;
    std::vector<std::uint32_t> skin_cells;

    Fields(const mesh::HexMesh& mesh, const std::vector<CellField>& given) : fields(given)
    {
        check_fields(mesh, given);
        if (!given.empty()) skin_cells = cells_of_skin(mesh);
    }
    /// Of cell `i` of the file: hexahedra first, then the skin.
    [[nodiscard]] double value(const CellField& field, std::size_t i) const
    {
        const std::size_t hexes = field.values.size();
        return field.values[i < hexes ? i : skin_cells[i - hexes]];
    }
};

int entity(const mesh::HexMesh& mesh, std::size_t skin)
{
    return mesh.patches[static_cast<std::size_t>(skin_quad(mesh, skin).patch)].tag;
}

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
    const std::size_t hexes = mesh.hex_count();
    const std::size_t skin = mesh.skin_count();
    const auto section = [](std::size_t count, std::size_t bytes, Fill fill) {
        return Section{{}, count, bytes, std::move(fill)};
    };
    const auto put_hex = [&mesh](std::size_t i, char* out) { return put(out, mesh.hex(i)); };
    const auto put_quad = [&mesh](std::size_t i, char* out) { return put(out, skin_quad(mesh, i).nodes); };
    const auto put_offset = [hexes](std::size_t i, char* out) {
        return put(out, static_cast<std::int64_t>(i < hexes ? 8 * (i + 1) : 8 * hexes + 4 * (i + 1 - hexes)));
    };
    const auto put_type = [hexes](std::size_t i, char* out) {
        return put(out, static_cast<std::uint8_t>(i < hexes ? kVtkHex : kVtkQuad));
    };
    const auto put_entity = [&mesh, hexes](std::size_t i, char* out) {
        return put(out, static_cast<std::int32_t>(i < hexes ? 0 : entity(mesh, i - hexes)));
    };
    const auto put_point = [&mesh](std::size_t i, char* out) {
        std::memcpy(out, mesh.nodes[i].data(), sizeof(Vec3));
        return out + sizeof(Vec3);
    };
    using enum VtuArray::Place;
    std::vector<VtuArray> arrays{
        {points,
         "type=\"Float64\" NumberOfComponents=\"3\"",
         mesh.nodes.size() * sizeof(Vec3),
         {section(mesh.nodes.size(), sizeof(Vec3), each(put_point))}},
        {cells,
         "type=\"Int32\" Name=\"connectivity\"",
         hexes * sizeof(Hex) + skin * sizeof(Quad),
         {section(hexes, sizeof(Hex), each(put_hex)), section(skin, sizeof(Quad), each(put_quad))}},
        {cells,
         "type=\"Int64\" Name=\"offsets\"",
         (hexes + skin) * 8,
         {section(hexes + skin, 8, each(put_offset))}},
        {cells, "type=\"UInt8\" Name=\"types\"", hexes + skin, {section(hexes + skin, 1, each(put_type))}},
        {cell_data,
         "type=\"Int32\" Name=\"entity\"",
         (hexes + skin) * 4,
         {section(hexes + skin, 4, each(put_entity))}}};
    for (const CellField& field : fields.fields) {
        const auto put_value = [&fields, &field](std::size_t i, char* out) {
            return put(out, fields.value(field, i));
        };
        arrays.push_back({cell_data,
                          "type=\"Float64\" Name=\"" + field.name + "\"",
                          (hexes + skin) * sizeof(double),
                          {section(hexes + skin, sizeof(double), each(put_value))}});
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
    const std::size_t hexes = mesh.hex_count();
    const std::size_t skin = mesh.skin_count();
    const std::string cells = std::to_string(hexes + skin);
    const auto bytes = [binary](std::size_t numbers, std::size_t each_bytes) {
        return binary ? numbers * each_bytes : numbers * kNumberBytes + 1;
    };
    const auto put_point = [&mesh, binary](std::size_t i, char* out) {
        for (const double value : mesh.nodes[i]) out = put_number(out, value, binary);
        return end_line(out, binary);
    };
    const auto put_type = [hexes, binary](std::size_t i, char* out) {
        return end_line(put_number(out, static_cast<std::int32_t>(i < hexes ? kVtkHex : kVtkQuad), binary),
                        binary);
    };
    const auto put_entity = [&mesh, hexes, binary](std::size_t i, char* out) {
        const int tag = i < hexes ? 0 : entity(mesh, i - hexes);
        return end_line(put_number(out, static_cast<std::int32_t>(tag), binary), binary);
    };
    std::string head = vtk_head(groups_of(mesh), binary);
    head.append("POINTS ").append(std::to_string(mesh.nodes.size())).append(" double\n");
    const std::string sizes = std::string(1, ' ').append(std::to_string(9 * hexes + 5 * skin)).append("\n");
    std::vector<Section> sections{
        {head, mesh.nodes.size(), bytes(3, 8), each(put_point)},
        {"\nCELLS " + cells + sizes, hexes, bytes(9, 4),
         each([&mesh, binary](std::size_t i, char* out) { return put_cell(out, mesh.hex(i), binary); })},
        {{}, skin, bytes(5, 4), each([&mesh, binary](std::size_t i, char* out) {
             return put_cell(out, skin_quad(mesh, i).nodes, binary);
         })},
        {"\nCELL_TYPES " + cells + "\n", hexes + skin, bytes(1, 4), each(put_type)},
        {"\nCELL_DATA " + cells + "\nSCALARS entity int 1\nLOOKUP_TABLE default\n", hexes + skin, bytes(1, 4),
         each(put_entity)}};
    for (const CellField& field : fields.fields) {
        const auto put_value = [&fields, &field, binary](std::size_t i, char* out) {
            return end_line(put_number(out, fields.value(field, i), binary), binary);
        };
        sections.push_back({"\nSCALARS " + field.name + " double 1\nLOOKUP_TABLE default\n", hexes + skin,
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
    const std::vector<Section> sections = vtu_file(mesh.nodes.size(), mesh.hex_count() + mesh.skin_count(),
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
