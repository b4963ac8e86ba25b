// SPDX-License-Identifier: MIT
#include "support/folder.h"
#include "support/mixed_cells.h"

#include <lacuna/core/error.h>
#include <lacuna/io/deck_file.h>
#include <lacuna/io/mesh_file.h>
#include <lacuna/io/shared/solid_nodes.h>
#include <lacuna/quality/shared/prove_cells.h>
#include <lacuna/quality/shared/second_order.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <tuple>

using namespace lacuna;
using io::Deck;
using io::DeckFormat;
using test::Folder;

namespace {

struct WrittenAs {
    const char* file;
    DeckFormat format;
    io::MeshFileOptions options{};
};
const WrittenAs kWrittenAs[] = {
    {"a.msh", DeckFormat::msh},
    {"b.msh", DeckFormat::msh, {.binary = false}},
    {"c.msh", DeckFormat::msh, {.binary = true, .version = 2.2}},
    {"d.msh", DeckFormat::msh, {.binary = false, .version = 2.2}},
    {"a.vtk", DeckFormat::vtk},
    {"b.vtk", DeckFormat::vtk, {.binary = false}},
    {"a.vtu", DeckFormat::vtu},
    {"a.inp", DeckFormat::abaqus},
    {"a.bdf", DeckFormat::nastran},
    {"a.unv", DeckFormat::unv},
    {"a.exo", DeckFormat::exodus},
};

/// Nodes of the elements by shape, in the order of the file.
std::map<io::DeckShape, std::multiset<std::vector<Index>>> elements_by_shape(const Deck& deck)
{
    std::map<io::DeckShape, std::multiset<std::vector<Index>>> elements;
    for (const io::DeckBlock& block : deck.blocks)
        for (std::size_t e = 0; e < block.count(); ++e)
            elements[block.shape].emplace(block.element(e).begin(), block.element(e).end());
    return elements;
}

std::vector<mesh::CellNodes> measurable_cells(const Deck& deck)
{
    std::vector<mesh::CellNodes> solids;
    for (const io::DeckBlock& block : deck.blocks)
        for (std::size_t e = 0; e < block.count(); ++e) solids.push_back(io::solid_nodes(block, e));
    return solids;
}

} // namespace

TEST_CASE("hexahedra, wedges, pyramids and tetrahedra come back from every format, of order 1 and 2")
{
    for (const int order : {1, 2})
        for (const WrittenAs& target : kWrittenAs) {
            CAPTURE(order);
            CAPTURE(target.file);
            const Deck deck = test::mixed_deck(3, order, order == 2 ? 0.01 : 0);
            const Folder folder;
            const std::string path = folder.file(target.file);
            io::write_deck(deck, target.format, path, {}, target.options);
            const Deck again = io::read_deck(path);
            CHECK(elements_by_shape(again) == elements_by_shape(deck));
            std::set<Index> regions;
            for (const io::DeckBlock& block : again.blocks)
                regions.insert(block.regions.begin(), block.regions.end());
            CHECK(regions.size() == 1);
            REQUIRE(again.points.size() == deck.points.size());
            double farthest = 0;
            for (std::size_t p = 0; p < deck.points.size(); ++p)
                farthest = std::max(farthest, (again.points[p] - deck.points[p]).norm());
            CHECK(farthest < 1e-11);
            const auto solids = measurable_cells(again);
            const quality::Quality quality = quality::measure_cells(again.points, solids);
            CHECK(quality.uncertified == 0);
            CHECK(quality.pyramids == 6);
            CHECK(quality.tets == 96);
            if (order == 2) {
                const auto given = quality::measure_cells(deck.points, measurable_cells(deck));
                CHECK(quality.volume == doctest::Approx(given.volume));
                CHECK(quality.min_scaled_jacobian == doctest::Approx(given.min_scaled_jacobian));
                continue;
            }
            CHECK(quality.volume == doctest::Approx(18));
            std::vector<Hex> corners(solids.size());
            for (std::size_t c = 0; c < solids.size(); ++c)
                std::copy_n(solids[c].node.begin(), 8, corners[c].begin());
            CHECK_FALSE(quality::prove_cells(again.points, corners).finding);
        }
}

TEST_CASE("a pyramid is a brick with a repeated apex in Abaqus and UNV")
{
    const Folder folder;
    Deck deck = test::mixed_deck(3, 1);
    io::DeckSet skin{.kind = io::DeckSet::Kind::sides, .name = "skin"};
    for (const io::DeckBlock& block : deck.blocks)
        for (const io::DeckTag tag : block.tags)
            for (int side = 1; side <= static_cast<int>(mesh::face_corners(block.shape).size()); ++side)
                skin.sides.push_back({tag, side});
    std::ranges::sort(skin.sides);
    deck.sets = {skin};
    const std::string path = folder.file("a.inp");
    for (int round = 0; round < 2; ++round) {
        io::write_deck(round == 0 ? deck : io::read_deck(path), DeckFormat::abaqus, path);
        std::ifstream file(path);
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        CHECK(text.find("C3D5") == std::string::npos);
        const Deck again = io::read_deck(path);
        CHECK(elements_by_shape(again) == elements_by_shape(deck));
        const auto same = std::ranges::find(again.sets, io::DeckSet::Kind::sides, &io::DeckSet::kind);
        REQUIRE(same != again.sets.end());
        CHECK(same->sides == skin.sides);
    }
    // A deck's own word stays.
    const std::string own =
        "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0.5,0.5,1\n*ELEMENT, TYPE=C3D5\n1,1,2,3,4,5\n"
        "*ELEMENT, TYPE=C3D8R\n2,4,3,2,1,5,5,5,5\n";
    const Deck kept = io::read_deck("own.inp", own);
    CHECK(kept.element_count(3) == 2);
    io::write_deck(kept, DeckFormat::abaqus, path);
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    CHECK(text.find("TYPE=C3D5\n1, 1, 2, 3, 4, 5\n") != std::string::npos);
    CHECK(text.find("TYPE=C3D8R\n2, 4, 3, 2, 1, 5, 5, 5, 5\n") != std::string::npos);
    CHECK(elements_by_shape(io::read_deck(path)) == elements_by_shape(kept));
}

TEST_CASE("in Abaqus an equation ties each middle node of the bases of pyramids to corners, once")
{
    for (const double bend : {0.0, 0.01}) {
        CAPTURE(bend);
        Deck deck = test::mixed_deck(3, 2, bend);
        std::map<io::DeckTag, Vec3> place;
        for (std::size_t p = 0; p < deck.points.size(); ++p) place[deck.point_tags[p]] = deck.points[p];
        std::set<io::DeckTag> middles;
        for (const io::DeckBlock& block : deck.blocks)
            for (std::size_t e = 0; block.shape == io::DeckShape::pyramid13 && e < block.count(); ++e)
                for (std::size_t k = 5; k < 9; ++k)
                    middles.insert(deck.point_tags[index(block.element(e)[k])]);
        deck.sets = {{.kind = io::DeckSet::Kind::nodes, .name = "all", .members = deck.point_tags}};
        const Folder folder;
        const std::string path = folder.file("a.inp");
        io::write_deck(deck, DeckFormat::abaqus, path);
        const Deck once = io::read_deck(path);
        const auto all = std::ranges::find(once.sets, io::DeckSet::Kind::nodes, &io::DeckSet::kind);
        REQUIRE(all != once.sets.end());
        CHECK(all->members.size() + middles.size() == deck.points.size());
        io::write_deck(io::read_deck(path), DeckFormat::abaqus, path); // keeps the equations
        std::ifstream file(path);
        std::vector<double> numbers;
        bool inside = false;
        for (std::string line; std::getline(file, line);) {
            if (line.starts_with("**")) continue;
            if (line.starts_with("*")) inside = line == "*EQUATION";
            if (line.starts_with("*") || !inside) continue;
            std::ranges::replace(line, ',', ' ');
            std::istringstream words(line);
            for (double number = 0; words >> number;) numbers.push_back(number);
        }
        std::set<io::DeckTag> found;
        int equations = 0;
        // Each keeps every affine displacement, here a shift and that of the places themselves.
        for (std::size_t at = 0; at < numbers.size(); ++equations) {
            const auto terms = static_cast<std::size_t>(numbers[at++]);
            REQUIRE(at + 3 * terms <= numbers.size());
            found.insert(static_cast<io::DeckTag>(numbers[at]));
            double shift = 0, moved = 0;
            for (std::size_t t = 0; t < terms; ++t, at += 3) {
                const int axis = static_cast<int>(numbers[at + 1]) - 1;
                shift += numbers[at + 2];
                moved += numbers[at + 2] * place.at(static_cast<io::DeckTag>(numbers[at]))[axis];
            }
            CHECK(std::abs(shift) < 1e-12);
            CHECK(std::abs(moved) < 1e-10);
        }
        CHECK(found == middles);
        CHECK(equations == 3 * static_cast<int>(middles.size()));
    }
}

TEST_CASE(
    "a pyramid of 14 nodes is written to MSH and Exodus, without its centre to VTK, and refused elsewhere")
{
    Deck deck;
    deck.format = DeckFormat::vtu;
    deck.regions.push_back({1, "solid", ""});
    deck.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.4, 0.5, 0.7}};
    for (const auto& [a, b] : mesh::side_corners(io::DeckShape::pyramid14))
        deck.points.push_back((deck.points[index(a)] + deck.points[index(b)]) / 2);
    deck.points.emplace_back(0.5, 0.5, 0.01);
    io::DeckBlock block{.shape = io::DeckShape::pyramid14, .type = {}};
    for (std::size_t p = 0; p < deck.points.size(); ++p) {
        block.nodes.push_back(static_cast<Index>(p));
        deck.point_tags.push_back(static_cast<io::DeckTag>(p) + 1);
    }
    block.tags = {1};
    block.regions = {0};
    deck.blocks = {block};
    const Folder folder;
    for (const auto& [name, format, nodes] :
         {std::tuple("a.msh", DeckFormat::msh, 14), std::tuple("a.exo", DeckFormat::exodus, 14),
          std::tuple("a.vtu", DeckFormat::vtu, 13), std::tuple("a.vtk", DeckFormat::vtk, 13)}) {
        CAPTURE(name);
        std::vector<std::string> lines;
        RunContext context;
        context.log = [&](std::string_view line) { lines.emplace_back(line); };
        io::write_deck(deck, format, folder.file(name), context);
        const Deck again = io::read_deck(folder.file(name));
        REQUIRE(again.blocks.size() == 1);
        CHECK(mesh::shape_info(again.blocks[0].shape).nodes == nodes);
        CHECK(lines.size() == (nodes == 13 ? 1 : 0));
        const auto solids = measurable_cells(again);
        CHECK(quality::measure_cells(again.points, solids).uncertified == 0);
    }
    for (const char* name : {"b.inp", "b.bdf", "b.unv"}) {
        const io::Format* const format = io::find_format(name);
        CHECK_THROWS_AS(io::write_deck(deck, *format, io::OutputPath(folder.file(name))), InvalidInput);
        CHECK_FALSE(std::filesystem::exists(folder.file(name)));
    }
}
