// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/spread.h>

#include <Eigen/Geometry>

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace lacuna;

namespace {

std::vector<Vec3> cloud(std::mt19937& random)
{
    std::uniform_real_distribution<double> along(-1, 1);
    std::vector<Vec3> points(50);
    for (Vec3& p : points) p = Vec3(3 * along(random), 2 * along(random), along(random));
    return points;
}

} // namespace

TEST_CASE("a spread turns, moves and grows with its points")
{
    std::mt19937 random(7);
    for (int run = 0; run < 20; ++run) {
        const std::vector<Vec3> points = cloud(random);
        const geometry::Spread before = geometry::spread_of(points);
        const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.37 * run, Vec3(1, 2, run).normalized()));
        const double size = 1 + run;
        std::vector<Vec3> moved;
        for (const Vec3& p : points) moved.push_back(size * (turn * p) + Vec3(5, -3, run));
        const geometry::Spread after = geometry::spread_of(moved);
        CHECK((after.centre - (size * (turn * before.centre) + Vec3(5, -3, run))).norm() < 1e-9 * size);
        CHECK((after.square - size * size * before.square).norm() < 1e-9 * size * size);
        CHECK(before.square[0] <= before.square[1]);
        CHECK(before.square[1] <= before.square[2]);
        for (int a = 0; a < 3; ++a)
            CHECK(std::abs((turn * before.axis.col(a)).dot(after.axis.col(a))) == doctest::Approx(1));
    }
}

TEST_CASE("a point that counts twice is spread as two are, and the mean is where points spread least about")
{
    std::mt19937 random(11);
    std::vector<Vec3> points = cloud(random);
    std::vector<double> weights(points.size(), 1);
    for (std::size_t p = 0; p < points.size(); p += 3) weights[p] = 2;
    const geometry::Spread weighed = geometry::spread_of(points, weights);
    std::vector<Vec3> repeated = points;
    for (std::size_t p = 0; p < points.size(); p += 3) repeated.push_back(points[p]);
    const geometry::Spread twice = geometry::spread_of(repeated);
    CHECK((weighed.centre - twice.centre).norm() < 1e-12);
    CHECK((weighed.square - twice.square).norm() < 1e-12);
    const geometry::Spread beside = geometry::spread_about(weighed.centre + Vec3(0.1, 0, 0), points, weights);
    CHECK(beside.square.sum() == doctest::Approx(weighed.square.sum() + 0.01));
}

TEST_CASE("points of a plane spread by nothing across it, and of a line along it alone")
{
    std::vector<Vec3> plane, line;
    for (int i = 0; i < 5; ++i) {
        for (int j = 0; j < 7; ++j) plane.emplace_back(i, j, 2);
        line.emplace_back(i, 2 * i, 0);
    }
    const geometry::Spread flat = geometry::spread_of(plane);
    CHECK(flat.square[0] == doctest::Approx(0));
    CHECK(std::abs(flat.axis(2, 0)) == doctest::Approx(1));
    const geometry::Spread straight = geometry::spread_of(line);
    CHECK(straight.square[1] == doctest::Approx(0));
    CHECK(std::abs(straight.axis.col(2).dot(Vec3(1, 2, 0).normalized())) == doctest::Approx(1));
}
