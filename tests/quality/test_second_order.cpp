// SPDX-License-Identifier: MIT
#include <lacuna/quality/shared/second_order.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace lacuna;

namespace {

using Cell = std::array<Vec3, 27>;

/// Place of each node in the unit cube, in the order of `mesh::CellNodes`.
Cell unit_cube()
{
    std::array<Vec3, 8> corners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0),
                                Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(1, 1, 1), Vec3(0, 1, 1)};
    return mesh::as_hex27(corners);
}

double shape(double at, double t)
{
    if (at == 0) return (1 - t) * (1 - 2 * t);
    return at == 1 ? t * (2 * t - 1) : 4 * t * (1 - t);
}
double slope(double at, double t)
{
    if (at == 0) return 4 * t - 3;
    return at == 1 ? 4 * t - 1 : 4 - 8 * t;
}

/// The Jacobian in the plainest way: a sum over the nodes.
double jacobian(const Cell& cell, const Vec3& t)
{
    static const Cell kCube = unit_cube();
    Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
    for (std::size_t n = 0; n < 27; ++n) {
        const Vec3& at = kCube[n];
        m.col(0) += cell[n] * slope(at.x(), t.x()) * shape(at.y(), t.y()) * shape(at.z(), t.z());
        m.col(1) += cell[n] * shape(at.x(), t.x()) * slope(at.y(), t.y()) * shape(at.z(), t.z());
        m.col(2) += cell[n] * shape(at.x(), t.x()) * shape(at.y(), t.y()) * slope(at.z(), t.z());
    }
    return m.determinant();
}

double least_sampled(const Cell& cell, int n = 16)
{
    double least = 1e300;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            for (int k = 0; k <= n; ++k) least = std::min(least, jacobian(cell, Vec3(i, j, k) / n));
    return least;
}

/// Cubes whose nodes are moved by up to `by`; of hex20, what is in the middle of faces follows.
Cell random_cell(std::mt19937& dice, double by, bool full)
{
    std::uniform_real_distribution<double> step(-by, by);
    Cell cell = unit_cube();
    for (Vec3& p : cell) p += Vec3(step(dice), step(dice), step(dice));
    return full ? cell : mesh::as_hex27(std::span(cell).first<20>());
}

} // namespace

TEST_CASE("a cell is certified only where dense samples of the Jacobian are positive")
{
    std::mt19937 dice(7);
    int valid = 0, invalid = 0, unsure = 0;
    for (const double by : {0.02, 0.06, 0.1, 0.15, 0.25}) {
        for (int i = 0; i < 60; ++i) {
            const Cell cell = random_cell(dice, by, i % 2 == 0);
            const quality::CurvedCell judged = quality::judge(cell);
            const double least = least_sampled(cell);
            if (judged.positive) {
                CHECK(least > 0);
                CHECK(judged.scaled_jacobian > 0);
                ++valid;
            } else if (least <= 0) {
                ++invalid;
            } else {
                ++unsure; // between the samples, or nearly
                CHECK(least_sampled(cell, 64) < 0.05);
            }
            CHECK(judged.bound * judged.volume <= least + 1e-9);
        }
    }
    CHECK(valid > 100);
    CHECK(invalid > 50);
    CHECK(unsure < 6);
}

TEST_CASE("the volume of a curved cell is the integral of its Jacobian")
{
    std::mt19937 dice(3);
    for (int i = 0; i < 20; ++i) {
        const Cell cell = random_cell(dice, 0.1, i % 2 == 0);
        // Three Gauss points a direction are exact up to degree five.
        const double off = std::sqrt(0.15);
        double volume = 0;
        for (int a = -1; a <= 1; ++a)
            for (int b = -1; b <= 1; ++b)
                for (int c = -1; c <= 1; ++c) {
                    const double weight = (a == 0 ? 8 : 5) * (b == 0 ? 8 : 5) * (c == 0 ? 8 : 5) / 5832.0;
                    volume += weight * jacobian(cell, Vec3(0.5 + a * off, 0.5 + b * off, 0.5 + c * off));
                }
        CHECK(quality::judge(cell).volume == doctest::Approx(volume).epsilon(1e-12));
    }
}

TEST_CASE("a middle node past the quarter of its side makes a cell invalid, one before it does not")
{
    for (const double at : {0.3, 0.27, 0.26, 0.24, 0.2, 0.1}) {
        CAPTURE(at);
        Cell cell = unit_cube();
        for (const std::size_t n : {8, 10, 12, 14}) cell[n].x() = at;
        CHECK(quality::judge(mesh::as_hex27(std::span(cell).first<20>())).positive == (at > 0.25));
    }
}

TEST_CASE("a face that bulges through the one across makes a cell invalid though its corners are fine")
{
    Cell cell = unit_cube();
    for (const std::size_t n : {8, 11}) cell[n].z() = 0.45;
    cell[24].z() = 1.3;
    const quality::CurvedCell judged = quality::judge(cell);
    CHECK_FALSE(judged.positive);
    CHECK(quality::certified_positive(std::span<const Vec3>(cell).first<8>()));
}

TEST_CASE("what is judged does not depend on place, size or turn")
{
    std::mt19937 dice(11);
    for (int i = 0; i < 50; ++i) {
        const Cell cell = random_cell(dice, 0.12, true);
        const quality::CurvedCell before = quality::judge(cell);
        Eigen::AngleAxisd turn(1.1, Vec3(1, 2, 3).normalized());
        Cell moved = cell;
        for (Vec3& p : moved) p = turn * (40 * p) + Vec3(1000, -2000, 500);
        const quality::CurvedCell after = quality::judge(moved);
        CHECK(after.positive == before.positive);
        CHECK(after.scaled_jacobian == doctest::Approx(before.scaled_jacobian).epsilon(1e-8));
        CHECK(after.volume == doctest::Approx(64000 * before.volume).epsilon(1e-8));
    }
}

TEST_CASE("straight cells of order 2 are measured as cells of order 1")
{
    std::mt19937 dice(5);
    std::uniform_real_distribution<double> step(-0.2, 0.2);
    std::vector<Vec3> nodes;
    std::vector<Hex> hexes;
    std::vector<mesh::CellNodes> twenties, all;
    for (int i = 0; i < 40; ++i) {
        Cell cell = unit_cube();
        for (std::size_t n = 0; n < 8; ++n) cell[n] += Vec3(step(dice), step(dice), step(dice));
        cell = mesh::as_hex27(std::span(cell).first<8>());
        mesh::CellNodes numbers;
        for (const Vec3& p : cell) {
            numbers.node[numbers.count++] = static_cast<Index>(nodes.size());
            nodes.push_back(p);
        }
        std::copy_n(numbers.node.begin(), 8, hexes.emplace_back().begin());
        all.push_back(numbers);
        numbers.count = 20;
        if (i % 3 == 0) numbers.node[13] = -1;
        twenties.push_back(numbers);
    }
    const quality::Quality plain = quality::measure_cells(nodes, hexes);
    for (const auto& cells : {all, twenties}) {
        const quality::Quality quality = quality::measure_cells(nodes, cells);
        CHECK(quality.min_scaled_jacobian == plain.min_scaled_jacobian);
        CHECK(quality.volume == plain.volume);
        CHECK(quality.uncertified == plain.uncertified);
    }
}
