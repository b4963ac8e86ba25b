// SPDX-License-Identifier: MIT
#include "support/dice.h"

#include <lacuna/core/shared/edge_key.h>
#include <lacuna/surface/detail/quad_path.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

using namespace lacuna;
using namespace lacuna::surface;

namespace {

/// A grid of quads in the unit square. Each quad starts at a random corner.
struct Grid {
    std::vector<Vec2> place;
    std::vector<Quad> quads;
    std::set<std::uint64_t> sides;
};

/// @param hole  cells from `columns / 3` to `columns - columns / 3`, likewise in rows, are left out
Grid grid(int columns, int rows, test::Dice& dice, bool hole)
{
    Grid grid;
    for (int b = 0; b <= rows; ++b)
        for (int a = 0; a <= columns; ++a)
            grid.place.emplace_back(static_cast<double>(a) / columns, static_cast<double>(b) / rows);
    for (int b = 0; b < rows; ++b)
        for (int a = 0; a < columns; ++a) {
            const bool left_out = a >= columns / 3 && a < columns - columns / 3 && b >= rows / 3 &&
                                  b < rows - rows / 3;
            if (hole && left_out) continue;
            const Index low = b * (columns + 1) + a, high = low + columns + 1;
            Quad quad{low, low + 1, high + 1, high};
            std::ranges::rotate(quad, quad.begin() + dice.whole(0, 3));
            for (std::size_t k = 0; k < 4; ++k) grid.sides.insert(edge_key(quad[k], quad[(k + 1) % 4]));
            grid.quads.push_back(quad);
        }
    return grid;
}

std::vector<Vec2> circle(const Vec2& middle, double radius, int count, double start, bool clockwise)
{
    std::vector<Vec2> line;
    for (int k = 0; k < count; ++k) {
        const double angle = start + (clockwise ? -2 : 2) * std::numbers::pi * k / count;
        line.emplace_back(middle + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return line;
}

} // namespace

TEST_CASE("a path around a circle runs along sides of quads, beside the circle and in its direction")
{
    test::Dice dice(17);
    for (int run = 0; run < 200; ++run) {
        const int sides = dice.whole(10, 24);
        const Grid mesh = grid(sides, dice.whole(10, 24), dice, false);
        const int count = 2 * dice.whole(4, 8);
        const double radius = dice.between(0.6, 1.2) * count / (8. * sides);
        const Vec2 middle(dice.between(0.35, 0.65), dice.between(0.35, 0.65));
        const bool clockwise = dice.chance(0.5);
        const std::vector<Vec2> line = circle(middle, radius, count, dice.between(0, 6), clockwise);
        const std::vector<Index> path = path_around(mesh.quads, mesh.place, line);
        REQUIRE(path.size() == line.size());
        CHECK(std::set<Index>(path.begin(), path.end()).size() == path.size());
        double twice = 0, furthest = 0;
        for (std::size_t k = 0; k < path.size(); ++k) {
            const Index next = path[(k + 1) % path.size()];
            CHECK(mesh.sides.contains(edge_key(path[k], next)));
            const Vec2 &a = mesh.place[static_cast<std::size_t>(path[k])],
                       &b = mesh.place[static_cast<std::size_t>(next)];
            twice += a.x() * b.y() - a.y() * b.x();
            furthest = std::max(furthest, (a - line[k]).norm());
        }
        CHECK((twice < 0) == clockwise);
        CHECK(furthest < radius + 0.25);
    }
}

TEST_CASE("a path may go around a hole of the mesh")
{
    test::Dice dice(18);
    const Grid mesh = grid(12, 12, dice, true);
    const std::vector<Vec2> line = circle({0.5, 0.5}, 0.33, 24, 0, false);
    const std::vector<Index> path = path_around(mesh.quads, mesh.place, line);
    REQUIRE(path.size() == 24);
    for (const Index node : path) {
        const Vec2 off = mesh.place[static_cast<std::size_t>(node)] - Vec2(0.5, 0.5);
        CHECK(off.cwiseAbs().maxCoeff() == doctest::Approx(0.25));
    }
}

TEST_CASE("no path has an odd number of nodes, or more than fit inside the mesh")
{
    test::Dice dice(19);
    const Grid mesh = grid(5, 5, dice, false);
    CHECK(path_around(mesh.quads, mesh.place, circle({0.5, 0.5}, 0.2, 9, 0, false)).empty());
    CHECK(path_around(mesh.quads, mesh.place, circle({0.5, 0.5}, 0.2, 16, 0, false)).empty());
    CHECK(path_around(mesh.quads, mesh.place, circle({0.5, 0.5}, 0.2, 12, 0, false)).size() == 12);
}
