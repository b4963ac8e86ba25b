// SPDX-License-Identifier: MIT
#include "msh_cells.h"
#include "support/blocks.h"
#include "support/folder.h"
#include "support/prove_cells.h"

#include <lacuna/io/mesh_file.h>
#include <lacuna/quality/quality.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <locale>
#include <map>

using namespace lacuna;

namespace {

const std::vector<io::MeshFileOptions> kFormats{{true, 4.1}, {false, 4.1}, {true, 2.2}, {false, 2.2}};

Vec3 far_and_crooked(const Vec3& p)
{
    return Vec3(p.x() + std::sin(p.y()) / 3, p.y() * 1e-3 - 1e5, p.z() / 7 + p.x() * p.y() * 1e-9);
}

test::MshCells written_and_read(const mesh::HexMesh& mesh, const io::MeshFileOptions& options)
{
    const test::Folder folder;
    io::write_msh(mesh, folder.file("a.msh"), options);
    return test::read_msh_cells(folder.file("a.msh"));
}

const test::MshGroup* find_group(const test::MshCells& cells, const std::string& name)
{
    const auto found = std::find_if(cells.groups.begin(), cells.groups.end(),
                                    [&](const auto& g) { return g.name == name; });
    return found == cells.groups.end() ? nullptr : &*found;
}

} // namespace

TEST_CASE("nodes, cells and skin come back from every format bit for bit, in their order")
{
    for (const auto& options : kFormats) {
        for (const auto& mesh :
             {test::block({.columns = 3, .rows = 2, .layers = 4, .map = far_and_crooked}), test::ring(40, 30),
              test::block({.columns = 60, .rows = 50, .layers = 9, .map = far_and_crooked})}) {
            CAPTURE(options.version);
            CAPTURE(options.binary);
            const test::MshCells cells = written_and_read(mesh, options);
            CHECK(cells.nodes == mesh.nodes);
            REQUIRE(cells.hexes.size() == mesh.hex_count());
            bool same = true;
            for (std::size_t i = 0; i < mesh.hex_count(); ++i) same = same && cells.hexes[i] == mesh.hex(i);
            CHECK(same);
            CHECK(cells.order == 1);
            CHECK(cells.others.empty());

            std::map<int, std::vector<Quad>> expected;
            for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
                const mesh::SkinQuad quad = mesh::skin_quad(mesh, i);
                expected[mesh.patches[std::size_t(quad.patch)].tag].push_back(quad.nodes);
            }
            std::map<int, std::vector<Quad>> found;
            for (std::size_t i = 0; i < cells.quads.size(); ++i)
                found[cells.quad_entity[i]].push_back(cells.quads[i]);
            CHECK(found == expected);
        }
    }
}

TEST_CASE("a mesh read back is proved, its skin included")
{
    const auto mesh = test::ring(12, 5);
    for (const auto& options : kFormats) {
        const test::MshCells cells = written_and_read(mesh, options);
        CHECK(test::prove_cells(cells.nodes, cells.hexes, cells.quads).quality.hexes == mesh.hex_count());
    }
}

TEST_CASE("every group has its name and its surfaces; a name over several patches is one group")
{
    auto mesh = test::block({});
    mesh.patches = {{7, {"source", "inlet"}}, {2, {"target"}}, {31, {"inlet"}}, {50, {}}, {60, {"nothing"}}};
    std::fill(mesh.wall_patch.begin() + 4, mesh.wall_patch.end(), 3);
    mesh.volume_groups = {"volume", "inlet"};
    for (const bool binary : {true, false}) {
        const test::MshCells cells = written_and_read(mesh, {.binary = binary, .all_groups = true});
        const auto entities = [&](const char* name) {
            const test::MshGroup* group = find_group(cells, name);
            return group == nullptr ? std::set<int>{-1} : group->entities;
        };
        CHECK(entities("source") == std::set<int>{7});
        CHECK(entities("inlet") == std::set<int>{7, 31});
        CHECK(entities("target") == std::set<int>{2});
        CHECK(entities("surface:50") == std::set<int>{50});
        CHECK(find_group(cells, "nothing") == nullptr);
        std::size_t volumes = 0;
        for (const test::MshGroup& group : cells.groups)
            if (group.dimension == 3) ++volumes;
        CHECK(volumes == 2);
        CHECK(cells.groups.size() == 6);
    }
}

TEST_CASE("entities are in one group each, with fields, in parts and in every version")
{
    auto mesh = test::block({.layers = 4});
    std::fill(mesh.wall_patch.begin() + 4, mesh.wall_patch.end(), 3);
    mesh.volume_groups = {"resin", "volume"};
    // Groups that overlap in any way: the first of each patch counts.
    for (unsigned choice = 0; choice < 81; ++choice) {
        mesh.patches = {{7, {"source"}}, {2, {"target"}}, {31, {"wall:3"}}, {50, {}}};
        for (std::size_t p = 0, left = choice; p < 4; ++p, left /= 3) {
            mesh::SkinPatch& patch = mesh.patches[p];
            if (left % 3 == 1) patch.groups.emplace_back("inlet");
            if (left % 3 == 2) patch.groups.insert(patch.groups.begin(), "inlet");
        }
        for (io::MeshFileOptions options : kFormats)
            for (const int parts : {0, 2}) {
                if (parts > 0 && options.version == 2.2) continue;
                options.partition.parts = parts;
                const test::MshCells cells = written_and_read(mesh, options);
                std::map<std::pair<int, int>, std::vector<std::string>> groups; // of each entity
                for (const test::MshGroup& group : cells.groups)
                    for (const int entity : group.entities)
                        groups[{group.dimension, entity}].push_back(group.name);
                CHECK(groups.size() == 5);
                CHECK(groups[{3, 1}] == std::vector<std::string>{"resin"});
                for (const mesh::SkinPatch& patch : mesh.patches) {
                    const std::string one = patch.groups.empty() ? "surface:50" : patch.groups.front();
                    CHECK(groups[{2, patch.tag}] == std::vector{one});
                }
            }
    }
}

TEST_CASE("names the format cannot hold are changed, and stay different from each other")
{
    auto mesh = test::block({});
    const std::string umlauts = std::string(126, 'x') + "\xc3\xa4";
    mesh.patches[0].groups = {"say \"so\"", "two\nlines", std::string(300, 'a') + "1",
                              std::string(300, 'a') + "2", umlauts};
    for (const bool binary : {true, false}) {
        const test::MshCells cells = written_and_read(mesh, {.binary = binary, .all_groups = true});
        CHECK(find_group(cells, "say 'so'") != nullptr);
        CHECK(find_group(cells, "two lines") != nullptr);
        CHECK(find_group(cells, std::string(127, 'a')) != nullptr);
        CHECK(find_group(cells, std::string(125, 'a') + "~2") != nullptr);
        CHECK(find_group(cells, std::string(126, 'x')) != nullptr);
        CHECK(cells.groups.size() == 8);
    }
}

TEST_CASE("what MSH 2.2 cannot hold is told")
{
    auto mesh = test::block({});
    mesh.patches[0].groups = {"source", "inlet"};
    const test::Folder folder;
    std::vector<std::string> lines;
    RunContext context;
    context.log = [&](std::string_view line) { lines.emplace_back(line); };
    io::write_msh(mesh, folder.file("a.msh"), {.version = 4.1}, context);
    CHECK(lines.empty());
    io::write_msh(mesh, folder.file("a.msh"), {.version = 2.2}, context); // one group a facet
    CHECK(lines.empty());
    io::write_msh(mesh, folder.file("a.msh"), {.version = 2.2, .all_groups = true}, context);
    CHECK(lines.size() == 1);
}

TEST_CASE("a file is the same to the byte for any number of threads and in any locale")
{
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    const auto mesh = test::block({.columns = 50, .rows = 50, .layers = 12, .map = far_and_crooked});
    for (const auto& options : kFormats) {
        const test::Folder folder;
        RunContext context;
        context.threads = 1;
        io::write_msh(mesh, folder.file("one.msh"), options, context);
        const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
        context.threads = 5;
        io::write_msh(mesh, folder.file("five.msh"), options, context);
        std::locale::global(before);
        const std::string one = test::bytes_of(folder.file("one.msh"));
        CHECK(one.size() > 1000000);
        CHECK(one == test::bytes_of(folder.file("five.msh")));
    }
}

TEST_CASE("unknown versions and skins without patches are refused before anything is written")
{
    const test::Folder folder;
    auto mesh = test::block({});
    CHECK(test::error_code([&] { io::write_msh(mesh, folder.file("a.msh"), {.version = 3}); }) ==
          "io.unknown_version");
    mesh.source_patch[2] = 3;
    CHECK(test::error_code([&] { io::write_msh(mesh, folder.file("a.msh")); }) == "io.no_patch");
    mesh.source_patch[2] = 0;
    mesh.patches[0].tag = 0;
    CHECK(test::error_code([&] { io::write_msh(mesh, folder.file("a.msh")); }) == "io.patch_tag");
    CHECK(folder.entries() == 0);
}
