// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/polyline.h>

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace lacuna;
using namespace lacuna::geometry;

namespace {

/// A random walk; every third step may stand still.
std::vector<Vec3> walk(unsigned seed, int steps)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> step(-1, 1);
    std::vector<Vec3> points{Vec3(100, -50, 3)};
    for (int i = 0; i < steps; ++i) {
        const Vec3 d(step(random), step(random), step(random));
        points.push_back(i % 3 == 2 ? points.back() : Vec3(points.back() + d));
    }
    return points;
}

} // namespace

TEST_CASE("running lengths start at zero, never fall, and end at the length")
{
    for (unsigned seed = 0; seed < 20; ++seed) {
        const auto points = walk(seed, 30);
        const auto lengths = arc_lengths(points);
        REQUIRE(lengths.size() == points.size());
        CHECK(lengths.front() == 0);
        CHECK(lengths.back() == length(points));
        for (std::size_t i = 1; i < lengths.size(); ++i) CHECK(lengths[i] >= lengths[i - 1]);
    }
    CHECK(arc_lengths(std::vector<Vec3>{}).empty());
    CHECK(length(std::vector<Vec3>{Vec3(1, 2, 3)}) == 0);
}

TEST_CASE("the length of a fine polygon round a circle is the circle's")
{
    std::vector<Vec3> points;
    const int count = 1000;
    for (int i = 0; i <= count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        points.emplace_back(5 * std::cos(angle), 5 * std::sin(angle), 2);
    }
    CHECK(length(points) == doctest::Approx(10 * std::numbers::pi).epsilon(1e-5));
}

TEST_CASE("a chain's points come back bit for bit at their own running length")
{
    for (unsigned seed = 0; seed < 20; ++seed) {
        const auto points = walk(seed, 30);
        const auto lengths = arc_lengths(points);
        for (std::size_t i = 0; i < points.size(); ++i)
            CHECK(point_at(points, lengths, lengths[i]) == points[i]);
    }
}

TEST_CASE("places in between keep the running length, and beyond the ends the ends stand")
{
    std::mt19937 random(7);
    for (unsigned seed = 0; seed < 20; ++seed) {
        const auto points = walk(seed, 30);
        const auto lengths = arc_lengths(points);
        std::uniform_real_distribution<double> along(0, lengths.back());
        for (int trial = 0; trial < 50; ++trial) {
            const double s = along(random);
            const PolylinePlace place = place_at(lengths, s);
            CHECK(place.fraction >= 0);
            CHECK(place.fraction <= 1);
            const double back = lengths[place.segment] +
                                place.fraction * (lengths[place.segment + 1] - lengths[place.segment]);
            CHECK(back == doctest::Approx(s));
            const double walked = lengths[place.segment] +
                                  (point_at(points, lengths, s) - points[place.segment]).norm();
            CHECK(walked == doctest::Approx(s));
        }
        CHECK(point_at(points, lengths, -1) == points.front());
        CHECK(point_at(points, lengths, lengths.back() + 1) == points.back());
    }
    const std::vector<Vec3> one{Vec3(1, 2, 3)};
    CHECK(point_at(one, arc_lengths(one), 5) == one.front());
}
