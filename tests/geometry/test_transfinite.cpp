// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/transfinite.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

using namespace lacuna;
using namespace lacuna::geometry;

namespace {

using Grid = std::vector<Vec3>;

/// Sides of the patch that `map` sends the unit square to, at the given parameters.
struct Sides {
    Grid bottom, right, top, left;
};

Sides sides_of(const std::function<Vec3(double, double)>& map, const std::vector<double>& s,
               const std::vector<double>& t)
{
    Sides sides;
    for (const double x : s) {
        sides.bottom.push_back(map(x, 0));
        sides.top.push_back(map(x, 1));
    }
    for (const double y : t) {
        sides.left.push_back(map(0, y));
        sides.right.push_back(map(1, y));
    }
    return sides;
}

std::vector<double> spacing(int count, double ratio)
{
    std::vector<double> result{0};
    double step = 1;
    for (int i = 0; i < count; ++i, step *= ratio) result.push_back(result.back() + step);
    const double last = result.back();
    for (double& x : result) x /= last;
    return result;
}

Grid grid_of(const Sides& sides) { return transfinite(sides.bottom, sides.right, sides.top, sides.left); }

} // namespace

TEST_CASE("the sides of a transfinite grid come back bit for bit")
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto bumpy = [&](double s, double t) {
        return Vec3(s + 0.1 * std::sin(7 * t), t + 0.1 * std::cos(5 * s), std::sin(3 * s) * std::cos(2 * t));
    };
    for (int n = 1; n < 7; ++n) {
        for (int m = 1; m < 7; ++m) {
            Sides sides = sides_of(bumpy, spacing(n, 1.3), spacing(m, 0.8));
            for (Grid* side : {&sides.bottom, &sides.right, &sides.top, &sides.left})
                for (std::size_t i = 1; i + 1 < side->size(); ++i)
                    (*side)[i] += 0.01 * Vec3(any(random), 0, 0);
            const Grid grid = grid_of(sides);
            const auto at = [&](int i, int j) { return grid[static_cast<std::size_t>(j * (n + 1) + i)]; };
            REQUIRE(grid.size() == static_cast<std::size_t>((n + 1) * (m + 1)));
            for (int i = 0; i <= n; ++i) {
                CHECK(at(i, 0) == sides.bottom[static_cast<std::size_t>(i)]);
                CHECK(at(i, m) == sides.top[static_cast<std::size_t>(i)]);
            }
            for (int j = 0; j <= m; ++j) {
                CHECK(at(0, j) == sides.left[static_cast<std::size_t>(j)]);
                CHECK(at(n, j) == sides.right[static_cast<std::size_t>(j)]);
            }
        }
    }
}

TEST_CASE("straight sides give the bilinear grid, graded as they are")
{
    const Vec3 c0(100, 200, 300), c1(104, 201, 300), c2(105, 207, 302), c3(99, 205, 301);
    const auto bilinear = [&](double s, double t) {
        return Vec3((1 - s) * (1 - t) * c0 + s * (1 - t) * c1 + s * t * c2 + (1 - s) * t * c3);
    };
    for (const double ratio : {1.0, 1.2, 0.5}) {
        const auto s = spacing(6, ratio), t = spacing(9, 1 / ratio);
        const Grid grid = grid_of(sides_of(bilinear, s, t));
        for (std::size_t j = 0; j < t.size(); ++j)
            for (std::size_t i = 0; i < s.size(); ++i)
                CHECK((grid[j * s.size() + i] - bilinear(s[i], t[j])).norm() < 1e-12);
    }
}

TEST_CASE("a translated side leaves every grid line its translate")
{
    const auto extruded = [](double s, double t) -> Vec3 {
        return Vec3(std::cos(3 * s), std::sin(3 * s), 0.2 * std::cos(9 * s)) + t * Vec3(0.3, 0.1, 4);
    };
    const auto s = spacing(11, 1.1), t = spacing(5, 1);
    const Grid grid = grid_of(sides_of(extruded, s, t));
    for (std::size_t j = 0; j < t.size(); ++j)
        for (std::size_t i = 0; i < s.size(); ++i)
            CHECK((grid[j * s.size() + i] - extruded(s[i], t[j])).norm() < 1e-12);
}

TEST_CASE("sides of opposite grading give a grid that does not fold")
{
    for (const double ratio : {1.5, 2.0, 4.0}) {
        const auto s0 = spacing(8, ratio), s1 = spacing(8, 1 / ratio);
        Sides sides = sides_of([](double x, double y) { return Vec3(x, y, 0); }, s0, s1);
        for (std::size_t i = 0; i < s1.size(); ++i) {
            sides.top[i].x() = s1[i];
            sides.right[i].y() = s0[i];
        }
        const Grid grid = grid_of(sides);
        const std::size_t row = s0.size();
        for (std::size_t j = 0; j + 1 < row; ++j)
            for (std::size_t i = 0; i + 1 < row; ++i) {
                const Vec3& p = grid[j * row + i];
                CHECK((grid[j * row + i + 1] - p).cross(grid[(j + 1) * row + i] - p).z() > 0);
            }
    }
}

TEST_CASE("affine maps go through, and turning the patch over turns the grid over")
{
    const auto bumpy = [](double s, double t) {
        return Vec3(s + 0.2 * t * t, t + 0.2 * std::sin(3 * s), s * s - t * s);
    };
    const Sides sides = sides_of(bumpy, spacing(5, 1.3), spacing(7, 1));
    const Grid grid = grid_of(sides);

    // A similarity: arc lengths scale alike.
    const Eigen::Affine3d motion = Eigen::Translation3d(1, 2, 3) *
                                   Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()) * Eigen::Scaling(2.5);
    Sides turned = sides;
    for (Grid* side : {&turned.bottom, &turned.right, &turned.top, &turned.left})
        for (Vec3& point : *side) point = motion * point;
    const Grid turned_grid = grid_of(turned);
    for (std::size_t i = 0; i < grid.size(); ++i) CHECK((turned_grid[i] - motion * grid[i]).norm() < 1e-13);

    const Grid transposed = transfinite(sides.left, sides.top, sides.right, sides.bottom);
    for (std::size_t j = 0; j < 8; ++j)
        for (std::size_t i = 0; i < 6; ++i) CHECK((transposed[i * 8 + j] - grid[j * 6 + i]).norm() < 1e-14);
}

TEST_CASE("a side of no length makes a fan")
{
    const auto s = spacing(6, 1), t = spacing(4, 1);
    const Grid grid = grid_of(sides_of([](double x, double y) { return Vec3(x * (1 - y), y, 0); }, s, t));
    for (std::size_t j = 0; j < t.size(); ++j)
        for (std::size_t i = 0; i < s.size(); ++i)
            CHECK((grid[j * s.size() + i] - Vec3(s[i] * (1 - t[j]), t[j], 0)).norm() < 1e-14);
}

TEST_CASE("sides that do not fit are refused")
{
    const auto square = [](double x, double y) { return Vec3(x, y, 0); };
    const Sides good = sides_of(square, spacing(3, 1), spacing(2, 1));
    Sides bad = good;
    bad.top.pop_back();
    CHECK_THROWS_AS(grid_of(bad), InvalidInput);
    bad = good;
    bad.left.front().x() = 0.5;
    CHECK_THROWS_AS(grid_of(bad), InvalidInput);
    bad = good;
    std::reverse(bad.right.begin(), bad.right.end());
    CHECK_THROWS_AS(grid_of(bad), InvalidInput);
    CHECK_NOTHROW(grid_of(good));
}

TEST_CASE("a grid in the plane is that in space, and the patch passes through its nodes where sides agree")
{
    const auto bumpy = [](double s, double t) { return Vec3(s + 0.1 * std::sin(7 * t), t + 0.1 * s * s, 0); };
    const Sides sides = sides_of(bumpy, spacing(5, 1.2), spacing(4, 1));
    const auto flat = [](const Grid& side) {
        std::vector<Vec2> points;
        for (const Vec3& p : side) points.emplace_back(p.x(), p.y());
        return points;
    };
    const std::vector<Vec2> bottom = flat(sides.bottom), right = flat(sides.right), top = flat(sides.top),
                            left = flat(sides.left);
    const std::vector<Vec2> plane = transfinite(bottom, right, top, left);
    CHECK(plane == flat(grid_of(sides)));
    const CoonsPatch<Vec2> patch(bottom, right, top, left);
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK((patch({patch.bottom(i), 0}) - bottom[i]).norm() < 1e-14);
        CHECK((patch({patch.top(i), 1}) - top[i]).norm() < 1e-14);
    }
    CHECK((patch(patch.crossing(2, 2, 1, 1)) - plane[1 * 6 + 2]).norm() < 0.02);
}
