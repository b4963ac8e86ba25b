// SPDX-License-Identifier: MIT
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/quads/shared/pave.h>
#include <lacuna/quads/shared/submap.h>

#include <doctest/doctest.h>

#include <numbers>
#include <random>

using namespace lacuna;
using quads::PlanarRegion;

namespace {

/// A loop through corners, with nodes at whole steps of 1 along its axis-parallel sides.
std::vector<Vec2> stepped(const std::vector<Vec2>& corners)
{
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
        const auto steps = static_cast<int>(std::lround((b - a).norm()));
        for (int k = 0; k < steps; ++k) points.push_back(a + (b - a) * k / steps);
    }
    return points;
}

PlanarRegion plain_region(const std::vector<std::vector<Vec2>>& loops)
{
    PlanarRegion region;
    for (const auto& loop : loops) {
        region.loops.emplace_back();
        for (const Vec2& p : loop) {
            region.loops.back().push_back(static_cast<Index>(region.points.size()));
            region.points.push_back(p);
        }
    }
    return region;
}

/// A staircase up and down from a seed: columns of whole widths and heights.
std::vector<Vec2> skyline(unsigned seed, double& area)
{
    std::mt19937 dice(seed);
    const auto roll = [&](int most) { return 1 + static_cast<int>(dice() % static_cast<unsigned>(most)); };
    std::vector<Vec2> corners{{0, 0}};
    std::vector<std::array<int, 2>> columns;
    int width = 0;
    for (int c = 0, n = roll(5); c < n; ++c) {
        int height = 2 + roll(6);
        if (!columns.empty() && columns.back()[1] == height) ++height;
        columns.push_back({1 + roll(4), height});
        width += columns.back()[0];
    }
    corners.emplace_back(width, 0);
    area = 0;
    int x = width;
    for (std::size_t c = columns.size(); c-- > 0;) {
        corners.emplace_back(x, columns[c][1]);
        x -= columns[c][0];
        corners.emplace_back(x, columns[c][1]);
        area += columns[c][0] * columns[c][1];
    }
    return corners;
}

std::size_t irregular(const quads::PlanarQuads& mesh, const PlanarRegion& region)
{
    return quads::measure_plane(mesh, region).irregular;
}

} // namespace

TEST_CASE("a polygon of squares is filled with those squares, whichever way it is turned")
{
    for (unsigned seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        double area = 0;
        std::vector<Vec2> outline = stepped(skyline(seed, area));
        const double angle = 0.37 * seed;
        for (Vec2& p : outline) p = Eigen::Rotation2Dd(angle) * p;
        // Any node may be the first.
        std::rotate(outline.begin(), outline.begin() + seed % static_cast<unsigned>(outline.size()),
                    outline.end());
        const PlanarRegion region = plain_region({outline});
        const auto mesh = quads::submap(region);
        REQUIRE(mesh.has_value());
        CHECK(static_cast<double>(mesh->quads.size()) == area);
        CHECK(irregular(*mesh, region) == 0);
        CHECK(quads::find_fault(*mesh, region).empty());
        CHECK(quads::measure_plane(*mesh, region).min_scaled_jacobian > 0.999);
        CHECK(quads::pave(region).mesh.how == mesh->how);
    }
}

TEST_CASE("holes of right angles find their place in the grid, bent as the region may be")
{
    for (const double bend : {0.0, 0.02, 0.03}) {
        CAPTURE(bend);
        const std::vector<Vec2> outer = stepped({{0, 0}, {14, 0}, {14, 9}, {0, 9}});
        std::vector<std::vector<Vec2>> loops{outer, stepped({{2, 3}, {2, 6}, {5, 6}, {5, 3}}),
                                             stepped({{8, 2}, {8, 7}, {12, 7}, {12, 4}, {10, 4}, {10, 2}})};
        for (auto& loop : loops) {
            for (Vec2& p : loop)
                p = Vec2(p.x() + bend * p.y() * p.y(), p.y() + bend * p.x() * (14 - p.x()) / 4);
        }
        const PlanarRegion region = plain_region(loops);
        const auto mesh = quads::submap(region);
        REQUIRE(mesh.has_value());
        CHECK(mesh->quads.size() == 14 * 9 - 9 - (5 * 4 - 2 * 2));
        CHECK(mesh->how == "submapped");
        CHECK(irregular(*mesh, region) == 0);
        CHECK(quads::find_fault(*mesh, region).empty());
        CHECK(quads::measure_plane(*mesh, region).min_scaled_jacobian > 0.6);
    }
}

TEST_CASE("what is no polygon of squares is not submapped")
{
    std::vector<Vec2> disc;
    for (int i = 0; i < 32; ++i)
        disc.emplace_back(std::cos(i * std::numbers::pi / 16), std::sin(i * std::numbers::pi / 16));
    CHECK(!quads::submap(plain_region({disc})));
    // A hole that is round; counts that do not close; a hole outside.
    std::vector<Vec2> hole;
    for (int i = 0; i < 12; ++i)
        hole.emplace_back(5 + std::cos(-i * std::numbers::pi / 6), 4 + std::sin(-i * std::numbers::pi / 6));
    CHECK(!quads::submap(plain_region({stepped({{0, 0}, {10, 0}, {10, 8}, {0, 8}}), hole})));
    std::vector<Vec2> more = stepped({{0, 0}, {10, 0}, {10, 8}, {0, 8}});
    more.insert(more.begin() + 1, Vec2(0.5, 0));
    CHECK(!quads::submap(plain_region({more})));
    CHECK(!quads::submap(plain_region(
        {stepped({{0, 0}, {4, 0}, {4, 4}, {0, 4}}), stepped({{6, 1}, {6, 3}, {8, 3}, {8, 1}})})));
    // But a notch one square wide is a grid's.
    const std::vector<Vec2> slit = stepped({{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 4}, {4, 4}, {4, 3}, {0, 3}});
    CHECK(quads::submap(plain_region({slit})).has_value());
}
