// SPDX-License-Identifier: MIT
#include "support/outline_family.h"

#include <lacuna/quads/detail/face_pattern.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/quads/shared/pave.h>
#include <lacuna/quads/shared/symmetry.h>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

using namespace lacuna;
using quads::PlanarRegion;

namespace {

using Outline = std::vector<Vec2>;
Outline circle(const Vec2& centre, double radius, int sides, bool hole, double phase = 0)
{
    Outline points;
    for (int i = 0; i < sides; ++i) {
        const double angle = phase + (hole ? -2 : 2) * std::numbers::pi * i / sides;
        points.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

/// Straight sides of `size` from corner to corner; each corner rounded by a quarter circle where its radius
/// is not 0.
Outline rounded(const Vec2& half, const std::array<double, 4>& radius, double size)
{
    const std::array<Vec2, 4> corner{Vec2(-half.x(), -half.y()), Vec2(half.x(), -half.y()), half,
                                     Vec2(-half.x(), half.y())};
    Outline points;
    const auto steps = [&](double length) {
        return std::max(1, static_cast<int>(std::lround(length / size)));
    };
    for (std::size_t c = 0; c < 4; ++c) {
        const double angle = static_cast<double>(c) * std::numbers::pi / 2, r = radius[c],
                     s = radius[(c + 1) % 4];
        const Vec2 along(std::cos(angle), std::sin(angle)), inward(-along.y(), along.x());
        const Vec2 centre = corner[c] + r * (along + inward);
        for (int i = 0, n = steps(r * std::numbers::pi / 2); r > 0 && i < n; ++i) {
            const double at = angle - std::numbers::pi + std::numbers::pi / 2 * i / n;
            points.push_back(centre + r * Vec2(std::cos(at), std::sin(at)));
        }
        const Vec2 from = corner[c] + r * along, to = corner[(c + 1) % 4] - s * along;
        const double length = (to - from).norm();
        if (length < size / 2) continue;
        for (int i = 0, n = steps(length); i < n; ++i) points.push_back(from + (to - from) * i / n);
    }
    return points;
}

PlanarRegion region_of(const std::vector<Outline>& loops, double size, double turn = 0.3)
{
    PlanarRegion region;
    for (const Outline& loop : loops) {
        region.loops.emplace_back();
        for (const Vec2& p : loop) {
            region.loops.back().push_back(static_cast<Index>(region.points.size()));
            region.points.push_back(Eigen::Rotation2Dd(turn) * p);
        }
    }
    region.size = [size](const Vec2&) { return size; };
    return region;
}

/// The best of the patterns, by its worst quad.
std::optional<quads::PlanarQuads> best_pattern(const PlanarRegion& region)
{
    std::optional<quads::PlanarQuads> best;
    double least = -1;
    for (quads::PlanarQuads& mesh : quads::fill_patterns(region)) {
        CHECK(quads::find_fault(mesh, region) == "");
        const double worst = quads::measure_plane(mesh, region).min_scaled_jacobian;
        if (worst <= least) continue;
        least = worst;
        best = std::move(mesh);
    }
    return best;
}

/// A pattern fills the region, with so many irregular nodes. Where its quads are of the size asked the paver
/// takes it.
void check_pattern(const PlanarRegion& region, std::size_t irregular, double least)
{
    const auto mesh = best_pattern(region);
    REQUIRE(mesh.has_value());
    const quads::PlaneQuality quality = quads::measure_plane(*mesh, region);
    CHECK(quality.irregular == irregular);
    CHECK(quality.min_scaled_jacobian > least);
    const quads::PlanarQuads paved = quads::pave(region).mesh;
    CHECK(quads::find_fault(paved, region) == "");
    if (quality.size_share() > 0.95) CHECK(quads::measure_plane(paved, region).irregular <= irregular + 4);
}

} // namespace

TEST_CASE("a disc with any even number of sides gets a square within rows: four irregular nodes")
{
    for (int sides = 12; sides <= 120; sides += 2) {
        CAPTURE(sides);
        check_pattern(
            region_of({circle({3, 1}, 1, sides, false)}, 2 * std::numbers::pi / sides, 0.01 * sides), 4, 0.7);
    }
}

TEST_CASE("a ring whose loops have as many sides each gets rows alone, eccentric or not")
{
    for (const int sides : {16, 28, 60}) {
        for (const double off : {0.0, 0.1, 0.15}) {
            CAPTURE(sides);
            CAPTURE(off);
            check_pattern(region_of({circle({0, 0}, 1, sides, false, 0.2),
                                     circle({off, off / 2}, 0.55, sides, true, 0.9)},
                                    2 * std::numbers::pi * 0.75 / sides),
                          0, 0.65);
        }
    }
}

TEST_CASE("a ring with unlike numbers of sides gets rows that change: two irregular nodes a place")
{
    for (const int outer : {28, 36, 44}) {
        for (int fewer = -8; fewer <= 16; fewer += 4) {
            if (fewer == 0) continue;
            CAPTURE(outer);
            CAPTURE(fewer);
            const PlanarRegion region = region_of(
                {circle({0, 0}, 1, outer, false, 0.2), circle({0, 0}, 0.5, outer - fewer, true, 0.2)},
                2 * std::numbers::pi * 0.75 / outer);
            const auto meshes = quads::fill_patterns(region);
            REQUIRE(!meshes.empty());
            const quads::PlaneQuality quality = quads::measure_plane(meshes[0], region);
            CHECK(quality.irregular % 2 == 0);
            CHECK(quality.irregular <= 8);
            CHECK(quality.boundary_irregular == 0);
            CHECK(quality.min_scaled_jacobian > 0.5);
        }
    }
}

TEST_CASE("a ring that is narrow on one side steps in there: four irregular nodes, and fewer rows")
{
    for (const double off : {0.3, 0.35, 0.4}) {
        for (const int steps : {2, 3}) {
            CAPTURE(off);
            CAPTURE(steps);
            const int outer = 40, inner = outer - 2 * steps;
            const PlanarRegion region = region_of(
                {circle({0, 0}, 1, outer, false), circle({off, 0}, 0.4, inner, true)}, 0.14);
            const auto meshes = quads::fill_patterns(region);
            REQUIRE(!meshes.empty());
            const quads::PlaneQuality quality = quads::measure_plane(meshes[0], region);
            CHECK(quality.irregular == 4);
            CHECK(quality.boundary_irregular == 0);
            CHECK(quality.min_scaled_jacobian > 0.5);
        }
    }
}

TEST_CASE("few quads of a disc with holes have no worse quads for fewer irregular nodes")
{
    int good = 0, made = 0;
    double least = 1;
    for (int holes = 3; holes <= 6; ++holes) {
        for (const int sides : {36, 42, 48, 54}) {
            const double size = 2 * std::numbers::pi / sides;
            std::vector<Outline> loops{circle({0, 0}, 1, sides, false)};
            for (int k = 0; k < holes; ++k) {
                const double angle = 2 * std::numbers::pi * k / holes;
                loops.push_back(circle({0.6 * std::cos(angle), 0.6 * std::sin(angle)}, 0.16, 10, true));
            }
            const PlanarRegion region = region_of(loops, size);
            const quads::PlanarQuads mesh = quads::pave(region).mesh;
            CHECK(quads::find_fault(mesh, region) == "");
            const double worst = quads::measure_plane(mesh, region).min_scaled_jacobian;
            least = std::min(least, worst);
            good += worst > 0.75 ? 1 : 0;
            ++made;
        }
    }
    MESSAGE(good << " of " << made << " above 0.75, least " << least);
    CHECK(least > 0.7);
    CHECK(2 * good >= made);
}

TEST_CASE("a polygon in a circle, and a circle in a slot, are rings")
{
    for (int corners = 4; corners <= 8; ++corners) {
        CAPTURE(corners);
        const int each = 24 / corners + 1, sides = corners * each;
        Outline polygon;
        for (int c = 0; c < corners; ++c) {
            const auto at = [&](int k) {
                return Vec2(0.5 * std::cos(2 * std::numbers::pi * k / corners),
                            -0.5 * std::sin(2 * std::numbers::pi * k / corners));
            };
            for (int i = 0; i < each; ++i) polygon.push_back(at(c) + (at(c + 1) - at(c)) * i / each);
        }
        check_pattern(
            region_of({circle({0, 0}, 1, sides, false), polygon}, 2 * std::numbers::pi * 0.75 / sides), 0,
            0.6);
    }
    const Outline slot = rounded({2, 0.8}, {0.8, 0.8, 0.8, 0.8}, 0.2);
    Outline hole = rounded({1.5, 0.35}, {0.35, 0.35, 0.35, 0.35}, 0.2 * 0.75);
    std::reverse(hole.begin(), hole.end());
    if (hole.size() == slot.size()) check_pattern(region_of({slot, hole}, 0.18), 0, 0.6);
}

TEST_CASE("a round corner takes one irregular node, wherever corners are round")
{
    for (int round = 1; round < 16; ++round) {
        CAPTURE(round);
        std::array<double, 4> radius{};
        std::size_t corners = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            if (((round >> c) & 1) == 0) continue;
            radius[c] = 0.6;
            ++corners;
        }
        // Whole numbers of sides either way: 0.6 leaves as many as the quarter circle has, near enough.
        const PlanarRegion region = region_of({rounded({1.8, 1.2}, radius, 0.2)}, 0.2);
        if (region.points.size() % 2 != 0) continue;
        check_pattern(region, corners, 0.55);
    }
}

TEST_CASE("triangles, pentagons and sectors get a grid at each corner: one irregular node")
{
    for (const int corners : {3, 5}) {
        for (int each = 4; each <= 16; each += 2) {
            CAPTURE(corners);
            CAPTURE(each);
            const Outline at = circle({0, 0}, 1, corners, false);
            Outline outline;
            for (std::size_t c = 0; c < at.size(); ++c) {
                for (int i = 0; i < each; ++i)
                    outline.emplace_back(at[c] + (at[(c + 1) % at.size()] - at[c]) * i / each);
            }
            check_pattern(region_of({outline}, (at[1] - at[0]).norm() / each), 1, 0.7);
        }
    }
    for (const double angle : {0.8, 1.0, 1.3}) {
        for (int each = 8; each <= 16; each += 4) {
            CAPTURE(angle);
            CAPTURE(each);
            const int round = 2 * static_cast<int>(std::lround(angle * each / 2));
            Outline outline;
            for (int i = 0; i < each; ++i) outline.emplace_back(static_cast<double>(i) / each, 0);
            for (int i = 0; i < round; ++i)
                outline.emplace_back(std::cos(angle * i / round), std::sin(angle * i / round));
            for (int i = 0; i < each; ++i)
                outline.emplace_back((1 - static_cast<double>(i) / each) * std::cos(angle),
                                     (1 - static_cast<double>(i) / each) * std::sin(angle));
            check_pattern(region_of({outline}, 1.0 / each), 1, 0.6);
        }
    }
}

TEST_CASE("a corner cut off at 45 degrees takes one irregular node, and no quad has its whole angle")
{
    // One corner, two neighbours or all four: with others sides that face each other have unlike numbers.
    for (const int cuts : {1, 2, 3, 4, 6, 8, 9, 12, 15}) {
        CAPTURE(cuts);
        // Each cut goes from a third of a side of 0.6 to the other, so that sides are about 0.2 long.
        Outline outline;
        std::size_t count = 0;
        const std::array<Vec2, 4> corner{Vec2(0, 0), Vec2(3, 0), Vec2(3, 2), Vec2(0, 2)};
        std::vector<Vec2> ends;
        for (std::size_t c = 0; c < 4; ++c) {
            const Vec2 back = (corner[(c + 3) % 4] - corner[c]).normalized(),
                       ahead = (corner[(c + 1) % 4] - corner[c]).normalized();
            if (((cuts >> c) & 1) == 0) {
                ends.push_back(corner[c]);
                continue;
            }
            ++count;
            ends.emplace_back(corner[c] + 0.6 * back);
            ends.emplace_back(corner[c] + 0.6 * ahead);
        }
        for (std::size_t e = 0; e < ends.size(); ++e) {
            const Vec2 &a = ends[e], &b = ends[(e + 1) % ends.size()];
            // As many sides along a cut as its corner would have had on both of its sides.
            const bool is_cut = std::abs((b - a).x()) > 0.1 && std::abs((b - a).y()) > 0.1;
            const int sides = is_cut ? 4 : static_cast<int>(std::lround((b - a).norm() / 0.2));
            for (int i = 0; i < sides; ++i) outline.emplace_back(a + (b - a) * i / sides);
        }
        if (outline.size() % 2 != 0) continue;
        check_pattern(region_of({outline}, 0.2), count, 0.72);
    }
}

TEST_CASE("a pointed notch is a slit of the grid: no irregular node, however deep and wherever it is")
{
    constexpr double kSide = 0.2;
    for (const int deep : {1, 2, 4}) {
        for (const int place : {3, 6, 11}) {
            CAPTURE(deep);
            CAPTURE(place);
            Outline outline;
            const auto add = [&](const Vec2& from, const Vec2& to, int sides) {
                for (int i = 0; i < sides; ++i) outline.emplace_back(from + (to - from) * i / sides);
            };
            const double middle = kSide * place;
            const Vec2 tip(middle, kSide * deep), half(kSide * deep / 3, 0);
            add({0, 0}, Vec2(middle, 0) - half, place);
            add(Vec2(middle, 0) - half, tip, deep);
            add(tip, Vec2(middle, 0) + half, deep);
            add(Vec2(middle, 0) + half, {3, 0}, 15 - place);
            add({3, 0}, {3, 2}, 10);
            add({3, 2}, {0, 2}, 15);
            add({0, 2}, {0, 0}, 10);
            check_pattern(region_of({outline}, kSide), 0, 0.6);
        }
    }
}

TEST_CASE(
    "a hole with a sharp and a blunt end is a slit of the grid: no irregular node, at any number of sides")
{
    constexpr double kSide = 0.1;
    for (const int sides : {4, 5, 6, 7, 9}) {
        for (const double lean : {0.0, 0.1, 0.25}) {
            CAPTURE(sides);
            CAPTURE(lean);
            // From the sharp end along below to the blunt one, where nodes lie closer, and back above.
            const double chord = kSide * sides;
            Outline hole;
            for (int i = 0; i < 2 * sides; ++i) {
                const double at = std::pow(std::abs(1 - static_cast<double>(i) / sides), 1.5);
                const double half = 0.35 * std::sqrt(at) * (1 - at), middle = lean * at * (1 - at);
                hole.emplace_back(1 + chord * (at - 0.5),
                                  0.7 + chord * (middle + (i < sides ? -half : half)));
            }
            Outline box;
            const auto add = [&](const Vec2& from, const Vec2& to, int n) {
                for (int i = 0; i < n; ++i) box.emplace_back(from + (to - from) * i / n);
            };
            add({0, 0}, {2, 0}, 20);
            add({2, 0}, {2, 1.4}, 14);
            add({2, 1.4}, {0, 1.4}, 20);
            add({0, 1.4}, {0, 0}, 14);
            check_pattern(region_of({box, hole}, kSide), 0, 0.6);
        }
    }
}

TEST_CASE("holes take four irregular nodes each, in straight grids and in rings")
{
    std::vector<Outline> plate{rounded({3, 1}, {0, 0, 0, 0}, 0.1)};
    for (const double x : {-2.0, 0.0, 2.0}) plate.push_back(circle({x, 0.1 * x}, 0.4, 24, true));
    check_pattern(region_of(plate, 0.1), 12, 0.6);
    std::vector<Outline> flange{circle({0, 0}, 1, 72, false), circle({0, 0}, 0.5, 72, true)};
    for (int k = 0; k < 5; ++k) {
        const double angle = 0.4 + 2 * std::numbers::pi * k / 5;
        flange.push_back(circle(0.75 * Vec2(std::cos(angle), std::sin(angle)), 0.09, 12, true));
    }
    check_pattern(region_of(flange, 0.06), 20, 0.55);
}

TEST_CASE("a symmetric outline gets a mesh that its symmetries map onto itself, to rounding")
{
    struct Case {
        std::vector<Outline> loops;
        int fold;
        double size;
    };
    std::vector<Outline> flange{circle({0, 0}, 1, 72, false), circle({0, 0}, 0.5, 72, true)};
    for (int k = 0; k < 6; ++k) {
        const double angle = std::numbers::pi * k / 3;
        flange.push_back(circle(0.75 * Vec2(std::cos(angle), std::sin(angle)), 0.1, 16, true, angle));
    }
    const std::vector<Case> cases{
        {{circle({0, 0}, 1, 24, false, std::numbers::pi / 24)}, 4, 0.25},
        {{circle({0, 0}, 1, 60, false)}, 4, 0.1},
        {{circle({0, 0}, 1, 30, false), circle({0, 0}, 0.5, 30, true)}, 30, 0.15},
        {{rounded({2, 1}, {0.5, 0.5, 0.5, 0.5}, 0.2)}, 2, 0.2},
        {{rounded({2, 1}, {1, 1, 1, 1}, 0.16)}, 2, 0.16},
        {{rounded({1, 1}, {0, 0, 0, 0}, 0.1), circle({0, 0}, 0.4, 24, true)}, 4, 0.1},
        {flange, 6, 0.06},
    };
    for (std::size_t c = 0; c < cases.size(); ++c) {
        CAPTURE(c);
        const PlanarRegion region = region_of(cases[c].loops, cases[c].size);
        const quads::PlanarQuads mesh = quads::pave(region).mesh;
        CHECK(quads::find_fault(mesh, region) == "");
        // As many mirrorings as turns: about which axes is up to the mesh where the outline has more.
        quads::PlanarQuads again = mesh;
        CHECK(quads::symmetrise(again, region) == static_cast<std::size_t>(2 * cases[c].fold));
        for (std::size_t p = 0; p < mesh.points.size(); ++p)
            CHECK((again.points[p] - mesh.points[p]).norm() < 1e-12);
        for (int k = 1; k < cases[c].fold; ++k) {
            double farthest = 0;
            for (const Vec2& p : mesh.points) {
                const Vec2 image = Eigen::Rotation2Dd(2 * std::numbers::pi * k / cases[c].fold) * p;
                double nearest = 1;
                for (const Vec2& q : mesh.points) nearest = std::min(nearest, (q - image).norm());
                farthest = std::max(farthest, nearest);
            }
            CAPTURE(k);
            CHECK(farthest < 1e-12);
        }
    }
}

TEST_CASE("grids over a held family of outlines are valid, have few irregular nodes, and fill at least half "
          "of them")
{
    constexpr std::uint32_t kHeld = 2; // no weight was chosen on members of this seed
    constexpr int kMembers = 24;
    int filled = 0;
    for (int k = 0; k < kMembers; ++k) {
        CAPTURE(k);
        const test::SeededDomain made = test::family_region(kHeld, k);
        bool any = false;
        for (const quads::PlanarQuads& mesh : quads::fill_patterns(made.region)) {
            CHECK(quads::find_fault(mesh, made.region) == "");
            // A loose bound: a turn takes at least four sides of a round loop.
            CHECK(quads::measure_plane(mesh, made.region).irregular <= made.region.points.size() / 4);
            any = true;
        }
        filled += any ? 1 : 0;
    }
    CHECK(filled >= kMembers / 2);
}

TEST_CASE("a rectangle with unlike sides gets few irregular nodes")
{
    for (const int more : {2, 4}) {
        CAPTURE(more);
        Outline uneven = rounded({1, 0.5}, {0, 0, 0, 0}, 0.1);
        for (int i = 0; i < more; ++i) uneven.insert(uneven.begin() + 5, (uneven[4] + uneven[5]) / 2);
        const PlanarRegion region = region_of({uneven}, 0.1);
        const auto mesh = best_pattern(region);
        REQUIRE(mesh.has_value());
        CHECK(quads::measure_plane(*mesh, region).irregular <= 4);
    }
}

TEST_CASE("what fits no grid gets no pattern")
{
    // An octagon in a square, with unlike numbers of sides: it has too many corners for a grid, and as a ring
    // unlike loops.
    Outline octagon = circle({0, 0}, 0.5, 8, true);
    CHECK(quads::fill_patterns(region_of({rounded({1, 1}, {0, 0, 0, 0}, 2), octagon}, 0.5)).empty());
}
