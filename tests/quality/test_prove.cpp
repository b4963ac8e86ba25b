// SPDX-License-Identifier: MIT
#include "support/blocks.h"
#include "support/prove_cells.h"

#include <lacuna/core/error.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quality/quality.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>

using namespace lacuna;

namespace {

std::string code_of(const quality::Proof& proof)
{
    return proof.finding ? quality::fault_code(proof.finding->fault) : "";
}

std::string code_of(const mesh::HexMesh& mesh, double limit = 0)
{
    return code_of(quality::prove(mesh, limit));
}

std::vector<Quad> all_skin(const mesh::HexMesh& mesh)
{
    std::vector<Quad> skin;
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) skin.push_back(mesh::skin_quad(mesh, i).nodes);
    return skin;
}

} // namespace

TEST_CASE("sound meshes are proved, swept or as a list with their skin, and measured on the way")
{
    for (const int layers : {1, 4}) {
        for (const auto& mesh :
             {test::block({.columns = 5, .rows = 4, .layers = layers}), test::ring(9, layers),
              test::block({.columns = 5, .rows = 5, .layers = layers, .leave_out = [](int i, int j) {
                               return i == j && i % 2 == 1;
                           }})}) {
            CHECK(quality::prove(mesh).quality.volume == quality::measure(mesh).volume);
            const auto hexes = test::all_hexes(mesh);
            CHECK(test::prove_cells(mesh.nodes, hexes).quality.hexes == hexes.size());
            CHECK(test::prove_cells(mesh.nodes, hexes, all_skin(mesh)).quality.hexes == hexes.size());
        }
    }
}

TEST_CASE("what is wrong with a swept mesh is found and called by its name")
{
    auto mesh = test::block({});
    SUBCASE("no cells")
    {
        mesh.layers = 0;
        CHECK(code_of(mesh) == "quality.empty");
        CHECK(code_of(mesh::HexMesh{}) == "quality.empty");
    }
    SUBCASE("too few nodes")
    {
        mesh.nodes.pop_back();
        CHECK(code_of(mesh) == "quality.wrong_size");
    }
    SUBCASE("a corner out of range")
    {
        mesh.quads[3][2] = 16;
        CHECK(code_of(mesh) == "quality.unknown_node");
        mesh.quads[3][2] = -1;
        CHECK(code_of(mesh) == "quality.unknown_node");
    }
    SUBCASE("a wall quad without patch")
    {
        mesh.wall_patch[4] = 3;
        CHECK(code_of(mesh) == "quality.no_patch");
    }
    SUBCASE("two patches with one tag")
    {
        mesh.patches[1].tag = 1;
        CHECK(code_of(mesh) == "quality.patch_tag");
    }
    SUBCASE("a quad twice")
    {
        mesh.quads[1] = mesh.quads[0];
        CHECK(code_of(mesh) == "quality.not_conformal");
    }
    SUBCASE("a quad turned over")
    {
        std::swap(mesh.quads[4][1], mesh.quads[4][3]);
        CHECK(code_of(mesh) == "quality.not_conformal");
    }
    SUBCASE("a node without quad")
    {
        mesh.quads[0] = {0, 1, 5, 4};
        mesh.quads.erase(mesh.quads.begin());
        mesh.source_patch.pop_back();
        mesh.target_patch.pop_back();
        CHECK(code_of(mesh) == "quality.unused_node");
    }
    SUBCASE("parts that touch in a node")
    {
        CHECK(code_of(test::block({.columns = 2, .rows = 2, .leave_out = [](int i, int j) {
                                       return i == j;
                                   }})) == "quality.pinched");
    }
    SUBCASE("a rim side missing, doubled, or run the wrong way")
    {
        auto missing = mesh;
        missing.rim.pop_back();
        missing.wall_patch.resize(missing.rim.size() * 3);
        CHECK(code_of(missing) == "quality.open_skin");
        auto doubled = mesh;
        doubled.rim[1] = doubled.rim[0];
        CHECK(code_of(doubled) == "quality.open_skin");
        auto turned = mesh;
        std::swap(turned.rim[0][0], turned.rim[0][1]);
        CHECK(code_of(turned) == "quality.open_skin");
    }
    SUBCASE("a node that is not a number")
    {
        mesh.nodes[20].x() = std::nan("");
        CHECK(code_of(mesh) == "quality.inverted");
    }
    SUBCASE("a cell that is turned inside out")
    {
        mesh.nodes[21].z() += 0.7;
        CHECK(code_of(mesh) == "quality.inverted");
    }
    SUBCASE("a limit on the scaled Jacobian")
    {
        mesh.nodes[21].z() += 0.1;
        CHECK(code_of(mesh, 0.5).empty());
        CHECK(code_of(mesh, 0.999) == "quality.below_limit");
    }
}

TEST_CASE("nodes of two parts in one place are found, to within 1e-9 of the diagonal and no more")
{
    // A slit: the columns of cells on both sides of x = 1/2 have nodes of their own there.
    const auto slit = [](double width) {
        auto mesh = test::block({.columns = 4, .rows = 3, .layers = 5});
        std::vector<Index> twin(static_cast<std::size_t>(mesh.nodes_per_layer), -1);
        Index count = mesh.nodes_per_layer;
        const auto at = [&](Index n) { return mesh.nodes[static_cast<std::size_t>(n)]; };
        for (Quad& quad : mesh.quads) {
            double centre = 0;
            for (const Index n : quad) centre += 0.25 * at(n).x();
            for (Index& n : quad) {
                if (centre < 0.5 || std::abs(at(n).x() - 0.5) > 1e-6) continue;
                Index& other = twin[static_cast<std::size_t>(n)];
                if (other < 0) other = count++;
                n = other;
            }
        }
        std::vector<Vec3> nodes;
        for (int layer = 0; layer <= mesh.layers; ++layer) {
            const auto first = static_cast<std::size_t>(layer * mesh.nodes_per_layer);
            const auto size = nodes.size();
            nodes.resize(size + static_cast<std::size_t>(count));
            for (std::size_t n = 0; n < twin.size(); ++n) {
                nodes[size + n] = mesh.nodes[first + n];
                if (twin[n] >= 0)
                    nodes[size + static_cast<std::size_t>(twin[n])] = mesh.nodes[first + n] +
                                                                      Vec3(width, 0, 0);
            }
        }
        mesh.nodes = nodes;
        mesh.nodes_per_layer = count;
        mesh.rim.clear();
        for (const auto& side : mesh::boundary_sides(mesh.quads)) mesh.rim.push_back({side.from, side.to});
        mesh.wall_patch.assign(mesh.rim.size() * 5, 2);
        return mesh;
    };
    const double diagonal = std::sqrt(3.0);
    for (const double width : {0.0, 1e-12, 0.9e-9 * diagonal})
        CHECK(code_of(slit(width)) == "quality.coincident_nodes");
    for (const double width : {1.1e-9 * diagonal, 1e-7, 1e-3}) CHECK(code_of(slit(width)).empty());
    // Levels between which there is no room along a line are searched all at once.
    for (const double width : {0.0, 1e-3}) {
        auto bent = slit(width);
        for (Vec3& p : bent.nodes) {
            const double angle = 3 * p.z(), radius = 2 + p.y();
            p = {p.x(), radius * std::cos(angle), radius * std::sin(angle)};
        }
        CHECK(code_of(bent) == (width > 0 ? "" : "quality.coincident_nodes"));
    }
    const auto listed = slit(0);
    CHECK(code_of(test::prove_cells(listed.nodes, test::all_hexes(listed))) == "quality.coincident_nodes");
}

TEST_CASE("a cell that is invalid between valid corners is refused")
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-0.5, 0.5);
    int refused = 0;
    for (int trial = 0; trial < 20000 && refused < 5; ++trial) {
        const auto mesh = test::block(
            {.columns = 1, .rows = 1, .layers = 1, .map = [&](const Vec3& p) -> Vec3 {
                 return p + Vec3(shift(random), shift(random), shift(random));
             }});
        const auto quality = quality::measure(mesh);
        if (quality.inverted > 0 || quality.uncertified == 0) continue;
        ++refused;
        CHECK(code_of(mesh) == "quality.not_certified");
    }
    CHECK(refused == 5);
}

TEST_CASE("a refusal names the worst cells, their layer and their place")
{
    auto mesh = test::block({.columns = 3, .rows = 3, .layers = 3});
    mesh.nodes[16 + 5].z() += 0.7; // inner node of the second level
    const quality::Proof proof = quality::prove(mesh);
    REQUIRE(proof.finding);
    const Message& message = proof.finding->message;
    CHECK(message.code() == "quality.inverted");
    CHECK(message.text().find("(layer 2 of 3, at ") != std::string::npos);
    CHECK(message.found() == std::vector<MessageValue>{static_cast<long long>(proof.quality.inverted)});
    for (const NamedEntity& cell : message.entities()) {
        CHECK(cell.kind == "cell");
        CHECK((cell.tag - 1) / 9 == 1);
    }
    const auto inverted = [](const quality::WorstCell& cell) { return cell.scaled_jacobian <= 0; };
    CHECK(static_cast<std::ptrdiff_t>(message.entities().size()) ==
          std::ranges::count_if(proof.quality.worst, inverted));
}

TEST_CASE("a refusal names as many cells as there are columns with bad ones, ten at most")
{
    for (const Index moved : {1, 2, 5}) { // columns of four cells round each node
        auto mesh = test::block({.columns = 10, .rows = 3, .layers = 20});
        for (std::size_t n = 44; n < mesh.nodes.size() - 44; ++n) { // of inner levels, every second one
            const Vec3 at = mesh.nodes[n] - Vec3(0.1, 1. / 3, 0);
            const double column = std::round(5 * at.x());
            if (std::abs(at.y()) < 0.1 && std::abs(5 * at.x() - column) < 0.1 && column < moved &&
                n / 44 % 2 != 0)
                mesh.nodes[n].z() += 1.7;
        }
        const quality::Proof proof = quality::prove(mesh);
        REQUIRE(proof.finding);
        std::set<std::size_t> columns;
        const Message& message = proof.finding->message;
        for (const NamedEntity& cell : message.entities())
            columns.insert(static_cast<std::size_t>(cell.tag - 1) % mesh.quads.size());
        CHECK(columns.size() == std::min<std::size_t>(10, 4 * index(moved)));
        CHECK(message.entities().size() == columns.size());
        CHECK(message.text().size() <= 300);
    }
}

TEST_CASE("a finding becomes an error of the same code and words where it is required that there is none")
{
    auto mesh = test::block({});
    CHECK_NOTHROW(quality::require(quality::prove(mesh)));
    mesh.nodes[21].z() += 0.7;
    const quality::Proof proof = quality::prove(mesh);
    REQUIRE(proof.finding);
    CHECK(quality::can_be_improved(proof.finding->fault));
    CHECK(proof.quality.inverted > 0);
    try {
        quality::require(proof);
        FAIL("a finding was let pass");
    } catch (const NotSweepable& error) {
        CHECK(error.code() == "quality.inverted");
        CHECK(error.what() == proof.finding->message.text());
        CHECK(error.message().entities() == proof.finding->message.entities());
    }
    CHECK_FALSE(quality::can_be_improved(quality::Fault::not_conformal));
    CHECK(quality::fault_code(quality::Fault::empty) == "quality.empty");
    CHECK(quality::fault_code(quality::Fault::below_limit) == "quality.below_limit");
}

TEST_CASE("what is wrong with a list of cells is found and called by its name")
{
    const auto mesh = test::block({});
    auto nodes = mesh.nodes;
    auto hexes = test::all_hexes(mesh);
    auto skin = all_skin(mesh);
    const auto code = [&] { return code_of(test::prove_cells(nodes, hexes, skin)); };
    REQUIRE(code().empty());

    SUBCASE("no cells")
    {
        hexes.clear();
        CHECK(code() == "quality.empty");
    }
    SUBCASE("a corner out of range")
    {
        hexes[5][1] = 64;
        CHECK(code() == "quality.unknown_node");
    }
    SUBCASE("a node of no cell")
    {
        nodes.push_back(Vec3(5, 5, 5));
        CHECK(code() == "quality.unused_node");
    }
    SUBCASE("a cell twice")
    {
        hexes.push_back(hexes[4]);
        CHECK(code() == "quality.not_conformal");
    }
    SUBCASE("a skin quad missing, doubled, or inside")
    {
        auto whole = skin;
        skin.pop_back();
        CHECK(code() == "quality.skin_differs");
        skin = whole;
        skin.push_back(skin[2]);
        CHECK(code() == "quality.skin_differs");
        skin = whole;
        skin.push_back({hexes[0][4], hexes[0][5], hexes[0][6], hexes[0][7]});
        CHECK(code() == "quality.skin_differs");
    }
    SUBCASE("cells that touch along an edge alone")
    {
        const auto pinched = test::block(
            {.columns = 2, .rows = 2, .leave_out = [](int i, int j) { return i == j; }});
        CHECK(code_of(test::prove_cells(pinched.nodes, test::all_hexes(pinched))) == "quality.open_skin");
    }
    SUBCASE("a hanging node")
    {
        // A cell on top of another, its upper neighbour's bottom cut off from the rest.
        const Hex moved = hexes[9];
        for (std::size_t i = 0; i < 4; ++i) {
            nodes.push_back(nodes[static_cast<std::size_t>(moved[i])]);
            hexes[9][i] = static_cast<Index>(nodes.size() - 1);
        }
        CHECK_FALSE(code().empty());
    }
    SUBCASE("a node that is not finite")
    {
        nodes[3].y() = std::numeric_limits<double>::infinity();
        CHECK(code() == "quality.inverted");
    }
}
