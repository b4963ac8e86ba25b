// SPDX-License-Identifier: MIT
#include <lacuna/quality/quality.h>
#include <lacuna/quality/shared/prove_cells.h>

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace lacuna;

namespace {

using Corners = std::array<Vec3, 8>;

Corners cube()
{
    return {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0),
            Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(1, 1, 1), Vec3(0, 1, 1)};
}

Corners mapped(const Corners& corners, const Eigen::Affine3d& map)
{
    Corners result = corners;
    for (Vec3& corner : result) corner = map * corner;
    return result;
}

Corners shaken(std::mt19937& random, double amount)
{
    std::uniform_real_distribution<double> shift(-amount, amount);
    Corners corners = cube();
    for (Vec3& corner : corners) corner += Vec3(shift(random), shift(random), shift(random));
    return corners;
}

/// The Jacobian from derivatives of the shape functions.
double jacobian(const Corners& c, double u, double v, double w)
{
    const auto mix = [](const Vec3& a, const Vec3& b, double t) -> Vec3 { return (1 - t) * a + t * b; };
    const Vec3 du = mix(mix(c[1] - c[0], c[2] - c[3], v), mix(c[5] - c[4], c[6] - c[7], v), w);
    const Vec3 dv = mix(mix(c[3] - c[0], c[2] - c[1], u), mix(c[7] - c[4], c[6] - c[5], u), w);
    const Vec3 dw = mix(mix(c[4] - c[0], c[5] - c[1], u), mix(c[7] - c[3], c[6] - c[2], u), v);
    return du.dot(dv.cross(dw));
}

double least_sampled(const Corners& corners, int steps)
{
    double least = jacobian(corners, 0, 0, 0);
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; j <= steps; ++j)
            for (int k = 0; k <= steps; ++k)
                least = std::min(least,
                                 jacobian(corners, double(i) / steps, double(j) / steps, double(k) / steps));
    return least;
}

/// Twisted so far that the Jacobian is negative in the middle of an edge, yet positive at every corner.
Corners twisted()
{
    std::mt19937 random(7);
    for (;;) {
        Corners corners = shaken(random, 0.5);
        if (quality::scaled_jacobian(corners) > 0.01 && least_sampled(corners, 8) < -0.02) return corners;
    }
}

} // namespace

TEST_CASE("the scaled Jacobian of a box is 1, wherever it lies and however large it is")
{
    for (const double size : {1e-9, 1.0, 1e9}) {
        Eigen::Affine3d map = Eigen::Affine3d::Identity();
        map.translate(size * Vec3(3, -2, 5)).rotate(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
        map.scale(size * Vec3(1, 2, 5));
        const Corners box = mapped(cube(), map);
        CHECK(quality::scaled_jacobian(box) == doctest::Approx(1).epsilon(1e-9));
        CHECK(quality::certified_positive(box));
    }
}

TEST_CASE("the scaled Jacobian of a sheared box is the cosine of the shear, negative when turned over")
{
    for (const double degrees : {10.0, 45.0, 80.0}) {
        const double angle = degrees * EIGEN_PI / 180;
        Eigen::Affine3d shear = Eigen::Affine3d::Identity();
        shear.linear()(0, 2) = std::tan(angle);
        CHECK(quality::scaled_jacobian(mapped(cube(), shear)) == doctest::Approx(std::cos(angle)));
        shear.linear().row(2) *= -1;
        CHECK(quality::scaled_jacobian(mapped(cube(), shear)) == doctest::Approx(-std::cos(angle)));
        CHECK_FALSE(quality::certified_positive(mapped(cube(), shear)));
    }
}

TEST_CASE("cells without height, with an edge of no length or a node that is not finite are not valid")
{
    Corners flat = cube();
    for (std::size_t i = 4; i < 8; ++i) flat[i].z() = 0;
    Corners joined = cube();
    joined[1] = joined[0];
    Corners nowhere = cube();
    nowhere[6].y() = std::nan("");
    Corners endless = cube();
    endless[3].x() = std::numeric_limits<double>::infinity();
    for (const Corners& corners : {flat, joined, nowhere, endless}) {
        CHECK(quality::scaled_jacobian(corners) == 0);
        CHECK_FALSE(quality::certified_positive(corners));
    }
}

TEST_CASE("the certificate finds a cell that is invalid between corners that are not")
{
    const Corners corners = twisted();
    REQUIRE(quality::scaled_jacobian(corners) > 0);
    REQUIRE(least_sampled(corners, 8) < 0);
    CHECK_FALSE(quality::certified_positive(corners));
}

TEST_CASE(
    "over random cells, certified means no sample is negative, and a negative sample means not certified")
{
    std::mt19937 random(1);
    int certified = 0;
    int hidden = 0; // invalid, though every corner is positive
    int deep = 0;   // valid, though only found so by cutting the cell
    for (int trial = 0; trial < 6000; ++trial) {
        const Corners corners = shaken(random, 0.2 + 0.4 * (trial % 7) / 7);
        const bool valid = quality::certified_positive(corners);
        const double least = least_sampled(corners, 10);
        const bool agrees = valid ? least > 0 : true;
        CHECK(agrees);
        if (least <= 0) CHECK_FALSE(valid);
        if (valid) ++certified;
        if (least <= 0 && quality::scaled_jacobian(corners) > 0) ++hidden;
        if (valid && !quality::certified_positive(corners, 0)) ++deep;
        // Nothing valid by a margin is refused.
        if (least > 1e-2) CHECK(valid);
    }
    CHECK(certified > 1000);
    CHECK(hidden >= 3);
    CHECK(deep > 10);
}

TEST_CASE("cells that need cutting are decided side by side as each is alone")
{
    std::mt19937 random(17);
    std::vector<Vec3> nodes;
    std::vector<Hex> hexes;
    std::size_t refused = 0;
    const auto decide = [&] {
        CHECK(quality::measure_cells(nodes, hexes).uncertified == refused);
        nodes.clear();
        hexes.clear();
        refused = 0;
    };
    int hard = 0;
    for (int trial = 0; trial < 200000; ++trial) {
        Corners corners = shaken(random, 0.5);
        if (quality::scaled_jacobian(corners) <= 0 || quality::certified_positive(corners, 0)) continue;
        const double scale = ++hard % 50 == 0 ? 1e103 : 1; // whose coefficients are past the largest number
        for (Vec3& corner : corners) corner *= scale;
        hexes.emplace_back();
        for (Index& node : hexes.back()) {
            node = static_cast<Index>(nodes.size());
            nodes.push_back(corners[nodes.size() % 8]);
        }
        refused += quality::certified_positive(corners) ? 0 : 1;
        if (hexes.size() == 7) decide();
    }
    decide();
    CHECK(hard > 1000);
}

TEST_CASE(
    "a cell valid at its corners and negative in a spot inside an edge, a side or its middle is refused")
{
    std::mt19937 random(11);
    int on_edge = 0;
    int inside = 0;
    for (int trial = 0; trial < 300000 && (on_edge < 30 || inside < 30); ++trial) {
        const Corners corners = shaken(random, 0.5);
        if (quality::scaled_jacobian(corners) <= 0 || quality::certified_positive(corners)) continue;
        // Refused with positive corners: a spot of the cell must show why.
        double least = jacobian(corners, 0, 0, 0);
        bool at_edge = false;
        constexpr int kSteps = 40;
        for (int i = 0; i <= kSteps; ++i) {
            for (int j = 0; j <= kSteps; ++j) {
                for (int k = 0; k <= kSteps; ++k) {
                    const double here = jacobian(corners, double(i) / kSteps, double(j) / kSteps,
                                                 double(k) / kSteps);
                    if (here >= least) continue;
                    least = here;
                    at_edge = (i % kSteps == 0) + (j % kSteps == 0) + (k % kSteps == 0) == 2;
                }
            }
        }
        CHECK(least < 1e-3);
        ++(at_edge ? on_edge : inside);
    }
    CHECK(on_edge >= 30);
}

TEST_CASE("cells that are valid by a hair are accepted, and refused once they are not")
{
    // One corner pushed along the diagonal into the cell: flat where it lies in the plane of its neighbours.
    for (const double margin : {1e-2, 1e-4, 1e-6, 1e-9}) {
        Corners dented = cube();
        // The three corners beside corner 6 span the plane x + y + z = 2.
        dented[6] = Vec3::Constant(2.0 / 3 + margin);
        CHECK(quality::certified_positive(dented));
        dented[6] = Vec3::Constant(2.0 / 3 - margin);
        CHECK_FALSE(quality::certified_positive(dented));
    }
    // Flattened and stretched by powers of two, which round nothing: the verdict does not change.
    std::mt19937 random(13);
    for (const double flat : {0x1p-10, 0x1p-20, 0x1p-30}) {
        int valid = 0;
        for (int trial = 0; trial < 2000; ++trial) {
            const Corners corners = shaken(random, 0.5);
            Eigen::Affine3d map = Eigen::Affine3d::Identity();
            map.scale(Vec3(1, 1 / flat, flat));
            const bool expected = quality::certified_positive(corners);
            CHECK(quality::certified_positive(mapped(corners, map)) == expected);
            if (expected) ++valid;
        }
        CHECK(valid > 500);
    }
    // Twisted about its axis: valid below 90 degrees, and every corner flat at 90.
    for (const double degrees : {1.0, 45.0, 89.0, 89.99}) {
        Corners twist = cube();
        const Eigen::AngleAxisd turn(degrees * EIGEN_PI / 180, Vec3::UnitZ());
        for (std::size_t i = 4; i < 8; ++i) {
            const Vec3 middle(0.5, 0.5, 0);
            twist[i] = turn * (twist[i] - middle) + middle;
        }
        CHECK(quality::certified_positive(twist));
    }
}

TEST_CASE(
    "a cell is judged alike alone, in a list of its kind and by its coefficients, however little it turns")
{
    std::mt19937 random(23);
    int kept = 0, refused = 0;
    for (int trial = 0; trial < 200; ++trial) {
        // The four edges of a cell are alike, but for some share; a cell of a thousandth is nearly a box.
        const double amount = 0.6 * std::pow(10, -3.0 * (trial % 20) / 20), flat = trial % 3 == 0 ? 1e-4 : 1;
        std::vector<Vec3> nodes;
        std::vector<Hex> hexes;
        double volume = 0;
        std::size_t positive = 0;
        for (int cell = 0; cell < 40; ++cell) {
            Corners corners = shaken(random, amount);
            for (Vec3& corner : corners) corner.z() *= flat;
            Hex hex;
            for (std::size_t i = 0; i < 8; ++i) hex[i] = static_cast<Index>(nodes.size() + i);
            nodes.insert(nodes.end(), corners.begin(), corners.end());
            const auto alone = quality::measure_cells(corners, std::vector<Hex>{{0, 1, 2, 3, 4, 5, 6, 7}});
            hexes.push_back(hex);
            const bool valid = quality::scaled_jacobian(corners) > 0 && quality::certified_positive(corners);
            CHECK((alone.uncertified == 0) == valid);
            volume += alone.volume;
            positive += valid ? 1 : 0;
            // A Jacobian is of degree two: three points a direction integrate it exactly.
            double sampled = 0;
            constexpr std::array kWeights{1.0 / 6, 4.0 / 6, 1.0 / 6};
            for (std::size_t p = 0; p < 27; ++p)
                sampled += kWeights[p % 3] * kWeights[p / 3 % 3] * kWeights[p / 9] *
                           jacobian(corners, double(p % 3) / 2, double(p / 3 % 3) / 2, double(p / 9) / 2);
            CHECK(alone.volume == doctest::Approx(sampled).epsilon(1e-12).scale(flat));
        }
        const auto together = quality::measure_cells(nodes, hexes);
        CHECK(together.uncertified == hexes.size() - positive);
        CHECK(together.volume == doctest::Approx(volume).epsilon(1e-12).scale(flat));
        kept += static_cast<int>(positive);
        refused += static_cast<int>(together.uncertified);
    }
    CHECK(kept > 1000);
    CHECK(refused > 100);
}

TEST_CASE("more cutting never takes back a certificate")
{
    std::mt19937 random(17);
    int gained = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const Corners corners = shaken(random, 0.5);
        bool before = false;
        for (int depth = 0; depth <= 6; ++depth) {
            const bool now = quality::certified_positive(corners, depth);
            CHECK((now || !before));
            if (now && !before && depth > 0) ++gained;
            before = now;
        }
    }
    CHECK(gained > 50);
}

TEST_CASE("a corner that is flat but for rounding makes a cell inverted")
{
    Corners corners = cube();
    corners[0] = {0.5, 0.5 - 1e-15, 0};
    corners[4] = {0.5, 0.5 - 1e-15, 1};
    REQUIRE(quality::scaled_jacobian(corners) > 0);
    CHECK(quality::scaled_jacobian(corners) < 1e-14);
    const std::vector<Vec3> nodes(corners.begin(), corners.end());
    const std::vector<Hex> cells{{0, 1, 2, 3, 4, 5, 6, 7}};
    CHECK(quality::prove_cells(nodes, cells).quality.inverted == 1);
}
