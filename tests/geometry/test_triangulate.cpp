// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/geometry/shared/triangulate.h>

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

using Loops = std::vector<std::vector<Index>>;

struct Region {
    std::vector<Vec2> points;
    Loops loops;
};

const Vec2& at(const std::vector<Vec2>& points, Index i) { return points[static_cast<std::size_t>(i)]; }

void add_star(Region& region, std::mt19937& dice, int corners, double inner, double outer, const Vec2& centre)
{
    std::uniform_real_distribution<double> radius(inner, outer);
    std::vector<Index> loop;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners;
        loop.push_back(static_cast<Index>(region.points.size()));
        region.points.push_back(centre + radius(dice) * Vec2(std::cos(angle), std::sin(angle)));
    }
    if (dice() % 2) std::reverse(loop.begin(), loop.end());
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(dice() % loop.size()), loop.end());
    region.loops.push_back(loop);
}

/// A star with islands that are stars, in no particular order or direction.
Region star_with_islands(unsigned seed, int corners, int islands)
{
    std::mt19937 dice(seed);
    Region region;
    add_star(region, dice, corners, 4, 7, {0.3, -0.2});
    for (int i = 0; i < islands; ++i) {
        const double angle = 2 * std::numbers::pi * i / islands;
        add_star(region, dice, 3 + static_cast<int>(dice() % 9), 0.2, 0.7,
                 2 * Vec2(std::cos(angle), std::sin(angle)));
    }
    std::shuffle(region.loops.begin(), region.loops.end(), dice);
    return region;
}

double loop_area(const Region& region, const std::vector<Index>& loop)
{
    double twice = 0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec2& a = at(region.points, loop[k]);
        const Vec2& b = at(region.points, loop[(k + 1) % loop.size()]);
        twice += a.x() * b.y() - b.x() * a.y();
    }
    return std::abs(twice) / 2;
}

double corner_angle(const std::vector<Vec2>& points, const Triangle& tri, std::size_t k)
{
    const Vec2 u = at(points, tri[(k + 1) % 3]) - at(points, tri[k]);
    const Vec2 v = at(points, tri[(k + 2) % 3]) - at(points, tri[k]);
    return std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v)) * 180 / std::numbers::pi;
}

std::set<std::pair<Index, Index>> segments_of(const Loops& loops)
{
    std::set<std::pair<Index, Index>> result;
    for (const auto& loop : loops) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            result.insert(std::minmax(loop[k], loop[(k + 1) % loop.size()]));
        }
    }
    return result;
}

double area_of(const Triangulation& result)
{
    double area = 0;
    for (const Triangle& tri : result.triangles) {
        area += orient2d(at(result.points, tri[0]), at(result.points, tri[1]), at(result.points, tri[2])) / 2;
    }
    return area;
}

/// What holds for every triangulation, whatever the region.
void check_triangulation(const Region& region, const Triangulation& result, double area, int islands)
{
    REQUIRE(result.points.size() >= region.points.size());
    CHECK(std::equal(region.points.begin(), region.points.end(), result.points.begin()));
    CHECK(area_of(result) == doctest::Approx(area).epsilon(1e-9));

    std::map<std::pair<Index, Index>, Index> apex; // of each directed side
    std::set<Index> used;
    for (const Triangle& tri : result.triangles) {
        CHECK(orient2d(at(result.points, tri[0]), at(result.points, tri[1]), at(result.points, tri[2])) > 0);
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(apex.emplace(std::pair(tri[k], tri[(k + 1) % 3]), tri[(k + 2) % 3]).second);
            used.insert(tri[k]);
        }
    }
    const auto segments = segments_of(region.loops);
    std::size_t border = 0;
    for (const auto& [side, left] : apex) {
        const auto twin = apex.find({side.second, side.first});
        const bool is_segment = segments.count(std::minmax(side.first, side.second)) > 0;
        if (twin == apex.end()) {
            ++border;
            CHECK(is_segment);
        } else {
            CHECK(!is_segment);
            CHECK(incircle(at(result.points, side.first), at(result.points, side.second),
                           at(result.points, left), at(result.points, twin->second)) <= 0);
        }
    }
    CHECK(border == segments.size());
    // Euler: V − E + F of a disc with holes.
    const auto sides = (apex.size() + border) / 2;
    CHECK(static_cast<long>(used.size()) - static_cast<long>(sides) +
              static_cast<long>(result.triangles.size()) ==
          1 - islands);
}

Region square(int per_side, const Vec2& low = {0, 0}, double length = 1)
{
    Region region;
    const std::array<Vec2, 5> corner{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1), Vec2(0, 0)};
    region.loops.emplace_back();
    for (std::size_t side = 0; side < 4; ++side) {
        for (int i = 0; i < per_side; ++i) {
            region.loops[0].push_back(static_cast<Index>(region.points.size()));
            region.points.push_back(
                low + length * (corner[side] + (corner[side + 1] - corner[side]) * i / per_side));
        }
    }
    return region;
}

void append(Region& region, const Region& other)
{
    const auto offset = static_cast<Index>(region.points.size());
    region.points.insert(region.points.end(), other.points.begin(), other.points.end());
    for (auto loop : other.loops) {
        for (Index& p : loop) p += offset;
        region.loops.push_back(loop);
    }
}

} // namespace

TEST_CASE("predicates tell the sign exactly where doubles cannot")
{
    // The classic: points a few roundings off a line, against integers that hold the same positions exactly.
    const double tick = std::ldexp(1.0, -53);
    for (int i = 0; i < 32; ++i) {
        for (int j = 0; j < 32; ++j) {
            const Vec2 a(0.5 + i * tick, 0.5 + j * tick), b(12, 12), c(24, 24);
            const double sign = orient2d(a, b, c);
            CHECK((sign > 0) == (j > i));
            CHECK((sign < 0) == (j < i));
            CHECK(orient2d(b, c, a) == doctest::Approx(sign).epsilon(1e-3));
        }
    }
    // A circle through four corners of a square; the fourth moved by one rounding.
    const double big = std::ldexp(1.0, 30);
    for (const double scale : {1.0, 3.0, 7.0}) {
        const Vec2 a(big, big), b(big + scale, big), c(big + scale, big + scale), d(big, big + scale);
        CHECK(incircle(a, b, c, d) == 0);
        const Vec2 inward(std::nextafter(d.x(), 2 * big), d.y()), outward(std::nextafter(d.x(), 0), d.y());
        CHECK(incircle(a, b, c, inward) > 0);
        CHECK(incircle(a, b, c, outward) < 0);
        CHECK(incircle(c, b, a, inward) < 0);
    }
}

TEST_CASE("stars with islands: exact area, all segments, Delaunay, Euler, with and without interior points")
{
    for (unsigned seed = 0; seed < 60; ++seed) {
        for (const bool interior : {false, true}) {
            CAPTURE(seed);
            CAPTURE(interior);
            const int islands = static_cast<int>(seed % 5);
            const Region region = star_with_islands(seed, 5 + static_cast<int>(seed) * 2, islands);
            double sum = 0;
            double outer = 0;
            for (const auto& loop : region.loops) {
                sum += loop_area(region, loop);
                outer = std::max(outer, loop_area(region, loop));
            }
            const auto result = triangulate(region.points, region.loops, {.interior_points = interior});
            check_triangulation(region, result, 2 * outer - sum, islands);
            if (!interior) CHECK(result.points.size() == region.points.size());
        }
    }
}

TEST_CASE("where the rim is regular, every angle is fair and sizes follow the rim")
{
    for (const int per_side : {4, 10, 40}) {
        for (const double grading : {0.0, 0.1, 0.2, 0.5}) {
            CAPTURE(per_side);
            CAPTURE(grading);
            const Region region = square(per_side);
            const auto result = triangulate(region.points, region.loops, {.grading = grading});
            check_triangulation(region, result, 1, 0);
            double least = 180;
            double longest = 0;
            for (const Triangle& tri : result.triangles) {
                for (std::size_t k = 0; k < 3; ++k) {
                    least = std::min(least, corner_angle(result.points, tri, k));
                    longest = std::max(
                        longest, (at(result.points, tri[k]) - at(result.points, tri[(k + 1) % 3])).norm());
                }
            }
            CHECK(least > 20.5); // what a circumradius of √2 × the shortest side means
            CHECK(longest < 2 * (1.0 / per_side + grading * 0.5));
        }
    }
}

TEST_CASE("a size function is met inside")
{
    const Region region = square(50);
    const auto size = [](const Vec2& p) { return 0.002 + 0.1 * (p - Vec2(0.5, 0.5)).norm(); };
    const auto result = triangulate(region.points, region.loops,
                                    {.size = size, .grading = std::numeric_limits<double>::infinity()});
    check_triangulation(region, result, 1, 0);
    std::size_t met = 0;
    for (const Triangle& tri : result.triangles) {
        const Vec2 centre =
            (at(result.points, tri[0]) + at(result.points, tri[1]) + at(result.points, tri[2])) / 3;
        double mean = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            mean += (at(result.points, tri[k]) - at(result.points, tri[(k + 1) % 3])).norm() / 3;
        }
        if (mean < 1.5 * size(centre) && mean > 0.5 * size(centre)) ++met;
    }
    CHECK(static_cast<double>(met) > 0.95 * static_cast<double>(result.triangles.size()));
}

TEST_CASE("spacings a millionfold apart, cocircular grids and points in line are no trouble")
{
    SUBCASE("a rim whose segments grow geometrically from 1e-6 to 1")
    {
        Region region;
        region.loops.emplace_back();
        for (double x = 1e-6; x < 4; x *= 1.3) region.points.emplace_back(x, 0);
        region.points.emplace_back(4, 4);
        for (double y = 4 / 1.3; y > 1e-6; y /= 1.3) region.points.emplace_back(0, y);
        for (std::size_t i = 0; i < region.points.size(); ++i)
            region.loops[0].push_back(static_cast<Index>(i));
        const auto result = triangulate(region.points, region.loops);
        check_triangulation(region, result, loop_area(region, region.loops[0]), 0);
        CHECK(result.points.size() < 3000);
        CHECK(result.points.size() > region.points.size());
    }
    SUBCASE("square islands on a grid, all cocircular")
    {
        const int n = 12;
        Region region = square(2 * n);
        for (int i = 1; i < n; ++i) {
            for (int j = 1; j < n; ++j) append(region, square(1, Vec2(i - 0.25, j - 0.25) / n, 0.5 / n));
        }
        const int islands = (n - 1) * (n - 1);
        const double area = 1 - islands * 0.25 / (n * n);
        for (const bool interior : {false, true}) {
            check_triangulation(region,
                                triangulate(region.points, region.loops, {.interior_points = interior}), area,
                                islands);
        }
    }
    SUBCASE("a sliver of one rounding's width")
    {
        Region region;
        for (int i = 0; i <= 100; ++i) region.points.emplace_back(i / 100.0, i / 100.0);
        region.points[50].x() = std::nextafter(0.5, 1.0);
        region.points.emplace_back(0, 1);
        region.loops.emplace_back();
        for (Index i = 0; i < 102; ++i) region.loops[0].push_back(i);
        const auto result = triangulate(region.points, region.loops);
        check_triangulation(region, result, 0.5, 0);
    }
    SUBCASE("far from the origin")
    {
        const Region region = square(8, {std::ldexp(1.0, 27), -std::ldexp(1.0, 27)});
        check_triangulation(region, triangulate(region.points, region.loops), 1, 0);
    }
}

TEST_CASE("a long segment through many triangles is kept")
{
    // Teeth of a comb: the spine's one segment cuts the Delaunay triangulation of all tips.
    for (const int teeth : {3, 20, 200}) {
        Region region;
        region.points = {Vec2(0, 0), Vec2(teeth, 0)};
        for (int i = teeth; i > 0; --i) {
            region.points.emplace_back(i, 5 + 0.01 * i * i);
            region.points.emplace_back(i - 0.5, 1e-3 * (1 + i % 3));
        }
        region.points.emplace_back(0, 5);
        region.loops.emplace_back();
        for (std::size_t i = 0; i < region.points.size(); ++i)
            region.loops[0].push_back(static_cast<Index>(i));
        for (const bool interior : {false, true}) {
            const auto result = triangulate(region.points, region.loops, {.interior_points = interior});
            check_triangulation(region, result, loop_area(region, region.loops[0]), 0);
        }
    }
}

TEST_CASE("loops apart and loops within islands make regions of their own")
{
    Region nested = square(6, {0, 0}, 4);
    append(nested, square(4, {1, 1}, 2));
    append(nested, square(2, {1.5, 1.5}, 1));
    const auto ring_and_core = triangulate(nested.points, nested.loops);
    check_triangulation(nested, ring_and_core, 16 - 4 + 1, 0);

    Region apart = square(3);
    append(apart, square(3, {5, 0}));
    check_triangulation(apart, triangulate(apart.points, apart.loops), 2, -1);
}

TEST_CASE("loops that cross, touch or have no area are refused by number")
{
    const auto refuse = [](const Region& region, const char* words) {
        CHECK_THROWS_WITH_AS(triangulate(region.points, region.loops), doctest::Contains(words),
                             InvalidInput);
    };
    Region crossing = square(2);
    append(crossing, square(3, {0.5, 0.5}));
    refuse(crossing, "loop 2 of 2");
    Region touching = square(2);
    append(touching, square(1, {1, 0.25}, 0.5));
    refuse(touching, "loop 1 of 2");
    Region bow = square(1);
    std::swap(bow.loops[0][1], bow.loops[0][2]);
    refuse(bow, "crosses");
    Region spike{{Vec2(0, 0), Vec2(2, 0), Vec2(1, 0), Vec2(1, 1)}, {{0, 1, 2, 3}}};
    refuse(spike, "crosses or touches");
    Region flat{{Vec2(0, 0), Vec2(1, 1), Vec2(3, 3)}, {{0, 1, 2}}};
    refuse(flat, "zero area");
    Region pair{{Vec2(0, 0), Vec2(1, 1)}, {{0, 1}}};
    refuse(pair, "2 points");
    Region missing{{Vec2(0, 0), Vec2(1, 1), Vec2(0, 1)}, {{0, 1, 7}}};
    refuse(missing, "point 8");
    Region none;
    refuse(none, "at least one loop");
}

TEST_CASE("find_crossing agrees with comparing all pairs, and finds the first")
{
    for (unsigned seed = 0; seed < 200; ++seed) {
        CAPTURE(seed);
        std::mt19937 dice(seed);
        std::uniform_int_distribution<int> cell(0, 12);
        Region region;
        for (int l = 0; l < 2; ++l) {
            std::vector<Index> loop;
            const int corners = 3 + static_cast<int>(dice() % 3);
            for (int i = 0; i < corners; ++i) {
                loop.push_back(static_cast<Index>(region.points.size()));
                region.points.emplace_back(cell(dice), cell(dice));
            }
            region.loops.push_back(loop);
        }
        // Integers small enough for plain arithmetic to be exact; parameters compared by cross products.
        struct Item {
            std::size_t loop, segment;
            Vec2 a, b;
        };
        std::vector<Item> items;
        for (std::size_t l = 0; l < 2; ++l) {
            const auto& loop = region.loops[l];
            for (std::size_t k = 0; k < loop.size(); ++k) {
                items.push_back(
                    {l, k, at(region.points, loop[k]), at(region.points, loop[(k + 1) % loop.size()])});
            }
        }
        const auto turn = [](const Vec2& a, const Vec2& b, const Vec2& c) {
            const double v = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
            return v > 0 ? 1 : v < 0 ? -1 : 0;
        };
        const auto on = [&](const Vec2& p, const Vec2& a, const Vec2& b) {
            return turn(a, b, p) == 0 && (p - a).dot(p - b) <= 0;
        };
        const auto meet = [&](const Item& s, const Item& r) {
            const std::size_t count = region.loops[s.loop].size();
            if (s.loop == r.loop && (s.segment + 1) % count == r.segment) {
                return turn(s.a, s.b, r.b) == 0 && (s.a - s.b).dot(r.b - s.b) > 0;
            }
            if (s.loop == r.loop && (r.segment + 1) % count == s.segment) {
                return turn(r.a, r.b, s.b) == 0 && (r.a - r.b).dot(s.b - r.b) > 0;
            }
            return on(s.a, r.a, r.b) || on(s.b, r.a, r.b) || on(r.a, s.a, s.b) || on(r.b, s.a, s.b) ||
                   (turn(s.a, s.b, r.a) != turn(s.a, s.b, r.b) &&
                    turn(r.a, r.b, s.a) != turn(r.a, r.b, s.b) &&
                    turn(s.a, s.b, r.a) * turn(s.a, s.b, r.b) < 0 &&
                    turn(r.a, r.b, s.a) * turn(r.a, r.b, s.b) < 0);
        };
        std::optional<std::pair<std::size_t, std::size_t>> wanted;
        for (std::size_t i = 0; i < items.size() && !wanted; ++i) {
            for (std::size_t j = i + 1; j < items.size() && !wanted; ++j) {
                if (meet(items[i], items[j])) wanted = {i, j};
            }
        }
        const auto found = find_crossing(region.points, region.loops);
        REQUIRE(found.has_value() == wanted.has_value());
        if (!found) continue;
        CHECK(found->loop_a == items[wanted->first].loop);
        CHECK(found->segment_a == items[wanted->first].segment);
        CHECK(found->loop_b == items[wanted->second].loop);
        CHECK(found->segment_b == items[wanted->second].segment);
    }
}

TEST_CASE("the same region gives the same triangles, and refinement stops at max_points")
{
    const Region region = star_with_islands(7, 60, 4);
    const auto once = triangulate(region.points, region.loops);
    const auto twice = triangulate(region.points, region.loops);
    CHECK(once.points == twice.points);
    CHECK(once.triangles == twice.triangles);
    const auto few = triangulate(region.points, region.loops, {.grading = 0, .max_points = 5});
    CHECK(few.points.size() == region.points.size() + 5);
}

TEST_CASE("a point is inside a polygon whichever way it runs and whichever point comes first")
{
    const std::vector<Vec2> u{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
    for (std::size_t first = 0; first < u.size(); ++first) {
        for (const bool reversed : {false, true}) {
            std::vector<Vec2> polygon = u;
            std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(first), polygon.end());
            if (reversed) std::reverse(polygon.begin(), polygon.end());
            for (const Vec2& p : {Vec2(0.5, 1), Vec2(2.5, 3 - 1e-15), Vec2(1.5, 0.5), Vec2(1 - 1e-16, 2)})
                CHECK(lies_inside(polygon, p));
            for (const Vec2& p :
                 {Vec2(1.5, 1 + 1e-15), Vec2(1.5, 2), Vec2(-1, 1), Vec2(4, 3), Vec2(2 - 1e-15, 1.5)})
                CHECK_FALSE(lies_inside(polygon, p));
        }
    }
}
