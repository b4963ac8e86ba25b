// SPDX-License-Identifier: MIT
#include "support/blocks.h"

#include <lacuna/mesh/quad_mesh.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

using namespace lacuna;

namespace {

std::array<Index, 2> ends(const std::vector<Quad>& quads, std::size_t side)
{
    return {quads[side / 4][side % 4], quads[side / 4][(side + 1) % 4]};
}

} // namespace

TEST_CASE(
    "partners of sides are each other's, run the same two nodes the other way, and the rest is the boundary")
{
    for (unsigned seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        const auto mesh = test::block(
            {.columns = 6, .rows = 5, .leave_out = [&](int, int) { return random() % 5 == 0; }});
        const std::vector<Index> opposite = mesh::opposite_sides(mesh.quads, mesh.nodes_per_layer);
        REQUIRE(opposite.size() == 4 * mesh.quads.size());
        std::set<std::array<Index, 2>> lone;
        for (std::size_t side = 0; side < opposite.size(); ++side) {
            if (opposite[side] < 0) {
                CHECK(opposite[side] == mesh::kRimSide);
                lone.insert(ends(mesh.quads, side));
                continue;
            }
            const auto other = static_cast<std::size_t>(opposite[side]);
            CHECK(opposite[other] == static_cast<Index>(side));
            CHECK(ends(mesh.quads, other)[0] == ends(mesh.quads, side)[1]);
            CHECK(ends(mesh.quads, other)[1] == ends(mesh.quads, side)[0]);
        }
        std::map<std::set<Index>, int> uses;
        for (std::size_t side = 0; side < opposite.size(); ++side) {
            const auto nodes = ends(mesh.quads, side);
            ++uses[{nodes[0], nodes[1]}];
        }
        std::set<std::array<Index, 2>> boundary;
        for (const mesh::BoundarySide& side : mesh::boundary_sides(mesh.quads)) {
            boundary.insert({side.from, side.to});
            CHECK(uses[{side.from, side.to}] == 1);
        }
        CHECK(boundary.size() == std::size_t(std::count_if(uses.begin(), uses.end(),
                                                           [](const auto& use) { return use.second == 1; })));
        CHECK(lone == boundary);
    }
}

TEST_CASE("a side of three quads, or run twice the same way, has no partner and is called bad")
{
    const std::vector<Quad> three{{0, 1, 2, 3}, {1, 0, 4, 5}, {1, 0, 6, 7}};
    const auto fan = mesh::opposite_sides(three, 8);
    CHECK(fan[0] == mesh::kBadSide);
    CHECK(fan[4] == mesh::kBadSide);
    CHECK(fan[8] == mesh::kBadSide);
    CHECK(fan[1] == mesh::kRimSide);

    const std::vector<Quad> same_way{{0, 1, 2, 3}, {0, 1, 4, 5}};
    const auto twice = mesh::opposite_sides(same_way, 6);
    CHECK(twice[0] == mesh::kBadSide);
    CHECK(twice[4] == mesh::kBadSide);
}
