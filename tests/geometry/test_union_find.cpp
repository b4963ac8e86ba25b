// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/geometry/shared/union_find.h>

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace lacuna;
using geometry::lies_inside;
using geometry::UnionFind;

TEST_CASE("unite keeps the root of the first set, and says whether the two were apart")
{
    UnionFind sets(5);
    CHECK(sets.unite(std::size_t{3}, std::size_t{1}));
    CHECK(sets.unite(std::size_t{4}, std::size_t{3}));
    CHECK_FALSE(sets.unite(std::size_t{1}, std::size_t{4}));
    CHECK(sets.find(std::size_t{1}) == 4);
    CHECK(sets.find(std::size_t{3}) == 4);
    CHECK(sets.find(std::size_t{0}) == 0);
}

TEST_CASE("unite_least leaves the least member of every set as its root")
{
    UnionFind sets(100);
    for (std::size_t i = 99; i >= 3; --i) sets.unite_least(i, i - 3);
    for (std::size_t i = 0; i < 100; ++i) CHECK(sets.find(i) == i % 3);
}

TEST_CASE("a point a rounding error to either side of a polygon's side is told apart")
{
    // The side from (0, 0) to (3, 1) passes no double at y = 1/3 - ulp exactly: the sign is exact
    // arithmetic's.
    const std::vector<Vec2> triangle{{0, 0}, {3, 1}, {0, 1}};
    const double x = 1.5, y = 0.5;
    CHECK(lies_inside(triangle, Vec2(std::nextafter(x, 0.0), y)));
    CHECK_FALSE(lies_inside(triangle, Vec2(std::nextafter(x, 3.0), y)));
}

TEST_CASE("a ray through a corner counts it once, in either direction of the polygon")
{
    std::vector<Vec2> kite{{0, 0}, {2, 0}, {1, 1}, {3, 1}, {2, 2}, {0, 2}};
    for (int turn = 0; turn < 2; ++turn) {
        CHECK(lies_inside(kite, Vec2(0.5, 1)));
        CHECK_FALSE(lies_inside(kite, Vec2(-0.5, 1)));
        CHECK_FALSE(lies_inside(kite, Vec2(-0.5, 0)));
        CHECK_FALSE(lies_inside(kite, Vec2(3.5, 1)));
        kite = {kite.rbegin(), kite.rend()};
    }
}
