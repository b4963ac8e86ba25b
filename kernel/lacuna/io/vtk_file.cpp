// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/vtk_file.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <numeric>
#include <set>

namespace lacuna::io {
namespace {

std::string escaped(std::string_view name)
{
    std::string text;
    for (const char c : name) {
        if (c == '&')
            text += "&amp;";
        else if (c == '<')
            text += "&lt;";
        else if (c == '"')
            text += "&quot;";
        else
            text += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
    return text;
}

/// In which order arrays lie behind the XML. meshio 5 finds each by where it begins, and takes the wrong one
/// where that is also where one before it would begin in base64: then the order is changed.
std::vector<std::size_t> order_behind(const std::vector<VtuArray>& arrays)
{
    constexpr int kTries = 5000; // all orders of six arrays, and as much time as is spent
    std::vector<std::size_t> order(arrays.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto is_clear = [&] {
        std::set<std::size_t> in_base64;
        std::size_t raw = 0, base64 = 0;
        for (const std::size_t a : order) {
            if (in_base64.contains(raw)) return false;
            in_base64.insert(base64);
            const std::size_t bytes = sizeof(std::uint64_t) + arrays[a].bytes;
            raw += bytes;
            base64 += 4 * ((bytes + 2) / 3);
        }
        return true;
    };
    const std::vector<std::size_t> first = order;
    for (int i = 0; i < kTries; ++i) {
        if (is_clear()) return order;
        if (!std::ranges::next_permutation(order).found) break;
    }
    return first;
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

} // namespace

std::string pvtu_head(const std::vector<VtuArray>& arrays, int ghosts)
{
    std::string text = opening("PUnstructuredGrid") + " GhostLevel=\"" + std::to_string(ghosts) + "\">\n";
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
    for (const std::string& name : pieces) text += "<Piece Source=\"" + escaped(name) + "\"/>\n";
    return text + "</PUnstructuredGrid>\n</VTKFile>\n";
}

std::string piece_name(const std::string& path, std::size_t number)
{
    return std::filesystem::path(path).stem().string() + "_" + std::to_string(number) + ".vtu";
}

std::vector<Section> vtu_file(std::size_t points, std::size_t cells, std::vector<VtuArray> arrays,
                              const VtkTable& table)
{
    std::string text = opening("UnstructuredGrid") + ">\n";
    if (!table.empty()) text += "<FieldData>\n";
    // As text: short, and see `order_behind()`.
    for (const auto& [name, values] : table) {
        text += "<DataArray type=\"Int32\" Name=\"" + escaped(name) + "\" NumberOfTuples=\"" +
                std::to_string(values.size()) + "\" format=\"ascii\">";
        for (const int value : values) text.append(" ").append(std::to_string(value));
        text += "</DataArray>\n";
    }
    if (!table.empty()) text += "</FieldData>\n";
    text.append("<Piece NumberOfPoints=\"").append(std::to_string(points));
    text.append("\" NumberOfCells=\"").append(std::to_string(cells)).append("\">\n");
    const std::vector<std::size_t> order_of = order_behind(arrays);
    std::vector<std::size_t> offsets(arrays.size());
    std::vector<Section> sections(1);
    std::size_t offset = 0;
    for (const std::size_t a : order_of) {
        offsets[a] = offset;
        offset += sizeof(std::uint64_t) + arrays[a].bytes;
        put(arrays[a].sections.front().text, static_cast<std::uint64_t>(arrays[a].bytes));
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

std::string vtk_name(std::string_view name)
{
    constexpr std::string_view kHex = "0123456789ABCDEF";
    std::string text;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte > 32 && byte < 127 && c != '%' && c != '"')
            text += c;
        else
            text.append(1, '%').append(1, kHex[byte / 16]).append(1, kHex[byte % 16]);
    }
    return text;
}

std::string vtk_head(const VtkTable& table, bool binary)
{
    std::string head = "# vtk DataFile Version 3.0\nhexahedra\n";
    head.append(binary ? "BINARY" : "ASCII").append("\nDATASET UNSTRUCTURED_GRID\n");
    if (table.empty()) return head;
    head.append("FIELD FieldData ").append(std::to_string(table.size())).append("\n");
    for (const auto& [name, values] : table) {
        head.append(vtk_name(name)).append(" 1 ").append(std::to_string(values.size())).append(" int\n");
        std::string numbers(values.size() * kNumberBytes, '\0');
        char* out = numbers.data();
        for (const int value : values) out = put_number(out, static_cast<std::int32_t>(value), binary);
        head.append(numbers, 0, static_cast<std::size_t>(out - numbers.data())).append("\n");
    }
    return head;
}

} // namespace lacuna::io
