// SPDX-License-Identifier: MIT
#include <lacuna/io/vtk.h>

#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/msh_content.h>
#include <lacuna/io/detail/sections.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace lacuna::io {
namespace {

/// VTK's types: of order 1, of order 2 without and with middles of faces.
int quad_type(const mesh::HexMesh& mesh) { return mesh.order() == 1 ? 9 : mesh.middles.full ? 28 : 23; }
int hex_type(const mesh::HexMesh& mesh) { return mesh.order() == 1 ? 12 : mesh.middles.full ? 29 : 25; }

using Fill = std::function<char*(std::size_t, std::size_t, char*)>;

/// One record after the other by `put_one(i, out)`.
template <class PutOne>
Fill each(PutOne put_one)
{
    return [put_one](std::size_t begin, std::size_t end, char* out) {
        for (std::size_t i = begin; i < end; ++i) out = put_one(i, out);
        return out;
    };
}

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

// ---- XML

struct Array {
    std::string attributes;
    std::size_t bytes;
    std::vector<Section> sections;
};

/// Numbers in the order of this machine's bytes, which the head names.
std::vector<Array> vtu_arrays(const mesh::HexMesh& mesh, const Fields& fields)
{
    const std::size_t hexes = mesh.hex_count();
    const std::size_t skin = mesh.skin_count();
    const auto section = [](std::size_t count, std::size_t bytes, Fill fill) {
        return Section{{}, count, bytes, std::move(fill)};
    };
    const std::size_t of_hex = cell_size(mesh), of_quad = skin_size(mesh);
    const auto put_nodes = [](char* out, const mesh::CellNodes& nodes) {
        std::memcpy(out, nodes.node.data(), nodes.count * sizeof(Index));
        return out + nodes.count * sizeof(Index);
    };
    const auto put_hex = [&mesh, put_nodes](std::size_t i, char* out) {
        return put_nodes(out, cell_nodes(mesh, i));
    };
    const auto put_quad = [&mesh, put_nodes](std::size_t i, char* out) {
        return put_nodes(out, skin_nodes(mesh, i));
    };
    const auto put_offset = [=](std::size_t i, char* out) {
        return put(out, static_cast<std::int64_t>(i < hexes ? of_hex * (i + 1)
                                                            : of_hex * hexes + of_quad * (i + 1 - hexes)));
    };
    const int hex_type_number = hex_type(mesh), quad_type_number = quad_type(mesh);
    const auto put_type = [=](std::size_t i, char* out) {
        return put(out, static_cast<std::uint8_t>(i < hexes ? hex_type_number : quad_type_number));
    };
    const auto put_entity = [&mesh, hexes](std::size_t i, char* out) {
        return put(out, static_cast<std::int32_t>(i < hexes ? 0 : entity(mesh, i - hexes)));
    };
    const auto put_point = [&mesh](std::size_t i, char* out) {
        std::memcpy(out, mesh.node(i).data(), sizeof(Vec3));
        return out + sizeof(Vec3);
    };
    std::vector<Array> arrays{
        {"type=\"Float64\" NumberOfComponents=\"3\"",
         mesh.node_count() * sizeof(Vec3),
         {section(mesh.node_count(), sizeof(Vec3), each(put_point))}},
        {"type=\"Int32\" Name=\"connectivity\"",
         (hexes * of_hex + skin * of_quad) * sizeof(Index),
         {section(hexes, of_hex * sizeof(Index), each(put_hex)),
          section(skin, of_quad * sizeof(Index), each(put_quad))}},
        {"type=\"Int64\" Name=\"offsets\"", (hexes + skin) * 8, {section(hexes + skin, 8, each(put_offset))}},
        {"type=\"UInt8\" Name=\"types\"", hexes + skin, {section(hexes + skin, 1, each(put_type))}},
        {"type=\"Int32\" Name=\"entity\"", (hexes + skin) * 4, {section(hexes + skin, 4, each(put_entity))}}};
    for (const CellField& field : fields.fields) {
        const auto put_value = [&fields, &field](std::size_t i, char* out) {
            return put(out, fields.value(field, i));
        };
        arrays.push_back({"type=\"Float64\" Name=\"" + field.name + "\"",
                          (hexes + skin) * sizeof(double),
                          {section(hexes + skin, sizeof(double), each(put_value))}});
    }
    return arrays;
}

std::string vtu_head(const mesh::HexMesh& mesh, const std::vector<Array>& arrays)
{
    const char* order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"";
    text.append(order).append("\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"");
    text.append(std::to_string(mesh.node_count())).append("\" NumberOfCells=\"");
    text.append(std::to_string(mesh.hex_count() + mesh.skin_count())).append("\">\n");
    std::size_t offset = 0;
    const auto array = [&](std::size_t i) {
        text.append("<DataArray ").append(arrays[i].attributes).append(" format=\"appended\" offset=\"");
        text.append(std::to_string(offset)).append("\"/>\n");
        offset += sizeof(std::uint64_t) + arrays[i].bytes;
    };
    text += "<Points>\n";
    array(0);
    text += "</Points>\n<Cells>\n";
    for (const std::size_t i : {1, 2, 3}) array(i);
    text += "</Cells>\n<CellData Scalars=\"entity\">\n";
    for (std::size_t i = 4; i < arrays.size(); ++i) array(i);
    return text + "</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
}

// ---- Legacy

/// Legacy files hold the highest byte first.
template <class Value>
char* put_big(char* out, Value value)
{
    char* end = put(out, value);
    if (std::endian::native == std::endian::little) std::reverse(out, end);
    return end;
}

char* put_number(char* out, double value, bool binary)
{
    if (binary) return put_big(out, value);
    out = put_text(out, value);
    *out++ = ' ';
    return out;
}

char* put_number(char* out, std::int32_t value, bool binary)
{
    if (binary) return put_big(out, value);
    out = put_text(out, static_cast<long long>(value));
    *out++ = ' ';
    return out;
}

char* end_line(char* out, bool binary)
{
    if (!binary) *out++ = '\n';
    return out;
}

char* put_cell(char* out, const mesh::CellNodes& nodes, bool binary)
{
    out = put_number(out, static_cast<std::int32_t>(nodes.count), binary);
    for (const Index node : nodes.all()) out = put_number(out, node, binary);
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
        for (const double value : mesh.node(i)) out = put_number(out, value, binary);
        return end_line(out, binary);
    };
    const std::size_t of_hex = cell_size(mesh), of_quad = skin_size(mesh);
    const std::int32_t hex_number = hex_type(mesh), quad_number = quad_type(mesh);
    const auto put_type = [=](std::size_t i, char* out) {
        return end_line(put_number(out, i < hexes ? hex_number : quad_number, binary), binary);
    };
    const auto put_entity = [&mesh, hexes, binary](std::size_t i, char* out) {
        const int tag = i < hexes ? 0 : entity(mesh, i - hexes);
        return end_line(put_number(out, static_cast<std::int32_t>(tag), binary), binary);
    };
    std::string head = "# vtk DataFile Version 3.0\nhexahedra\n";
    head.append(binary ? "BINARY" : "ASCII").append("\nDATASET UNSTRUCTURED_GRID\nPOINTS ");
    head.append(std::to_string(mesh.node_count())).append(" double\n");
    const std::string sizes =
        std::string(1, ' ').append(std::to_string((of_hex + 1) * hexes + (of_quad + 1) * skin)).append("\n");
    std::vector<Section> sections{
        {head, mesh.node_count(), bytes(3, 8), each(put_point)},
        {"\nCELLS " + cells + sizes, hexes, bytes(of_hex + 1, 4),
         each([&mesh, binary](std::size_t i, char* out) {
             return put_cell(out, cell_nodes(mesh, i), binary);
         })},
        {{}, skin, bytes(of_quad + 1, 4), each([&mesh, binary](std::size_t i, char* out) {
             return put_cell(out, skin_nodes(mesh, i), binary);
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
    std::vector<Array> arrays = vtu_arrays(mesh, fields);
    std::vector<Section> sections{{vtu_head(mesh, arrays), 0, 0, {}}};
    for (Array& array : arrays) {
        put(array.sections.front().text, static_cast<std::uint64_t>(array.bytes));
        for (Section& section : array.sections) sections.push_back(std::move(section));
    }
    sections.push_back({"\n</AppendedData>\n</VTKFile>\n", 0, 0, {}});
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
