// SPDX-License-Identifier: MIT
#include "msh_cells.h"
#include "support/blocks.h"
#include "support/folder.h"
#include "support/write_vtk.h"

#include <lacuna/io/mesh_file.h>
#include <lacuna/quality/shared/metrics.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <sstream>

using namespace lacuna;

namespace {

const std::vector<std::pair<bool, double>> kFieldFormats{
    {true, 4.1}, {false, 4.1}, {true, 2.2}, {false, 2.2}};

Vec3 crooked(const Vec3& p) { return Vec3(p.x() + p.y() * p.z() / 3, p.y() + p.x() * p.x() / 7, p.z()); }

mesh::HexMesh block_with_holes()
{
    return test::block({.columns = 5, .rows = 4, .layers = 3, .map = crooked, .leave_out = [](int i, int j) {
                            return i == 2 && (j == 1 || j == 2);
                        }});
}

std::vector<io::CellField> fields_of(const mesh::HexMesh& mesh)
{
    io::CellField numbers{"numbers", {}};
    for (std::size_t i = 0; i < mesh.hex_count(); ++i) numbers.values.push_back(double(i) / 3);
    return {{"scaled_jacobian", quality::metric_values(mesh, quality::Metric::scaled_jacobian)}, numbers};
}

/// Number of the one cell that has all the nodes.
std::size_t cell_with(const mesh::HexMesh& mesh, const Quad& nodes)
{
    std::size_t found = mesh.hex_count();
    int count = 0;
    for (std::size_t i = 0; i < mesh.hex_count(); ++i) {
        const Hex hex = mesh.hex(i);
        const bool all = std::all_of(nodes.begin(), nodes.end(), [&](Index node) {
            return std::find(hex.begin(), hex.end(), node) != hex.end();
        });
        if (!all) continue;
        found = i;
        ++count;
    }
    REQUIRE(count == 1);
    return found;
}

struct ElementData {
    std::string name;
    std::vector<int> numbers;
    std::vector<double> values;
};

std::vector<ElementData> element_data(const std::string& bytes, bool binary)
{
    std::vector<ElementData> sections;
    std::istringstream in(bytes);
    for (std::string line; std::getline(in, line);) {
        if (line != "$ElementData") continue;
        ElementData data;
        std::string head[9];
        for (std::string& word : head) {
            if (&word == &head[8]) break;
            std::getline(in, word);
        }
        CHECK(head[0] == "1");
        data.name = head[1];
        CHECK(head[2] == "1");
        CHECK(head[4] == "3");
        CHECK(head[6] == "1"); // one number an element
        const int count = std::stoi(head[7]);
        for (int i = 0; i < count; ++i) {
            std::int32_t number = 0;
            double value = 0;
            if (binary) {
                in.read(reinterpret_cast<char*>(&number), sizeof number);
                in.read(reinterpret_cast<char*>(&value), sizeof value);
            } else {
                in >> number >> value;
            }
            data.numbers.push_back(number);
            data.values.push_back(value);
        }
        in.ignore(1); // end of line
        std::getline(in, line);
        CHECK(line == "$EndElementData");
        sections.push_back(data);
    }
    return sections;
}

} // namespace

TEST_CASE(
    "every element of a .msh carries the value of its cell, quads of the skin that of the cell they bound")
{
    const auto mesh = block_with_holes();
    const auto fields = fields_of(mesh);
    for (const auto& [binary, version] : kFieldFormats) {
        CAPTURE(binary);
        CAPTURE(version);
        const test::Folder folder;
        io::write_msh(mesh, folder.file("a.msh"), {binary, version, fields});
        const test::MshCells cells = test::read_msh_cells(folder.file("a.msh"));
        REQUIRE(cells.hexes.size() == mesh.hex_count());
        CHECK(cells.nodes == mesh.nodes);
        const auto sections = element_data(test::bytes_of(folder.file("a.msh")), binary);
        REQUIRE(sections.size() == fields.size());
        for (std::size_t f = 0; f < fields.size(); ++f) {
            CHECK(sections[f].name == '"' + fields[f].name + '"');
            REQUIRE(sections[f].values.size() == cells.quads.size() + cells.hexes.size());
            for (std::size_t i = 0; i < sections[f].values.size(); ++i) {
                CHECK(sections[f].numbers[i] == int(i) + 1);
                const std::size_t cell = i < cells.quads.size() ? cell_with(mesh, cells.quads[i])
                                                                : i - cells.quads.size();
                CHECK(sections[f].values[i] == fields[f].values[cell]);
            }
        }
    }
}

TEST_CASE("a file without fields is the same as ever, and one with them only longer by them")
{
    const auto mesh = block_with_holes();
    for (const auto& [binary, version] : kFieldFormats) {
        const test::Folder folder;
        io::write_msh(mesh, folder.file("plain.msh"), {.binary = binary, .version = version});
        io::write_msh(mesh, folder.file("more.msh"), {binary, version, fields_of(mesh)});
        const std::string plain = test::bytes_of(folder.file("plain.msh"));
        const std::string more = test::bytes_of(folder.file("more.msh"));
        CHECK(plain.find("ElementData") == std::string::npos);
        CHECK(more.substr(0, plain.size()) == plain);
        CHECK(more.substr(plain.size(), 13) == "$ElementData\n");
    }
}

TEST_CASE("files with fields are the same to the byte for any number of threads")
{
    const auto mesh = test::block({.columns = 50, .rows = 50, .layers = 12, .map = crooked});
    for (const auto& [binary, version] : kFieldFormats) {
        const test::Folder folder;
        RunContext context;
        context.threads = 1;
        io::write_msh(mesh, folder.file("one.msh"), {binary, version, fields_of(mesh)}, context);
        context.threads = 5;
        io::write_msh(mesh, folder.file("five.msh"), {binary, version, fields_of(mesh)}, context);
        CHECK(test::bytes_of(folder.file("one.msh")) == test::bytes_of(folder.file("five.msh")));
    }
}

TEST_CASE("fields become cell arrays of .vtu and .vtk, hexahedra first, then the skin")
{
    const auto mesh = block_with_holes();
    const auto fields = fields_of(mesh);
    const test::Folder folder;
    io::write_vtu(mesh, folder.file("a.vtu"), {fields});
    io::write_vtk(mesh, folder.file("a.vtk"), {false, fields});
    io::write_vtk(mesh, folder.file("b.vtk"), {true, fields});
    const std::string vtu = test::bytes_of(folder.file("a.vtu"));
    const std::string bytes = test::bytes_of(folder.file("b.vtk"));
    std::istringstream text(test::bytes_of(folder.file("a.vtk")));
    const std::size_t data = vtu.find("\n_") + 2;
    for (const io::CellField& field : fields) {
        const std::size_t head = vtu.find("Name=\"" + field.name + "\"");
        REQUIRE(head != std::string::npos);
        const std::size_t place = data + std::stoul(vtu.substr(vtu.find("offset=\"", head) + 8)) + 8;
        const std::string title = "SCALARS " + field.name + " double 1";
        std::string line;
        while (std::getline(text, line) && line != title) {}
        REQUIRE(line == title);
        std::getline(text, line);
        const std::size_t big = bytes.find(title + "\nLOOKUP_TABLE default\n") + title.size() + 22;
        for (std::size_t c = 0; c < mesh.hex_count() + mesh.skin_count(); ++c) {
            const std::size_t cell = c < mesh.hex_count()
                                         ? c
                                         : cell_with(mesh, skin_quad(mesh, c - mesh.hex_count()).nodes);
            double value = 0;
            std::memcpy(&value, vtu.data() + place + 8 * c, 8);
            CHECK(value == field.values[cell]);
            text >> value;
            CHECK(value == field.values[cell]);
            char turned[8];
            std::reverse_copy(bytes.data() + big + 8 * c, bytes.data() + big + 8 * c + 8, turned);
            std::memcpy(&value, turned, 8);
            CHECK(value == field.values[cell]);
        }
    }
}

TEST_CASE("fields of the wrong length, without a name, with one that cannot be written or twice are refused")
{
    const auto mesh = block_with_holes();
    const test::Folder folder;
    const std::vector<double> values(mesh.hex_count(), 1.0);
    const auto code = [&](const std::vector<io::CellField>& fields) {
        const std::string msh = test::error_code([&] {
            io::write_msh(mesh, folder.file("a.msh"), {true, 4.1, fields});
        });
        CHECK(test::error_code([&] { io::write_vtu(mesh, folder.file("a.vtu"), {fields}); }) == msh);
        CHECK(test::error_code([&] { io::write_vtk(mesh, folder.file("a.vtk"), {true, fields}); }) == msh);
        return msh;
    };
    CHECK(code({{"short", {1, 2, 3}}}) == "io.field_size");
    for (const char* name : {"", "two words", "a\"b", "a<b", "entity", "line\n"})
        CHECK(code({{name, values}}) == "io.field_name");
    CHECK(code({{"same", values}, {"same", values}}) == "io.field_name");
    CHECK(folder.entries() == 0);
}
