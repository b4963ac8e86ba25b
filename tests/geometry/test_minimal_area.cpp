// SPDX-License-Identifier: MIT
#include "support/cancelling.h"

#include <lacuna/core/error.h>
#include <lacuna/geometry/angle.h>
#include <lacuna/geometry/minimal_area.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>

using namespace lacuna;
using namespace lacuna::geometry;

namespace {

struct Outline {
    std::vector<Vec3> points;
    std::vector<std::vector<Index>> loops;
};

const Vec3& at(const std::vector<Vec3>& points, Index i) { return points[static_cast<std::size_t>(i)]; }

template <class Curve>
void add_loop(Outline& outline, int count, const Curve& curve, bool backward = false)
{
    std::vector<Index> loop;
    for (int i = 0; i < count; ++i) {
        loop.push_back(static_cast<Index>(outline.points.size()));
        outline.points.push_back(curve(2 * std::numbers::pi * i / count));
    }
    if (backward) std::reverse(loop.begin(), loop.end());
    outline.loops.push_back(loop);
}

auto circle(double radius, const Vec3& centre)
{
    return [=](double t) { return Vec3(centre + radius * Vec3(std::cos(t), std::sin(t), 0)); };
}

Vec3 area_vector(const std::vector<Vec3>& points, const Triangle& t)
{
    return (at(points, t[1]) - at(points, t[0])).cross(at(points, t[2]) - at(points, t[0])) / 2;
}

/// A connected manifold whose boundary sides are the loops', once each, as they run.
void check_surface(const Outline& outline, const MinimalArea& surface)
{
    REQUIRE(surface.points.size() >= outline.points.size());
    CHECK(std::equal(outline.points.begin(), outline.points.end(), surface.points.begin()));
    std::set<std::pair<Index, Index>> sides;
    std::set<Index> used;
    double area = 0;
    for (const Triangle& t : surface.triangles) {
        area += area_vector(surface.points, t).norm();
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(sides.insert({t[k], t[(k + 1) % 3]}).second);
            used.insert(t[k]);
        }
    }
    CHECK(surface.area == doctest::Approx(area));
    std::set<std::pair<Index, Index>> wanted, border;
    for (const auto& loop : outline.loops) {
        for (std::size_t k = 0; k < loop.size(); ++k) wanted.insert({loop[k], loop[(k + 1) % loop.size()]});
    }
    for (const auto& [a, b] : sides) {
        if (!sides.count({b, a})) border.insert({a, b});
    }
    CHECK(border == wanted);
    const auto edges = static_cast<long>((sides.size() + border.size()) / 2);
    const long euler = static_cast<long>(used.size()) - edges + static_cast<long>(surface.triangles.size());
    CHECK(euler == 2 - static_cast<long>(outline.loops.size()));
    CHECK(used.size() == surface.points.size());
}

double least_angle(const MinimalArea& surface)
{
    double least = 180;
    for (const Triangle& t : surface.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 u = at(surface.points, t[(k + 1) % 3]) - at(surface.points, t[k]);
            const Vec3 v = at(surface.points, t[(k + 2) % 3]) - at(surface.points, t[k]);
            least = std::min(least, geometry::angle_between(u, v) * 180 / std::numbers::pi);
        }
    }
    return least;
}

double brute_force(const std::vector<Vec3>& points, const std::vector<Index>& chain)
{
    if (chain.size() < 3) return 0;
    double best = std::numeric_limits<double>::max();
    for (std::size_t m = 1; m + 1 < chain.size(); ++m) {
        const std::vector<Index> left(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(m) + 1);
        const std::vector<Index> right(chain.begin() + static_cast<std::ptrdiff_t>(m), chain.end());
        best = std::min(best, area_vector(points, {chain.front(), chain[m], chain.back()}).norm() +
                                  brute_force(points, left) + brute_force(points, right));
    }
    return best;
}

} // namespace

TEST_CASE("without weights the area is the least of all triangulations of the loop")
{
    for (unsigned seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        std::mt19937 dice(seed);
        std::uniform_real_distribution<double> height(-1, 1);
        Outline outline;
        add_loop(
            outline, 4 + static_cast<int>(seed % 6),
            [&](double t) { return Vec3(std::cos(t), std::sin(t), height(dice)); }, seed % 2 == 1);
        const auto surface = minimal_area(outline.points, outline.loops,
                                          {.bend = 0, .shape = 0, .interior_points = false});
        check_surface(outline, surface);
        CHECK(surface.area == doctest::Approx(brute_force(outline.points, outline.loops[0])));
    }
}

TEST_CASE("a plane loop is filled in its plane, however bent its outline and with points in line")
{
    for (const int teeth : {2, 5, 9, 60, 200}) {
        for (const bool interior : {false, true}) {
            CAPTURE(teeth);
            CAPTURE(interior);
            Outline outline;
            outline.loops.emplace_back();
            const Eigen::Quaterniond turn = Eigen::Quaterniond(0.3, 0.5, -0.2, 0.7).normalized();
            const auto add = [&](double x, double y) {
                outline.loops[0].push_back(static_cast<Index>(outline.points.size()));
                outline.points.push_back(turn * Vec3(x, y, 2));
            };
            // A comb: its spine in `2 * teeth` steps in line, tips above.
            for (int i = 0; i < 2 * teeth; ++i) add(0.5 * i, 0);
            add(teeth, 0);
            for (int i = teeth; i > 0; --i) {
                add(i, 3);
                add(i - 0.5, 1);
            }
            add(0, 3);
            const double area = 2.0 * teeth;
            const auto surface = minimal_area(outline.points, outline.loops, {.interior_points = interior});
            check_surface(outline, surface);
            CHECK(surface.area == doctest::Approx(area).epsilon(1e-6));
            const Vec3 up = turn * Vec3(0, 0, 1);
            for (const Triangle& t : surface.triangles) CHECK(area_vector(surface.points, t).dot(up) > 1e-6);
        }
    }
}

TEST_CASE("turning and scaling the loop turns and scales the surface")
{
    Outline outline;
    add_loop(outline, 60,
             [](double t) { return Vec3(2 * std::cos(t), std::sin(t), 0.7 * std::sin(2 * t + 0.3)); });
    const auto plain = minimal_area(outline.points, outline.loops);
    check_surface(outline, plain);
    CHECK(plain.points.size() > outline.points.size() + 20);
    CHECK(least_angle(plain) > 15);
    const Eigen::Quaterniond turn = Eigen::Quaterniond(0.9, 0.5, -0.2, 0.7).normalized();
    for (const double scale : {1e-4, 37.0}) {
        Outline moved = outline;
        for (Vec3& p : moved.points) p = scale * (turn * p) + Vec3(scale, 0, -scale);
        const auto surface = minimal_area(moved.points, moved.loops);
        check_surface(moved, surface);
        CHECK(surface.area == doctest::Approx(scale * scale * plain.area).epsilon(1e-3));
    }
}

TEST_CASE("two rings give the catenoid, which no flat or ruled filling reaches")
{
    const double waist =
        0.8483; // of the catenoid between unit circles at ±0.5: waist · cosh(0.5 / waist) = 1
    const double area = std::numbers::pi * waist * (1 + waist * std::sinh(1 / waist));
    for (const int around : {16, 48}) {
        CAPTURE(around);
        Outline outline;
        add_loop(outline, around, circle(1, {0, 0, -0.5}));
        add_loop(outline, around + 5, circle(1, {0, 0, 0.5}), true);
        const auto surface = minimal_area(outline.points, outline.loops, {.grading = 0});
        check_surface(outline, surface);
        CHECK(surface.area == doctest::Approx(area).epsilon(around == 16 ? 0.06 : 0.01));
        CHECK(least_angle(surface) > 15);
    }
}

TEST_CASE("several loops are joined to one manifold, whatever their number and points")
{
    for (const int holes : {1, 2, 4, 7}) {
        for (const int around : {3, 4, 12, 50}) {
            for (const bool interior : {false, true}) {
                CAPTURE(holes);
                CAPTURE(around);
                CAPTURE(interior);
                Outline outline;
                add_loop(outline, around + 4,
                         [](double t) { return Vec3(4 * std::cos(t), 4 * std::sin(t), 0); });
                for (int h = 0; h < holes; ++h) {
                    const double angle = 2 * std::numbers::pi * h / holes + 0.1;
                    add_loop(outline, around,
                             circle(0.4, {1.7 * std::cos(angle), 1.7 * std::sin(angle), 0.3 * h}), true);
                }
                check_surface(outline,
                              minimal_area(outline.points, outline.loops, {.interior_points = interior}));
            }
        }
    }
}

TEST_CASE("a plate with holes has the plate's area less the holes'")
{
    Outline outline;
    add_loop(outline, 80, circle(5, {0, 0, 1}));
    double area = 40 * std::sin(2 * std::numbers::pi / 80) * 25;
    for (int h = 0; h < 5; ++h) {
        const double angle = 2 * std::numbers::pi * h / 5;
        add_loop(outline, 24, circle(0.9, {3 * std::cos(angle), 3 * std::sin(angle), 1}), true);
        area -= 12 * std::sin(2 * std::numbers::pi / 24) * 0.81;
    }
    for (const bool interior : {false, true}) {
        const auto surface = minimal_area(outline.points, outline.loops, {.interior_points = interior});
        check_surface(outline, surface);
        CHECK(surface.area == doctest::Approx(area).epsilon(1e-6));
    }
}

TEST_CASE("loops larger than are solved exactly come close to the same surface")
{
    const auto saddle = [](double t) { return Vec3(std::cos(t), std::sin(t), 0.4 * std::cos(2 * t)); };
    Outline small;
    add_loop(small, 200, saddle);
    const double area = minimal_area(small.points, small.loops).area;
    // Coiled once and a half over itself, so that no shadow is simple.
    const auto coil = [](double t) {
        const double angle = 1.5 * std::numbers::pi * std::cos(t);
        const double radius = 3 + std::sin(t);
        return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.5 * angle);
    };
    Outline coiled;
    add_loop(coiled, 200, coil);
    const double coiled_area = minimal_area(coiled.points, coiled.loops).area;
    for (const int count : {251, 1000, 2500}) {
        CAPTURE(count);
        Outline large;
        add_loop(large, count, saddle);
        const auto surface = minimal_area(large.points, large.loops);
        check_surface(large, surface);
        CHECK(surface.area == doctest::Approx(area).epsilon(0.01));
        Outline wound;
        add_loop(wound, count, coil);
        for (const std::size_t limit : {std::size_t{60}, std::size_t{250}}) {
            CAPTURE(limit);
            const auto spiral = minimal_area(wound.points, wound.loops, {.exact_limit = limit});
            check_surface(wound, spiral);
            CHECK(spiral.area == doctest::Approx(coiled_area).epsilon(0.02));
        }
    }
}

TEST_CASE("loops that cannot bound a surface are refused by number")
{
    Outline outline;
    CHECK_THROWS_AS(minimal_area(outline.points, outline.loops), InvalidInput);
    add_loop(outline, 5, circle(1, {0, 0, 0}));
    outline.loops.push_back({0, 1});
    CHECK_THROWS_WITH_AS(minimal_area(outline.points, outline.loops), doctest::Contains("loop 2 of 2"),
                         InvalidInput);
    outline.loops[1] = {0, 1, 2};
    CHECK_THROWS_WITH_AS(minimal_area(outline.points, outline.loops),
                         doctest::Contains("point 1, which is also in loop 1"), InvalidInput);
    outline.loops[1] = {5, 6, 7};
    CHECK_THROWS_WITH_AS(minimal_area(outline.points, outline.loops), doctest::Contains("does not exist"),
                         InvalidInput);
}

TEST_CASE("a large patch stops within half a second, wherever it is")
{
    Outline rim;
    add_loop(rim, 2000, [](double t) { return Vec3(std::cos(t), std::sin(t), 0.2 * std::cos(2 * t)); });
    for (const int wait : {10, 50, 100, 150, 200, 250}) {
        CAPTURE(wait);
        const auto seconds = test::stops_within(std::chrono::milliseconds(wait),
                                                [&](const RunContext& context) {
                                                    for (;;) minimal_area(rim.points, rim.loops, {}, context);
                                                });
        REQUIRE(seconds);
        CHECK(*seconds < 0.5);
    }
}
