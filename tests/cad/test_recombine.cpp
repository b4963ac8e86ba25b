// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/whole_families.h"

#include <lacuna/cad/load.h>
#include <lacuna/core/error.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>

using namespace lacuna;

namespace {

struct Region {
    std::string name;
    quads::PlanarRegion region;
};

void add_loop(quads::PlanarRegion& region, const std::vector<Vec2>& points)
{
    std::vector<Index> loop;
    for (const Vec2& p : points) {
        loop.push_back(static_cast<Index>(region.points.size()));
        region.points.push_back(p);
    }
    region.loops.push_back(std::move(loop));
}

/// Points along a closed polygon, `size` apart; one more where their number would be odd.
std::vector<Vec2> along(const std::vector<Vec2>& corners, double size)
{
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2& a = corners[i];
        const Vec2& b = corners[(i + 1) % corners.size()];
        const int sides = std::max(1, static_cast<int>(std::lround((b - a).norm() / size)));
        for (int k = 0; k < sides; ++k) points.push_back(a + (b - a) * k / sides);
    }
    if (points.size() % 2 != 0) points.insert(points.begin() + 1, (points[0] + points[1]) / 2);
    return points;
}

std::vector<Vec2> circle(const Vec2& centre, double radius, int sides, bool clockwise = false)
{
    std::vector<Vec2> points;
    for (int i = 0; i < sides; ++i) {
        const double a = (clockwise ? -2 : 2) * std::numbers::pi * i / sides;
        points.push_back(centre + radius * Vec2(std::cos(a), std::sin(a)));
    }
    return points;
}

/// Round, cornered, pierced, toothed, at every number of quads asked for; also with two odd holes.
std::vector<Region> regions(double quads)
{
    std::vector<Region> all;
    const auto add = [&](const char* name, double area, auto&& build) {
        Region r;
        r.name = name;
        const double size = std::sqrt(area / quads);
        build(r.region, size);
        r.region.size = [size](const Vec2&) { return size; };
        all.push_back(std::move(r));
    };
    add("disc", std::numbers::pi, [](auto& r, double h) {
        add_loop(r, circle({0, 0}, 1, 2 * std::max(3, int(std::numbers::pi / h))));
    });
    add("L", 3, [](auto& r, double h) {
        add_loop(r, along({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, h));
    });
    add("plate", 7.4, [](auto& r, double h) {
        add_loop(r, along({{0, 0}, {4, 0}, {4, 2}, {0, 2}}, h));
        for (const double x : {1.0, 3.0}) add_loop(r, circle({x, 1}, 0.3, 2 * std::max(3, int(1 / h)), true));
    });
    add("plate with odd holes", 7.4, [](auto& r, double h) {
        add_loop(r, along({{0, 0}, {4, 0}, {4, 2}, {0, 2}}, h));
        for (const double x : {1.0, 3.0})
            add_loop(r, circle({x, 1}, 0.3, 2 * std::max(3, int(1 / h)) + 1, true));
    });
    add("comb", 15, [](auto& r, double h) {
        add_loop(r, along({{0, 0},
                           {5, 0},
                           {5, 4},
                           {4, 4},
                           {4, 1},
                           {3, 1},
                           {3, 4},
                           {2, 4},
                           {2, 1},
                           {1, 1},
                           {1, 4},
                           {0, 4}},
                          h));
    });
    return all;
}

double worst_corner(const quads::PlanarQuads& mesh)
{
    double worst = 1;
    for (const Quad& q : mesh.quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec2& here = mesh.points[std::size_t(q[k])];
            const Vec2 u = (mesh.points[std::size_t(q[(k + 1) % 4])] - here).normalized();
            const Vec2 v = (mesh.points[std::size_t(q[(k + 3) % 4])] - here).normalized();
            worst = std::min(worst, u.x() * v.y() - u.y() * v.x());
        }
    }
    return worst;
}

/// Given nodes bit for bit, boundary sides those of the loops, areas positive and adding up.
void check_quads(const quads::PlanarRegion& region, const quads::PlanarQuads& mesh)
{
    REQUIRE(mesh.points.size() >= region.points.size());
    for (std::size_t p = 0; p < region.points.size(); ++p) CHECK(mesh.points[p] == region.points[p]);

    std::map<std::pair<Index, Index>, int> sides;
    double area = 0;
    for (const Quad& q : mesh.quads) {
        double own = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec2& a = mesh.points[std::size_t(q[k])];
            const Vec2& b = mesh.points[std::size_t(q[(k + 1) % 4])];
            own += (a.x() * b.y() - a.y() * b.x()) / 2;
            ++sides[{q[k], q[(k + 1) % 4]}];
        }
        CHECK(own > 0);
        area += own;
    }
    double expected = 0;
    std::size_t border = 0;
    for (const std::vector<Index>& loop : region.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::pair<Index, Index> side{loop[i], loop[(i + 1) % loop.size()]};
            CHECK(sides.count(side) == 1);
            CHECK(sides.count({side.second, side.first}) == 0);
            const Vec2& a = region.points[std::size_t(side.first)];
            const Vec2& b = region.points[std::size_t(side.second)];
            expected += (a.x() * b.y() - a.y() * b.x()) / 2;
            ++border;
        }
    }
    std::size_t found = 0;
    for (const auto& [side, count] : sides) {
        CHECK(count == 1);
        found += sides.count({side.second, side.first}) == 0 ? 1 : 0;
    }
    CHECK(found == border);
    CHECK(area == doctest::Approx(expected));
}

} // namespace

TEST_CASE(
    "Gmsh fills regions with convex quads, their boundary kept, or is refused by the triangles it leaves")
{
    int filled = 0, tried = 0;
    for (const double quads : {100.0, 700.0, 3000.0}) {
        if (quads > 700 && !test::whole_families()) continue;
        for (const Region& r : regions(quads)) {
            CAPTURE(r.name);
            CAPTURE(quads);
            ++tried;
            quads::PlanarQuads mesh;
            try {
                mesh = cad::recombine(r.region);
            } catch (const NotSweepable& error) {
                CHECK(std::string(error.what()).find("triangles") != std::string::npos);
                continue;
            }
            ++filled;
            check_quads(r.region, mesh);
            CHECK(worst_corner(mesh) > 0);
            CHECK(double(mesh.quads.size()) > 0.5 * quads);
            CHECK(double(mesh.quads.size()) < 2.5 * quads);
        }
    }
    CHECK(3 * filled >= 2 * tried);
}

TEST_CASE("a region far away, tiny or turned gets the same number of quads")
{
    const quads::PlanarRegion plain = regions(200)[2].region;
    const std::size_t count = cad::recombine(plain).quads.size();
    for (const double scale : {1e-6, 1e5}) {
        quads::PlanarRegion moved = plain;
        for (Vec2& p : moved.points) p = scale * (p + Vec2(7, -3));
        moved.size = [&](const Vec2& p) { return scale * plain.size(p / scale - Vec2(7, -3)); };
        const quads::PlanarQuads mesh = cad::recombine(moved);
        check_quads(moved, mesh);
        CHECK(double(mesh.quads.size()) == doctest::Approx(double(count)).epsilon(0.05));
    }
}

TEST_CASE("the smallest regions are filled")
{
    for (const int sides : {4, 6, 8, 10}) {
        CAPTURE(sides);
        quads::PlanarRegion region;
        add_loop(region, circle({0, 0}, 1, sides));
        const quads::PlanarQuads mesh = cad::recombine(region);
        check_quads(region, mesh);
        CHECK(worst_corner(mesh) > 0);
    }
}

TEST_CASE("random wavy regions with uneven spacing are filled")
{
    std::mt19937 dice(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    test::MembersToRun run(5); // three of twelve
    for (int trial = 0; trial < 12; ++trial) {
        if (!run.next()) continue;
        CAPTURE(trial);
        quads::PlanarRegion region;
        const int sides = 2 * (10 + trial * 5);
        const double wave = 0.25 * uniform(dice);
        std::vector<Vec2> rim;
        for (int i = 0; i < sides; ++i) {
            const double a = 2 * std::numbers::pi * (i + 0.4 * uniform(dice)) / sides;
            rim.push_back((1 + wave * std::sin(5 * a)) * Vec2(std::cos(a), std::sin(a)));
        }
        add_loop(region, rim);
        if (trial % 3 == 0) add_loop(region, circle({0.1, 0}, 0.3, 2 * (4 + trial), true));
        const double size = 6.0 / sides;
        region.size = [size](const Vec2& p) { return size * (1 + p.x() / 2); };
        const quads::PlanarQuads mesh = cad::recombine(region);
        check_quads(region, mesh);
        CHECK(worst_corner(mesh) > 0);
    }
}

TEST_CASE("an odd number of boundary sides is refused, an error of the size function handed on")
{
    quads::PlanarRegion odd;
    add_loop(odd, circle({0, 0}, 1, 7));
    CHECK_THROWS_AS(cad::recombine(odd), NotSweepable);
    quads::PlanarRegion region;
    add_loop(region, circle({0, 0}, 1, 8));
    region.size = [](const Vec2&) -> double { throw InvalidInput("test.size", "no size here"); };
    CHECK_THROWS_AS(cad::recombine(region), InvalidInput);
}

TEST_CASE("a region whose loops cross or touch is refused and ends no process")
{
    const auto refused = [](const quads::PlanarRegion& region) {
        try {
            cad::recombine(region);
        } catch (const Error& error) {
            return error.code();
        }
        return std::string("done");
    };
    quads::PlanarRegion bow_tie, out_and_back, touching;
    add_loop(bow_tie, {{0, 0}, {2, 2}, {2, 0}, {0, 2}});
    // Up a seam and down again, as the border of a dome was once handed over.
    add_loop(out_and_back, circle({0, 0}, 1, 20));
    const Index first = out_and_back.loops[0][0];
    out_and_back.points.emplace_back(0.5, 1e-5);
    out_and_back.points.emplace_back(0, 0);
    out_and_back.points.emplace_back(0.5, -1e-5);
    out_and_back.points.push_back(out_and_back.points[std::size_t(first)]);
    for (Index p = 20; p < 24; ++p)
        out_and_back.loops[0].insert(out_and_back.loops[0].begin() + 1 + p - 20, p);
    add_loop(touching, along({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 1));
    add_loop(touching, {{1, 1}, {1, 3}, {4, 2}, {3, 1}});
    for (const auto& region : {bow_tie, out_and_back, touching}) {
        CHECK(refused(region) == "surface.pave_loops");
        quads::PlanarRegion good;
        add_loop(good, circle({0, 0}, 1, 12));
        CHECK(refused(good) == "done");
    }
}

TEST_CASE("the same region gives the same quads")
{
    for (const Region& r : regions(400)) {
        CAPTURE(r.name);
        const quads::PlanarQuads a = cad::recombine(r.region);
        const quads::PlanarQuads b = cad::recombine(r.region);
        CHECK(a.points == b.points);
        CHECK(a.quads == b.quads);
    }
}
