// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/minimal_frame.h>

#include <doctest/doctest.h>

#include <Eigen/LU>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

using namespace lacuna;
using geometry::fit_affine;
using geometry::fit_rigid;

namespace {

using Points = std::vector<Vec3>;

Points random_points(std::mt19937& random, std::size_t count, const Vec3& extent)
{
    std::uniform_real_distribution<double> unit(-1, 1);
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
        points.emplace_back(extent[0] * unit(random), extent[1] * unit(random), extent[2] * unit(random));
    }
    return points;
}

Eigen::Matrix3d random_rotation(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
        .normalized()
        .toRotationMatrix();
}

Points ring(std::size_t count, double wave = 0)
{
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
        points.emplace_back(std::cos(angle), std::sin(angle), wave * std::cos(2 * angle));
    }
    return points;
}

template <class Map>
Points mapped(const Points& points, const Map& map)
{
    Points result;
    for (const Vec3& p : points) result.push_back(map(p));
    return result;
}

Vec3 area_of(const Points& loop)
{
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i) area += 0.5 * loop[i].cross(loop[(i + 1) % loop.size()]);
    return area;
}

} // namespace

TEST_CASE("an affine map of points that fill space is found again")
{
    std::mt19937 random(1);
    for (int trial = 0; trial < 50; ++trial) {
        const Points from = random_points(random, 4 + static_cast<std::size_t>(trial), {1, 2, 3});
        const Eigen::Matrix3d linear = Eigen::Matrix3d::Random();
        const Vec3 shift = Vec3::Random();
        const auto fit = fit_affine(from,
                                    mapped(from, [&](const Vec3& p) { return Vec3(linear * p + shift); }));
        CHECK(fit.rank == 3);
        CHECK(fit.rms < 1e-13);
        CHECK((fit.linear - linear).norm() < 1e-11);
        const Vec3 far(7, -8, 9);
        CHECK((fit(far) - (linear * far + shift)).norm() < 1e-10);
    }
}

TEST_CASE(
    "points on a plane under a similarity carry what lies off the plane, with and without pseudo-normals")
{
    std::mt19937 random(2);
    for (const double scale : {0.1, 1.0, 10.0}) {
        for (int trial = 0; trial < 20; ++trial) {
            const Eigen::Matrix3d turn = random_rotation(random);
            const Vec3 shift = Vec3::Random();
            const auto map = [&](const Vec3& p) { return Vec3(scale * (turn * p) + shift); };
            const Points from = ring(12);
            const Points to = mapped(from, map);
            const Vec3 off(0.2, 0.1, 0.7);
            const auto completed = fit_affine(from, to);
            CHECK(completed.rank == 2);
            CHECK((completed(off) - map(off)).norm() < 1e-12 * std::max(1.0, scale));
            const auto paired = fit_affine(from, to, area_of(from), area_of(to));
            CHECK(paired.rank == 3);
            CHECK((paired(off) - map(off)).norm() < 1e-12 * std::max(1.0, scale));
        }
    }
}

TEST_CASE("a planar rim that is sheared stays right-handed and of full rank")
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int trial = 0; trial < 50; ++trial) {
        Eigen::Matrix3d linear = random_rotation(random);
        linear.col(0) *= 0.2 + std::abs(unit(random));
        linear.col(1) += unit(random) * linear.col(0);
        const Points from = ring(9);
        const Points to = mapped(from, [&](const Vec3& p) { return Vec3(linear * p); });
        const auto fit = fit_affine(from, to, area_of(from), area_of(to));
        CHECK(fit.max_residual < 1e-13);
        CHECK(fit.linear.determinant() > 1e-3);
        CHECK(fit.linear.col(2).norm() ==
              doctest::Approx(std::sqrt(area_of(to).norm() / area_of(from).norm())));
    }
}

TEST_CASE("rounding out of the plane, or a rim that waves the other way, does not flip the bulge")
{
    for (const double wave : {1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.1, 0.3}) {
        CAPTURE(wave);
        const Points from = ring(24, wave);
        for (const double other : {-wave, 0.0, -0.5 * wave, 1e3 * wave < 0.3 ? 1e3 * wave : wave}) {
            CAPTURE(other);
            const Points to = ring(24, other);
            const auto fit = fit_affine(from, to, area_of(from), area_of(to));
            const Vec3 top = fit(Vec3(0, 0, 0.5));
            CHECK(top[2] > 0.3);
            CHECK(top[2] < 0.7);
        }
    }
}

TEST_CASE("points on a line turn by the smallest rotation and keep their spread")
{
    const Points from{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
    const Points to{{0, 0, 1}, {0, 2, 1}, {0, 6, 1}};
    const auto fit = fit_affine(from, to);
    CHECK(fit.rank == 1);
    CHECK(fit.max_residual < 1e-14);
    CHECK(fit.linear.determinant() == doctest::Approx(8));
    CHECK((fit.linear * Vec3::UnitZ() - 2 * Vec3::UnitZ()).norm() < 1e-14);
}

TEST_CASE("points in one place are moved as they are")
{
    const Points from(4, Vec3(1, 1, 1));
    const Points to(4, Vec3(2, 0, 1));
    const auto fit = fit_affine(from, to);
    CHECK(fit.rank == 0);
    CHECK((fit(Vec3(1, 1, 2)) - Vec3(2, 0, 2)).norm() < 1e-15);
}

TEST_CASE("the least-squares fit is no worse than its neighbours")
{
    std::mt19937 random(4);
    for (int trial = 0; trial < 20; ++trial) {
        const Points from = random_points(random, 10, {1, 1, 1});
        const Points to = random_points(random, 10, {1, 1, 1});
        const auto fit = fit_affine(from, to);
        for (int nudge = 0; nudge < 9; ++nudge) {
            for (const double step : {-1e-3, 1e-3}) {
                auto other = fit;
                other.linear(nudge / 3, nudge % 3) += step;
                double sum = 0;
                for (std::size_t i = 0; i < from.size(); ++i) sum += (other(from[i]) - to[i]).squaredNorm();
                CHECK(std::sqrt(sum / 10) > fit.rms);
            }
        }
    }
}

TEST_CASE("reach counts spreads, and is infinite off a planar set")
{
    const Points rim = ring(16);
    const geometry::AffineFitter fitter(rim);
    CHECK(fitter.reach(Vec3::Zero()) < 1e-12);
    CHECK(fitter.reach(rim[3]) == doctest::Approx(std::sqrt(2.0)));
    CHECK(std::isinf(fitter.reach(Vec3(0, 0, 0.1))));
}

TEST_CASE("a rigid motion is found again, with its scale where asked for")
{
    std::mt19937 random(5);
    for (const double flat : {1.0, 0.0}) {
        for (int trial = 0; trial < 30; ++trial) {
            const double scale = trial % 2 == 0 ? 1.0 : 2.5;
            const Eigen::Matrix3d turn = random_rotation(random);
            const Vec3 shift = Vec3::Random();
            const Points from = random_points(random, 8, {1, 2, flat});
            const Points to = mapped(from, [&](const Vec3& p) { return Vec3(scale * (turn * p) + shift); });
            const auto fit = fit_rigid(from, to, true);
            CHECK(fit.rms < 1e-13);
            CHECK(fit.scale == doctest::Approx(scale));
            CHECK((fit.rotation - turn).norm() < 1e-10);
            CHECK((fit.translation - shift).norm() < 1e-10);
            const auto plain = fit_rigid(from, to, false);
            CHECK(plain.scale == 1);
            CHECK((plain.rms < 1e-13) == (scale == 1));
        }
    }
}

TEST_CASE("a mirrored set is never fitted by a reflection")
{
    std::mt19937 random(6);
    for (int trial = 0; trial < 20; ++trial) {
        const Points from = random_points(random, 8, {1, 1, 1});
        const Points to = mapped(from, [](const Vec3& p) { return Vec3(p[0], p[1], -p[2]); });
        for (const bool with_scale : {false, true}) {
            const auto fit = fit_rigid(from, to, with_scale);
            CHECK(fit.rotation.determinant() == doctest::Approx(1));
            CHECK(fit.rms > 0.01);
        }
    }
}

TEST_CASE("points on a line or in one place give a proper rotation")
{
    const Points line{{1, 0, 0}, {2, 0, 0}, {4, 0, 0}};
    const Points other{{0, 0, 1}, {0, 0, 2}, {0, 0, 4}};
    const auto fit = fit_rigid(line, other, false);
    CHECK(fit.rms < 1e-14);
    CHECK(fit.rotation.determinant() == doctest::Approx(1));
    CHECK((fit.rotation * Vec3::UnitY() - Vec3::UnitY()).norm() < 1e-14);

    const Points spot(3, Vec3(1, 2, 3));
    const auto still = fit_rigid(spot, line, true);
    CHECK(still.rotation.isIdentity());
    CHECK(std::isfinite(still.rms));
}

TEST_CASE("the smallest rotation maps a direction onto another, also onto the opposite one")
{
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 1000; ++i) {
        const Vec3 from(normal(random), normal(random), normal(random));
        const Vec3 off(normal(random), normal(random), normal(random));
        for (const Vec3& to :
             {off, Vec3(-2 * from), Vec3(-2 * from + 1e-7 * off), Vec3(-2 * from + 1e-12 * off)}) {
            const Eigen::Matrix3d turn = geometry::least_turn(from, to);
            CHECK((turn * from.normalized() - to.normalized()).norm() < 1e-9);
            CHECK((turn * turn.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-9);
            CHECK(turn.determinant() > 0);
        }
    }
}
