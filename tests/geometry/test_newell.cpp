// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/geometry/newell.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace lacuna;
using namespace lacuna::geometry;

namespace {

std::vector<Vec3> wavy_ring(int count, double radius, const Vec3& centre = Vec3::Zero(), double wave = 0)
{
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        points.push_back(
            centre + Vec3(radius * std::cos(angle), radius * std::sin(angle), wave * std::cos(3 * angle)));
    }
    return points;
}

Eigen::Affine3d random_motion(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    const Eigen::Quaterniond turn(normal(random), normal(random), normal(random), normal(random));
    return Eigen::Translation3d(10 * normal(random), 10 * normal(random), 10 * normal(random)) *
           turn.normalized();
}

std::vector<Vec3> moved(const Eigen::Affine3d& motion, std::vector<Vec3> points)
{
    for (Vec3& point : points) point = motion * point;
    return points;
}

void check_axes(const Plane& plane)
{
    CHECK(plane.u.norm() == doctest::Approx(1));
    CHECK(plane.v.norm() == doctest::Approx(1));
    CHECK(plane.normal.norm() == doctest::Approx(1));
    CHECK(std::abs(plane.u.dot(plane.v)) < 1e-14);
    CHECK((plane.u.cross(plane.v) - plane.normal).norm() < 1e-14);
}

} // namespace

TEST_CASE("a planar loop's Newell vector is its area along its normal, wherever it lies and starts")
{
    std::mt19937 random(1);
    for (int count = 3; count < 30; ++count) {
        const double area = 0.5 * count * 4 * std::sin(2 * std::numbers::pi / count);
        const auto motion = random_motion(random);
        auto points = moved(motion, wavy_ring(count, 2));
        const Vec3 expected = area * (motion.linear() * Vec3::UnitZ());
        CHECK((newell_vector(points) - expected).norm() < 1e-12 * area);
        std::rotate(points.begin(), points.begin() + count / 2, points.end());
        CHECK((newell_vector(points) - expected).norm() < 1e-12 * area);
        std::reverse(points.begin(), points.end());
        CHECK((newell_vector(points) + expected).norm() < 1e-12 * area);
    }
}

TEST_CASE("the Newell vector of a surface's rim is the sum of its triangles' area vectors")
{
    std::mt19937 random(2);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int trial = 0; trial < 20; ++trial) {
        auto rim = wavy_ring(12, 1, Vec3(1e3, -1e3, 0), 0.4);
        const Vec3 tip(1e3 + any(random), -1e3 + any(random), any(random));
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < rim.size(); ++i)
            sum += 0.5 * (rim[i] - tip).cross(rim[(i + 1) % rim.size()] - tip);
        CHECK((newell_vector(rim) - sum).norm() < 1e-12);
    }
}

TEST_CASE("to the plane and back is the identity, and the axes are right-handed")
{
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 50; ++trial) {
        const std::vector<std::vector<Vec3>> loops{
            moved(random_motion(random), wavy_ring(9, 3, {1, 2, 3}, 0.5))};
        const Plane plane = newell_plane(loops);
        check_axes(plane);
        const Vec3 point(normal(random), normal(random), normal(random));
        const Vec3 back = from_plane(plane, to_plane(plane, point), height(plane, point));
        CHECK((back - point).norm() < 1e-13 * (point - plane.origin).norm());
        CHECK(std::abs(height(plane, plane.origin)) < 1e-14);
    }
}

TEST_CASE("holes leave the normal as it is, and planar loops lie in their plane")
{
    std::mt19937 random(4);
    for (int trial = 0; trial < 20; ++trial) {
        const auto motion = random_motion(random);
        auto hole = wavy_ring(8, 0.5, {0.7, 0, 0});
        std::reverse(hole.begin(), hole.end());
        const std::vector<std::vector<Vec3>> loops{moved(motion, wavy_ring(20, 2)), moved(motion, hole)};
        const Plane plane = newell_plane(loops);
        CHECK((plane.normal - motion.linear() * Vec3::UnitZ()).norm() < 1e-13);
        for (const auto& loop : loops)
            for (const Vec3& point : loop) CHECK(std::abs(height(plane, point)) < 1e-13);
    }
}

TEST_CASE("a loop that encloses no area gets the plane it lies in")
{
    std::mt19937 random(5);
    for (int trial = 0; trial < 20; ++trial) {
        const auto motion = random_motion(random);
        // A figure of eight, whose two halves cancel.
        std::vector<Vec3> eight;
        for (int i = 0; i < 24; ++i) {
            const double angle = 2 * std::numbers::pi * i / 24;
            eight.emplace_back(std::sin(angle), std::sin(2 * angle), 0);
        }
        const std::vector<std::vector<Vec3>> loops{moved(motion, eight)};
        const Plane plane = newell_plane(loops);
        check_axes(plane);
        CHECK(std::abs(plane.normal.dot(motion.linear() * Vec3::UnitZ())) == doctest::Approx(1));
    }
    const std::vector<std::vector<Vec3>> line{{Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2)}};
    const Plane plane = newell_plane(line);
    check_axes(plane);
    CHECK(std::abs(height(plane, Vec3(5, 5, 5))) < 1e-14);
    CHECK_THROWS_AS(newell_plane(std::vector<std::vector<Vec3>>{}), InvalidInput);
}
