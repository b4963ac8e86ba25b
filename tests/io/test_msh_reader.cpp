// SPDX-License-Identifier: MIT
#include "msh_cells.h"
#include "support/blocks.h"
#include "support/folder.h"

#include <lacuna/io/mesh_file.h>

#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <random>

using namespace lacuna;

namespace {

std::string code_of(const test::Folder& folder, const std::string& bytes)
{
    test::put_bytes(folder.file("x.msh"), bytes);
    return test::error_code([&] { io::read_deck(folder.file("x.msh")); });
}

std::string msh_sample(const test::Folder& folder, const io::MeshFileOptions& options)
{
    io::write_msh(test::block({.columns = 2, .rows = 2, .layers = 2}), folder.file("a.msh"), options);
    return test::bytes_of(folder.file("a.msh"));
}

const std::vector<io::MeshFileOptions> kReadFormats{{true, 4.1}, {false, 4.1}, {true, 2.2}, {false, 2.2}};

} // namespace

TEST_CASE("a file cut off anywhere is refused, never misread")
{
    const test::Folder folder;
    for (const auto& options : kReadFormats) {
        const std::string whole = msh_sample(folder, options);
        const std::size_t last = whole.rfind("$EndElements") + std::strlen("$EndElements");
        for (std::size_t length = 1; length < last; length += 1 + length / 97) {
            CAPTURE(length);
            CHECK(code_of(folder, whole.substr(0, length)) == "io.unreadable");
        }
        CHECK(code_of(folder, whole).empty());
    }
}

TEST_CASE("files with bytes changed at random are read or refused, and never end the program")
{
    const test::Folder folder;
    std::mt19937 random(11);
    int refused = 0;
    for (const auto& options : kReadFormats) {
        const std::string whole = msh_sample(folder, options);
        for (int trial = 0; trial < 400; ++trial) {
            std::string bytes = whole;
            for (unsigned k = 0; k < 1 + random() % 4; ++k)
                bytes[random() % bytes.size()] = static_cast<char>(random());
            const std::string code = code_of(folder, bytes);
            CHECK((code.empty() || code == "io.unreadable"));
            if (!code.empty()) ++refused;
        }
    }
    CHECK(refused > 100);
}

TEST_CASE("counts that lie cost no memory")
{
    const test::Folder folder;
    const std::string format = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    const std::string huge = "1000000000000000000";
    CHECK(code_of(folder, format + "$Nodes\n1 " + huge + " 1 " + huge + "\n$EndNodes\n") == "io.unreadable");
    CHECK(code_of(folder, format + "$Nodes\n" + huge + " 1 1 1\n$EndNodes\n") == "io.unreadable");
    CHECK(code_of(folder, format + "$Entities\n0 0 " + huge + " 0\n$EndEntities\n") == "io.unreadable");
    CHECK(code_of(folder, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + huge + "\n$EndNodes\n") ==
          "io.unreadable");

    std::string binary = msh_sample(folder, {true, 4.1});
    const std::size_t at = binary.find("$Nodes\n") + 7;
    for (const std::size_t place : {at, at + 8, at + 44}) {
        std::string bytes = binary;
        const std::uint64_t lie = ~std::uint64_t(0) / 16;
        std::memcpy(bytes.data() + place, &lie, sizeof lie);
        CHECK(code_of(folder, bytes) == "io.unreadable");
    }
}

TEST_CASE("what is no mesh is refused by name and place")
{
    const test::Folder folder;
    CHECK(test::error_code([&] { io::read_deck(folder.file("none.msh")); }) == "io.no_file");
    std::filesystem::create_directory(folder.file("folder.msh"));
    CHECK(test::error_code([&] { io::read_deck(folder.file("folder.msh")); }) == "io.not_a_file");
    CHECK(code_of(folder, "") == "io.empty_file");
    CHECK(code_of(folder, "solid cube\n") == "io.unreadable");
    CHECK(code_of(folder, "$MeshFormat\n4 0 8\n$EndMeshFormat\n") == "io.unreadable");
    CHECK(code_of(folder, "$MeshFormat\n4.1 0 4\n$EndMeshFormat\n") == "io.unreadable");
    CHECK(code_of(folder, "$Nodes\n0 0 0 0\n$EndNodes\n") == "io.unreadable");
}

TEST_CASE("tags need be neither dense nor in order, other cells are counted, curved ones give their corners")
{
    const test::Folder folder;
    std::string text = "$Comments\nby hand\n$EndComments\n$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                       "$PhysicalNames\n1\n3 9 \"a b\"\n$EndPhysicalNames\n$Nodes\n20\n";
    const double corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    for (int i = 19; i >= 0; --i) {
        const auto& p = corner[i % 8];
        text += std::to_string(1000000 * (i + 1)) + " " + std::to_string(p[0]) + " " + std::to_string(p[1]) +
                " " + std::to_string(p[2] + (i < 8 ? 0 : 10 + i)) + "\n";
    }
    text += "$EndNodes\n$Elements\n4\n1 15 2 5 1 1000000\n2 17 3 9 4 0";
    for (int i = 0; i < 20; ++i) text.append(1, ' ').append(std::to_string(1000000 * (i + 1)));
    text += "\n3 4 2 0 4 1000000 2000000 3000000 4000000\n4 3 2 8 6 1000000 2000000 3000000 "
            "4000000\n$EndElements\n";
    test::put_bytes(folder.file("x.msh"), text);
    const test::MshCells cells = test::read_msh_cells(folder.file("x.msh"));
    REQUIRE(cells.hexes.size() == 1);
    for (std::size_t i = 0; i < 8; ++i)
        CHECK(cells.nodes[std::size_t(cells.hexes[0][i])] == Vec3(corner[i][0], corner[i][1], corner[i][2]));
    CHECK(cells.order == 2);
    CHECK(cells.hex_entity == std::vector<int>{4});
    CHECK(cells.quads.size() == 1);
    CHECK(cells.quad_entity == std::vector<int>{6});
    REQUIRE(cells.others.size() == 1);
    CHECK(cells.others[0].type == "4");
    CHECK(cells.others[0].count() == 1);
    REQUIRE(cells.notes.size() == 1);
    CHECK(cells.notes[0].ends_with("passed over 1 cells of type 15"));
    bool found = false;
    for (const auto& group : cells.groups)
        found = found || (group.dimension == 3 && group.tag == 9 && group.name == "a b" &&
                          group.entities == std::set<int>{4});
    CHECK(found);
}

TEST_CASE("a node twice, a cell on a node that is not there, and a cell of unknown type are refused")
{
    const test::Folder folder;
    const std::string nodes =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 0 0 0\n2 1 0 0\n$EndNodes\n";
    CHECK(code_of(folder, nodes + "$Elements\n1\n1 3 0 1 2 1 2\n$EndElements\n").empty());
    CHECK(code_of(folder, nodes + "$Elements\n1\n1 3 0 1 2 1 3\n$EndElements\n") == "io.unreadable");
    CHECK(code_of(folder, nodes + "$Elements\n1\n1 3 0 1 2 1 -2\n$EndElements\n") == "io.unreadable");
    CHECK(code_of(folder, nodes + "$Elements\n1\n1 777 0 1\n$EndElements\n") == "io.unreadable");
    CHECK(code_of(folder, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n") ==
          "io.unreadable");
    CHECK(code_of(folder, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 1e999 0\n$EndNodes\n") ==
          "io.unreadable");
    CHECK(code_of(folder, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 +1 1e-999 0\n$EndNodes\n")
              .empty());
}
