// SPDX-License-Identifier: MIT
#include "support/blocks.h"
#include "support/folder.h"
#include "support/prove_cells.h"
#include "support/write_vtk.h"

#include <lacuna/io/deck.h>
#include <lacuna/io/deck_file.h>
#include <lacuna/io/mesh_file.h>
#include <lacuna/quality/quality.h>
#include <lacuna/quality/shared/metrics.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

using namespace lacuna;

namespace {

Vec3 bent(const Vec3& p)
{
    return {p.x() + 0.1 * std::sin(3 * p.y()), p.y() * (1 + 0.2 * p.x()), p.z() * (1 + 0.3 * p.x() * p.y())};
}

/// Cells of a deck as a mesh lists them, by places of their nodes in the file.
std::vector<Hex> cells_of(const io::Deck& deck, io::DeckShape shape)
{
    std::vector<Hex> cells;
    for (const io::DeckBlock& block : deck.blocks) {
        if (block.shape != shape) continue;
        for (std::size_t e = 0; e < block.count(); ++e) {
            const auto n = block.element(e);
            cells.push_back(shape == io::DeckShape::wedge6
                                ? mesh::hex_of({n[0], n[1], n[2], n[3], n[4], n[5]})
                                : Hex{n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7]});
        }
    }
    return cells;
}

std::size_t count_of(const io::Deck& deck, io::DeckShape shape)
{
    std::size_t count = 0;
    for (const io::DeckBlock& block : deck.blocks) count += block.shape == shape ? block.count() : 0;
    return count;
}

void check_deck(const io::Deck& deck, const mesh::HexMesh& mesh, bool skin)
{
    REQUIRE(deck.points.size() == mesh.nodes.size());
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) CHECK((deck.points[n] - mesh.nodes[n]).norm() < 1e-9);
    std::vector<Hex> cells = cells_of(deck, io::DeckShape::hex8);
    CHECK(cells.size() == mesh.hex_count());
    const std::vector<Hex> wedges = cells_of(deck, io::DeckShape::wedge6);
    CHECK(wedges.size() == mesh.wedge_count());
    cells.insert(cells.end(), wedges.begin(), wedges.end());
    std::multiset<Hex> expected;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) expected.insert(mesh.hex(c));
    CHECK(std::multiset<Hex>(cells.begin(), cells.end()) == expected);
    CHECK_FALSE(test::prove_cells(deck.points, cells).finding);
    if (!skin) return;
    CHECK(count_of(deck, io::DeckShape::tri3) == 2 * mesh.triangle_count());
    CHECK(count_of(deck, io::DeckShape::quad4) == mesh.skin_count() - 2 * mesh.triangle_count());
}

} // namespace

TEST_CASE("hexahedra and wedges come back from every format, the skin's triangles and values too")
{
    for (const std::size_t every : {1, 2, 5}) {
        const mesh::HexMesh mesh = test::with_wedges(
            test::block({.columns = 4, .rows = 3, .layers = 3, .map = bent}), every);
        const test::Folder folder;
        io::CellField field{"number", {}};
        for (std::size_t c = 0; c < mesh.cell_count(); ++c) field.values.push_back(double(c));
        CAPTURE(every);
        for (const bool binary : {true, false}) {
            CAPTURE(binary);
            for (const double version : {4.1, 2.2}) {
                CAPTURE(version);
                io::write_msh(mesh, folder.file("a.msh"), {binary, version, {field}});
                check_deck(io::read_deck(folder.file("a.msh")), mesh, true);
            }
            io::write_vtk(mesh, folder.file("a.vtk"), {.binary = binary, .fields = {field}});
            check_deck(io::read_deck(folder.file("a.vtk")), mesh, true);
        }
        io::write_vtu(mesh, folder.file("a.vtu"), {.fields = {field}});
        check_deck(io::read_deck(folder.file("a.vtu")), mesh, true);
        for (const std::string name : {"a.inp", "a.bdf", "a.unv", "a.exo"}) {
            CAPTURE(name);
            const io::Format& format = io::needed_mesh_format("write", name);
            io::write_mesh(format, mesh, folder.file(name));
            check_deck(io::read_deck(folder.file(name)), mesh, format.deck == io::DeckFormat::unv);
        }
    }
}

TEST_CASE("meshes with common nodes are one mesh in every format, numbered from the first numbers asked for")
{
    const mesh::HexMesh low = test::with_wedges(test::block({.columns = 3, .rows = 2, .layers = 2}), 2);
    const Index row = low.nodes_per_layer, top = low.layers * row;
    mesh::HexMesh high = low;
    for (Vec3& node : high.nodes) node += low.nodes[index(top)] - low.nodes[0];
    std::vector<std::pair<Index, Index>> known;
    for (Index n = 0; n < row; ++n) known.emplace_back(n, top + n);
    const auto count = static_cast<Index>(low.nodes.size());
    const mesh::NodeNumbers below(0, {}, low.nodes.size()), above(count, known, high.nodes.size());
    const std::vector<mesh::LayeredPart> parts{{low, nullptr, below}, {high, nullptr, above}};
    std::multiset<Hex> expected;
    for (const mesh::LayeredPart& part : parts)
        for (std::size_t c = 0; c < part.mesh.cell_count(); ++c) {
            Hex hex = part.mesh.hex(c);
            for (Index& node : hex) node = part.numbers.of(node);
            expected.insert(hex);
        }
    for (const std::string name : {"a.msh", "a.vtu", "a.vtk", "a.inp", "a.bdf", "a.unv", "a.exo"}) {
        CAPTURE(name);
        const test::Folder folder;
        const io::Format& format = io::needed_mesh_format("write", name);
        io::MeshDeckOptions options;
        if (format.is_numbered) options.first_node = 101, options.first_cell = 1001;
        io::write_parts(format, parts, folder.file(name), {}, options);
        const io::Deck deck = io::read_deck(folder.file(name));
        REQUIRE(deck.points.size() == low.nodes.size() + high.nodes.size() - index(row));
        std::vector<Hex> cells = cells_of(deck, io::DeckShape::hex8);
        const std::vector<Hex> wedges = cells_of(deck, io::DeckShape::wedge6);
        cells.insert(cells.end(), wedges.begin(), wedges.end());
        CHECK(std::multiset<Hex>(cells.begin(), cells.end()) == expected);
        CHECK_FALSE(test::prove_cells(deck.points, cells).finding);
        if (!format.is_numbered) continue;
        CHECK(deck.point_tags.front() == 101);
        CHECK(deck.point_tags.back() == 100 + static_cast<io::DeckTag>(deck.points.size()));
        CHECK(deck.blocks.front().tags.front() == 1001);
    }
}

TEST_CASE("the scaled Jacobian made as a file is written gives the bytes of one that was held")
{
    const mesh::HexMesh blocks = test::block({.columns = 31, .rows = 17, .layers = 5, .map = bent});
    for (const mesh::HexMesh& mesh : {blocks, test::with_wedges(blocks, 3)}) {
        CAPTURE(mesh.wedge_count());
        const quality::Metric metric = quality::Metric::scaled_jacobian;
        const io::CellField held{"scaled_jacobian", quality::metric_values(mesh, metric)};
        io::CellField made{"scaled_jacobian", {}};
        made.make = [&mesh](std::span<const std::uint32_t> cells, double* out) {
            quality::scaled_jacobians(mesh, cells, out);
        };
        const test::Folder folder;
        const auto bytes = [&](const io::CellField& field) {
            std::vector<std::string> files;
            for (const bool binary : {true, false}) {
                io::write_msh(mesh, folder.file("a.msh"), {binary, 4.1, {field}});
                files.push_back(test::bytes_of(folder.file("a.msh")));
                io::write_vtk(mesh, folder.file("a.vtk"), {.binary = binary, .fields = {field}});
                files.push_back(test::bytes_of(folder.file("a.vtk")));
            }
            io::write_vtu(mesh, folder.file("a.vtu"), {.fields = {field}});
            files.push_back(test::bytes_of(folder.file("a.vtu")));
            return files;
        };
        CHECK(bytes(held) == bytes(made));
    }
}
