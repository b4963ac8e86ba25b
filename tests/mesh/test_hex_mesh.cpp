// SPDX-License-Identifier: MIT
#include "support/blocks.h"
#include "support/check_valid.h"

#include <lacuna/mesh/hex_mesh.h>

#include <doctest/doctest.h>

#include <cmath>

using namespace lacuna;

namespace {

Vec3 wavy(const Vec3& p)
{
    return {p.x() + 0.1 * std::sin(3 * p.y() + p.z()), p.y() + 0.1 * std::sin(3 * p.x() - p.z()),
            p.z() + 0.1 * p.x() * p.y()};
}

} // namespace

TEST_CASE("blocks of any size, with and without holes, are valid by the plainest check")
{
    for (const int layers : {1, 2, 5}) {
        CAPTURE(layers);
        test::check_valid(test::block({.columns = 4, .rows = 3, .layers = layers, .map = wavy}));
        test::check_valid(test::block({.columns = 1, .rows = 1, .layers = layers}));
        test::check_valid(test::block(
            {.columns = 5, .rows = 5, .layers = layers, .map = wavy, .leave_out = [](int i, int j) {
                 return i == 2 && j == 2;
             }}));
        test::check_valid(test::ring(12, layers));
    }
}

TEST_CASE("hex and skin counts follow from quads, rim and layers")
{
    for (const int layers : {1, 3, 7}) {
        const auto mesh = test::block({.columns = 4, .rows = 2, .layers = layers});
        CHECK(mesh.hex_count() == std::size_t(8 * layers));
        CHECK(mesh.skin_count() == std::size_t(16 + 12 * layers));
    }
}

TEST_CASE("the plain check sees what is done to a mesh")
{
    const auto good = test::block({});
    REQUIRE(test::faults(good).empty());

    SUBCASE("a node moved through its cell")
    {
        auto mesh = good;
        mesh.nodes[5] += Vec3(0, 0, 1);
        CHECK_FALSE(test::faults(mesh).empty());
    }
    SUBCASE("a quad turned over")
    {
        auto mesh = good;
        std::swap(mesh.quads[4][1], mesh.quads[4][3]);
        CHECK_FALSE(test::faults(mesh).empty());
    }
    SUBCASE("a rim side missing")
    {
        auto mesh = good;
        mesh.rim.pop_back();
        mesh.wall_patch.resize(mesh.rim.size() * 3);
        CHECK_FALSE(test::faults(mesh).empty());
    }
    SUBCASE("a rim side run the wrong way")
    {
        auto mesh = good;
        std::swap(mesh.rim[0][0], mesh.rim[0][1]);
        CHECK_FALSE(test::faults(mesh).empty());
    }
    SUBCASE("a cell without a patch")
    {
        auto mesh = good;
        mesh.wall_patch[1] = -1;
        CHECK_FALSE(test::faults(mesh).empty());
    }
    SUBCASE("two parts that touch along a column of nodes alone")
    {
        CHECK_FALSE(
            test::faults(
                test::block({.columns = 2, .rows = 2, .leave_out = [](int i, int j) { return i == j; }}))
                .empty());
    }
}
