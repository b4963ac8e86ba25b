// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/geometry/shared/union_find.h>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include <algorithm>
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

TEST_CASE("a polygon that shares a vertex, a side or all vertices with another is inside it or beside it")
{
    const std::vector<Vec2> box{{0, 0}, {4, 0}, {4, 2}, {4, 3}, {0, 3}, {0, 1}};
    const std::vector<std::vector<Vec2>> inside{{{0, 0}, {1, 1}, {0, 1}},           // on a vertex and a side
                                                {{0, 0}, {4, 2}, {0, 3}},           // all vertices on the rim
                                                {{1, 1}, {2, 1}, {2, 2}}};          // clear of the rim
    const std::vector<std::vector<Vec2>> beside{{{4, 0}, {5, 0}, {5, 2}, {4, 2}},   // shares a side
                                                {{0, 3}, {0, 4}, {-1, 4}},          // shares a vertex
                                                {{-1, 0}, {0, 0}, {0, 3}, {-1, 3}}, // along two sides
                                                {{-1, -1}, {5, -1}, {5, 4}, {-1, 4}}}; // around it
    for (int turn = 0; turn < 36; ++turn) {
        const auto turned = [&](std::vector<Vec2> polygon) {
            for (Vec2& p : polygon) p = Eigen::Rotation2Dd(turn * 0.1) * p;
            if (turn % 2 != 0) std::ranges::reverse(polygon);
            return polygon;
        };
        CAPTURE(turn);
        for (const auto& polygon : inside) CHECK(geometry::encloses(turned(box), turned(polygon)));
        for (const auto& polygon : beside) CHECK_FALSE(geometry::encloses(turned(box), turned(polygon)));
    }
}
