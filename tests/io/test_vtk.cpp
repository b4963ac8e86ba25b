// SPDX-License-Identifier: MIT
#include "support/blocks.h"
#include "support/folder.h"
#include "support/value_at.h"
#include "support/write_vtk.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <sstream>

using namespace lacuna;

namespace {

mesh::HexMesh crooked_block()
{
    auto mesh = test::block({.columns = 5, .rows = 3, .layers = 4, .map = [](const Vec3& p) -> Vec3 {
                                 return p + 0.01 * Vec3(p.y() * p.z(), p.x() / 3, p.x() * p.y());
                             }});
    mesh.patches[2].tag = 70;
    return mesh;
}

/// What the cells of a file must be: nodes of each, hexahedra first, and the entity they belong to.
struct Expected {
    std::vector<std::vector<Index>> cells;
    std::vector<int> entities;

    explicit Expected(const mesh::HexMesh& mesh)
    {
        for (std::size_t i = 0; i < mesh.hex_count(); ++i) {
            const Hex hex = mesh.hex(i);
            cells.emplace_back(hex.begin(), hex.end());
            entities.push_back(0);
        }
        for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
            const auto quad = mesh::skin_quad(mesh, i);
            cells.emplace_back(quad.nodes.begin(), quad.nodes.end());
            entities.push_back(mesh.patches[std::size_t(quad.patch)].tag);
        }
    }
};

/// Places of the appended arrays of a .vtu, and that each is as long as it says and ends where the next
/// begins.
std::vector<std::size_t> array_places(const std::string& bytes)
{
    const std::size_t data = bytes.find("<AppendedData encoding=\"raw\">\n_") + 31;
    std::vector<std::size_t> places;
    for (std::size_t p = bytes.find("offset=\""); p < data; p = bytes.find("offset=\"", p + 1))
        places.push_back(data + std::stoul(bytes.substr(p + 8)));
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::size_t end = i + 1 < places.size() ? places[i + 1]
                                                      : bytes.find("\n</AppendedData>", places[i]);
        CHECK(places[i] + 8 + at<std::uint64_t>(bytes, places[i]) == end);
        places[i] += 8;
    }
    return places;
}

} // namespace

TEST_CASE("a .vtu holds every node, cell and entity where its head says")
{
    const test::Folder folder;
    const auto mesh = crooked_block();
    io::write_vtu(mesh, folder.file("a.vtu"));
    const std::string bytes = test::bytes_of(folder.file("a.vtu"));
    const auto places = array_places(bytes);
    REQUIRE(places.size() == 5);
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
        for (int d = 0; d < 3; ++d)
            CHECK(at<double>(bytes, places[0] + (3 * n + std::size_t(d)) * 8) == mesh.nodes[n][d]);
    const Expected expected(mesh);
    std::size_t node = places[1];
    std::int64_t end = 0;
    for (std::size_t c = 0; c < expected.cells.size(); ++c) {
        for (const Index n : expected.cells[c]) {
            CHECK(at<std::int32_t>(bytes, node) == n);
            node += 4;
        }
        end += static_cast<std::int64_t>(expected.cells[c].size());
        CHECK(at<std::int64_t>(bytes, places[2] + 8 * c) == end);
        CHECK(at<std::uint8_t>(bytes, places[3] + c) == (c < mesh.hex_count() ? 12 : 9));
        CHECK(at<std::int32_t>(bytes, places[4] + 4 * c) == expected.entities[c]);
    }
}

TEST_CASE("a legacy .vtk holds every node, cell and entity, as text and as bytes alike")
{
    const test::Folder folder;
    const auto mesh = crooked_block();
    io::write_vtk(mesh, folder.file("text.vtk"), {.binary = false});
    io::write_vtk(mesh, folder.file("bytes.vtk"));
    std::istringstream text(test::bytes_of(folder.file("text.vtk")));
    const std::string bytes = test::bytes_of(folder.file("bytes.vtk"));
    const Expected expected(mesh);

    std::size_t place = 0;
    const auto section = [&](const std::string& word) {
        std::string line;
        while (std::getline(text, line) && line.rfind(word, 0) != 0) {}
        REQUIRE(line.rfind(word, 0) == 0);
        place = bytes.find("\n" + line + "\n") + line.size() + 2;
    };
    const auto same = [&](auto expected_value) {
        decltype(expected_value) value{};
        text >> value;
        CHECK(value == expected_value);
        auto turned = at<std::array<char, sizeof value>>(bytes, place);
        std::reverse(turned.begin(), turned.end());
        std::memcpy(&value, turned.data(), sizeof value);
        CHECK(value == expected_value);
        place += sizeof value;
    };
    section("POINTS");
    for (const Vec3& node : mesh.nodes)
        for (const double value : node) same(value);
    section("CELLS");
    for (const auto& cell : expected.cells) {
        same(std::int32_t(cell.size()));
        for (const Index n : cell) same(n);
    }
    section("CELL_TYPES");
    for (const auto& cell : expected.cells) same(std::int32_t(cell.size() == 8 ? 12 : 9));
    section("LOOKUP_TABLE");
    for (const int entity : expected.entities) same(std::int32_t(entity));
}

TEST_CASE("skins without patches are refused before a .vtu or .vtk is begun")
{
    const test::Folder folder;
    auto mesh = crooked_block();
    mesh.target_patch[1] = -1;
    CHECK(test::error_code([&] { io::write_vtu(mesh, folder.file("a.vtu")); }) == "io.no_patch");
    CHECK(test::error_code([&] { io::write_vtk(mesh, folder.file("a.vtk")); }) == "io.no_patch");
    CHECK(folder.entries() == 0);
}
