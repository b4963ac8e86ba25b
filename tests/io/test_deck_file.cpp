// SPDX-License-Identifier: MIT
#include "support/folder.h"

#include <lacuna/core/error.h>
#include <lacuna/io/mesh_file.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <span>

using namespace lacuna;
using io::Deck;
using io::DeckFormat;
using io::DeckShape;
using test::Folder;

namespace {

const std::string kSharedDecks = std::string(LACUNA_SOURCE_DIR) + "/../shared/data/fem/";

struct Target {
    const char* ending;
    DeckFormat format;
    double precision; ///< of a coordinate, relative: half of the last digit where the exponent has two
};
constexpr Target kTargets[] = {
    {".bdf", DeckFormat::nastran, 5e-11}, {".inp", DeckFormat::abaqus, 5e-14}, {".unv", DeckFormat::unv, 0}};

Deck written(const Deck& deck, const Target& target)
{
    const Folder folder;
    const std::string path = folder.file(std::string("deck") + target.ending);
    io::write_deck(deck, target.format, path);
    return io::read_deck(path);
}

/// One element of each shape with points of all sizes and tags that leave gaps.
Deck deck_of_shapes(std::span<const DeckShape> shapes, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> digits(-10, 10);
    std::uniform_int_distribution<int> power(-12, 12);
    Deck deck;
    deck.format = DeckFormat::vtu;
    deck.regions.push_back({4, "one", ""});
    for (const DeckShape shape : shapes) {
        io::DeckBlock block;
        block.shape = shape;
        for (int k = 0; k < io::shape_info(shape).nodes; ++k) {
            block.nodes.push_back(static_cast<Index>(deck.points.size()));
            Vec3 p;
            for (double& x : p) x = digits(random) * std::pow(10, power(random));
            deck.point_tags.push_back(3 * static_cast<io::DeckTag>(deck.points.size()) + 7);
            deck.points.push_back(p);
        }
        block.tags.push_back(123456789 + static_cast<io::DeckTag>(deck.blocks.size()));
        block.regions.push_back(0);
        deck.blocks.push_back(std::move(block));
    }
    return deck;
}

/// Nodes of each element, by its tag.
std::map<io::DeckTag, std::vector<io::DeckTag>> elements_of(const Deck& deck)
{
    std::map<io::DeckTag, std::vector<io::DeckTag>> elements;
    for (const io::DeckBlock& block : deck.blocks)
        for (std::size_t e = 0; e < block.count(); ++e)
            for (const Index node : block.element(e))
                elements[block.tags[e]].push_back(node < 0 ? -1 : deck.point_tags[index(node)]);
    return elements;
}

void check_same(const Deck& a, const Deck& b, double precision)
{
    CHECK(a.point_tags == b.point_tags);
    REQUIRE(a.points.size() == b.points.size());
    for (std::size_t p = 0; p < a.points.size(); ++p)
        for (int k = 0; k < 3; ++k)
            CHECK(std::abs(a.points[p][k] - b.points[p][k]) <= precision * std::abs(a.points[p][k]));
    CHECK(elements_of(a) == elements_of(b));
}

} // namespace

TEST_CASE("elements of every shape a format has come back with their numbers and nodes in order")
{
    constexpr DeckShape shapes[] = {DeckShape::tri3, DeckShape::tri6,  DeckShape::quad4,  DeckShape::quad8,
                                    DeckShape::tet4, DeckShape::tet10, DeckShape::wedge6, DeckShape::wedge15,
                                    DeckShape::hex8, DeckShape::hex20};
    for (unsigned seed = 1; seed <= 40; ++seed)
        for (const Target& target : kTargets) {
            CAPTURE(target.ending);
            const Deck deck = deck_of_shapes(shapes, seed);
            check_same(deck, written(deck, target), target.precision);
        }
}

TEST_CASE("Gmsh's and VTK's files hold every shape, to the bit, with numbers and groups")
{
    std::vector<DeckShape> shapes;
    for (std::size_t s = 0; s < mesh::kCellShapes; ++s)
        if (io::shape_info(static_cast<DeckShape>(s)).dimension > 1 &&
            static_cast<DeckShape>(s) != DeckShape::pyramid14) // VTK's full pyramid has more nodes
            shapes.push_back(static_cast<DeckShape>(s));
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Deck deck = deck_of_shapes(shapes, seed);
        deck.sets.push_back({.kind = io::DeckSet::Kind::elements, .name = "some"});
        for (const io::DeckBlock& block : deck.blocks)
            if (block.tags[0] % 2 == 0) deck.sets[0].members.push_back(block.tags[0]);
        for (const DeckFormat format : {DeckFormat::msh, DeckFormat::vtu, DeckFormat::vtk})
            for (const bool binary : {true, false})
                for (const double version : {4.1, 2.2}) {
                    const bool msh = format == DeckFormat::msh;
                    CAPTURE(static_cast<int>(format));
                    CAPTURE(binary);
                    CAPTURE(version);
                    const Folder folder;
                    const std::string path = folder.file(msh                         ? "a.msh"
                                                         : format == DeckFormat::vtu ? "a.vtu"
                                                                                     : "a.vtk");
                    io::write_deck(deck, format, path, {}, {binary, version});
                    const Deck again = io::read_deck(path);
                    REQUIRE(again.points == deck.points);
                    std::map<int, std::vector<Index>> nodes, found; // by shape
                    for (const io::DeckBlock& block : deck.blocks)
                        nodes[static_cast<int>(block.shape)] = block.nodes;
                    for (const io::DeckBlock& block : again.blocks)
                        found[static_cast<int>(block.shape)] = block.nodes;
                    for (const auto& [shape, of] : nodes) {
                        CAPTURE(shape);
                        // Readers of VTK turn wedges by the volume of the whole, which is any here.
                        std::vector<Index> turned = of;
                        if (!msh && shape == static_cast<int>(DeckShape::wedge6)) {
                            for (std::size_t e = 0; e < of.size(); e += 6) {
                                std::swap(turned[e + 1], turned[e + 2]);
                                std::swap(turned[e + 4], turned[e + 5]);
                            }
                        }
                        const bool same = found[shape] == of || found[shape] == turned;
                        CHECK(same);
                    }
                    if (!msh) continue;
                    CHECK(again.point_tags == deck.point_tags);
                    CHECK(elements_of(again) == elements_of(deck));
                }
    }
}

TEST_CASE("Nastran's 16 characters hold 13 digits where the exponent has one, and never fewer than 11")
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> digits(1, 10);
    std::uniform_int_distribution<int> power(-99, 98);
    double worst_near = 0, worst = 0;
    for (int trial = 0; trial < 200; ++trial) {
        Deck deck = deck_of_shapes(std::array{DeckShape::quad4}, 1);
        for (Vec3& p : deck.points)
            p = {digits(random) * std::pow(10, power(random) / 11), // of one digit
                 -digits(random) * std::pow(10, power(random)), digits(random)};
        const Deck again = written(deck, kTargets[0]);
        for (std::size_t p = 0; p < deck.points.size(); ++p)
            for (int k = 0; k < 3; ++k) {
                const double error = std::abs(again.points[p][k] / deck.points[p][k] - 1);
                (k == 1 ? worst : worst_near) = std::max(k == 1 ? worst : worst_near, error);
            }
    }
    MESSAGE("worst ", worst_near, " near 1, ", worst, " of all sizes");
    CHECK(worst_near <= 5.1e-13);
    CHECK(worst <= 5.1e-11);
}

TEST_CASE("an element that a format does not have is refused by count, and nothing is written")
{
    constexpr DeckShape shapes[] = {DeckShape::pyramid14};
    const Deck deck = deck_of_shapes(shapes, 1);
    for (const Target& target : kTargets) {
        const Folder folder;
        const std::string path = folder.file(std::string("deck") + target.ending);
        CHECK_THROWS_WITH_AS(io::write_deck(deck, target.format, path),
                             doctest::Contains("1 elements of 14 nodes"), InvalidInput);
        CHECK_FALSE(std::filesystem::exists(path));
    }
}

TEST_CASE("sets of nodes, elements and sides come back from an Abaqus deck, text verbatim")
{
    const std::string text =
        "*HEADING\n a deck\n*NODE, NSET=every\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n"
        "6,1,0,1\n7,1,1,1\n8,0,1,1\n*ELEMENT, TYPE=C3D8I, ELSET=solid\n11,1,2,3,4,5,6,7,8\n"
        "*ELEMENT, TYPE=S4, ELSET=skin\n12,1,2,3,4\n*ELEMENT, TYPE=CPS4, ELSET=plane\n13,1,2,3,4\n"
        "*ELEMENT, TYPE=SPRINGA, ELSET=springs\n20,1,7\n*NSET, NSET=ends\n1,7\n*ELSET, "
        "ELSET=both\nsolid,springs\n*SURFACE, NAME=top\n"
        "solid,S2\nskin,SPOS\n*SURFACE, NAME=rim\n12,E3\nplane,S4\n*MATERIAL, NAME=m\n*ELASTIC\n1.,0.\n";
    const Deck deck = io::read_deck("a.inp", text);
    const Deck again = written(deck, kTargets[1]);
    check_same(deck, again, 0);
    REQUIRE(again.texts.size() == deck.texts.size());
    for (std::size_t t = 0; t < deck.texts.size(); ++t) CHECK(again.texts[t].text == deck.texts[t].text);
    for (const io::DeckSet& set : deck.sets) {
        CAPTURE(set.name);
        const auto same = std::ranges::find_if(again.sets, [&](const io::DeckSet& other) {
            return other.kind == set.kind && other.name == set.name;
        });
        REQUIRE(same != again.sets.end());
        CHECK(same->members == set.members);
        CHECK(same->sides == set.sides);
    }
    CHECK(again.sets.size() == deck.sets.size());
    const Folder folder;
    io::write_deck(deck, DeckFormat::abaqus, folder.file("deck.inp"));
    std::ifstream file(folder.file("deck.inp"));
    const std::string out((std::istreambuf_iterator<char>(file)), {});
    CHECK(out.find("12, E3\n13, S4\n") != std::string::npos); // edges of shells, sides of elements in a plane
}

TEST_CASE("real decks written in their own format are the same decks")
{
    struct Real {
        const char* name;
        Target target;
    };
    for (const Real& real : {Real{"contact_model.bdf", kTargets[0]}, Real{"wingbox.bdf", kTargets[0]},
                             Real{"codim_1-tube.inp", kTargets[1]}, Real{"salome_cube.unv", kTargets[2]}}) {
        if (!std::filesystem::exists(kSharedDecks + real.name)) {
            MESSAGE("skipped, the decks are not there: ", real.name);
            continue;
        }
        CAPTURE(real.name);
        const Deck deck = io::read_deck(kSharedDecks + real.name);
        const Deck again = written(deck, real.target);
        check_same(deck, again, 0);
        REQUIRE(again.texts.size() == deck.texts.size());
        for (std::size_t t = 0; t < deck.texts.size(); ++t) CHECK(again.texts[t].text == deck.texts[t].text);
        CHECK(again.point_more == deck.point_more);
        REQUIRE(again.sets.size() == deck.sets.size());
        for (std::size_t s = 0; s < deck.sets.size(); ++s) {
            CHECK(again.sets[s].name == deck.sets[s].name);
            CHECK(again.sets[s].members == deck.sets[s].members);
        }
    }
}

TEST_CASE("groups and entities of an MSH file keep their tags, lines stay, a cell of two groups is one cell")
{
    // Version 2 has a cell once for each of its groups. The entity 0 is of two groups that share no cell.
    const std::string text =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 8 \"skin\"\n1 5 \"rim\"\n"
        "$EndPhysicalNames\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n9 0 0 1\n$EndNodes\n"
        "$Elements\n8\n1 1 2 5 3 1 2\n2 2 2 7 4 1 2 3\n3 2 2 8 4 1 2 3\n4 2 2 8 4 1 3 4\n"
        "5 4 2 2 0 1 2 3 9\n6 4 2 6 0 1 3 4 9\n7 15 2 1 1 1\n8 1 2 0 6 2 3\n$EndElements\n";
    const Deck deck = io::read_deck("groups.msh", text);
    CHECK(deck.element_count() == 6);
    CHECK(deck.element_count(1) == 2);
    const auto check = [&](const Deck& read) {
        std::map<std::pair<std::string, int>, std::vector<io::DeckTag>> sets;
        for (const io::DeckSet& set : read.sets) sets[{set.name, set.tag}] = set.members;
        CHECK(sets.at({"rim", 5}) == std::vector<io::DeckTag>{1});
        CHECK(sets.at({"physical_7", 7}) == std::vector<io::DeckTag>{2});
        CHECK(sets.at({"skin", 8}) == std::vector<io::DeckTag>{2, 4});
        CHECK(sets.at({"physical_2", 2}) == std::vector<io::DeckTag>{5});
        CHECK(sets.at({"physical_6", 6}) == std::vector<io::DeckTag>{6});
        CHECK(sets.size() == 5);
        CHECK(elements_of(read) == elements_of(deck));
    };
    check(deck);
    const Folder folder;
    for (const bool binary : {true, false}) {
        io::write_deck(deck, DeckFormat::msh, folder.file("a.msh"), {},
                       {.binary = binary, .all_groups = true});
        check(io::read_deck(folder.file("a.msh")));
        // A group an element: the smaller; and a note names the one that lacks some of its elements.
        for (const double version : {2.2, 4.1}) {
            std::vector<std::string> said;
            RunContext context;
            context.log = [&](std::string_view line) { said.emplace_back(line); };
            io::write_deck(deck, DeckFormat::msh, folder.file("b.msh"), context, {binary, version});
            const Deck old = io::read_deck(folder.file("b.msh"));
            CHECK(elements_of(old) == elements_of(deck));
            std::vector<int> tags;
            std::size_t members = 0;
            for (const io::DeckSet& set : old.sets) {
                tags.push_back(set.tag);
                members += set.members.size();
            }
            std::ranges::sort(tags);
            CHECK(tags == std::vector<int>{2, 5, 6, 7, 8});
            CHECK(members == 5);
            CHECK(std::ranges::any_of(said, [](const std::string& line) {
                return line.starts_with("note: ") && line.find("skin lacks") != std::string::npos;
            }));
        }
    }
    for (const Target& target : kTargets) {
        const Deck other = written(deck, target);
        CHECK(other.element_count() == 4);
        CHECK(std::ranges::none_of(other.sets, [](const io::DeckSet& set) { return set.name == "rim"; }));
    }
}

TEST_CASE("an Exodus file comes back to the bit, with numbers, nodes in order, blocks and sets of every kind")
{
    using enum DeckShape;
    constexpr DeckShape shapes[] = {tri3,     tri6,      quad4,  quad8,   quad9, tet4,  tet10,
                                    pyramid5, pyramid13, wedge6, wedge15, hex8,  hex20, hex27};
    for (unsigned seed = 1; seed <= 10; ++seed) {
        CAPTURE(seed);
        Deck deck = deck_of_shapes(shapes, seed);
        io::DeckSet nodes{.kind = io::DeckSet::Kind::nodes, .name = "ends", .members = {7, 13, 40}};
        io::DeckSet cells{.kind = io::DeckSet::Kind::elements, .name = "some"};
        io::DeckSet sides{.kind = io::DeckSet::Kind::sides, .name = "skin"};
        for (const io::DeckBlock& block : deck.blocks) {
            cells.members.push_back(block.tags[0]);
            const bool shell = io::shape_info(block.shape).dimension == 2;
            const int last = shell ? io::shape_info(block.shape).corners
                                   : static_cast<int>(io::face_corners(block.shape).size());
            for (int side = shell ? -1 : 1; side <= last; ++side)
                sides.sides.push_back({block.tags[0], side});
        }
        deck.sets = {nodes, cells, sides};
        const Folder folder;
        for (const char* name : {"a.exo", "a.e"}) {
            io::write_deck(deck, DeckFormat::exodus, folder.file(name));
            const Deck again = io::read_deck(folder.file(name));
            check_same(deck, again, 0);
            REQUIRE(again.sets.size() == 3);
            for (const io::DeckSet& set : deck.sets) {
                const auto same = std::ranges::find(again.sets, set.name, &io::DeckSet::name);
                REQUIRE(same != again.sets.end());
                CHECK(same->kind == set.kind);
                CHECK(same->members == set.members);
                CHECK(same->sides == set.sides);
            }
        }
    }
    try {
        io::read_deck("a.exo", std::string("\x89HDF\r\n\x1a\n", 8));
        CHECK(false);
    } catch (const InvalidInput& error) {
        CHECK(std::string(error.what()).find("nccopy") != std::string::npos);
    }
}
