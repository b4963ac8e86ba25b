// SPDX-License-Identifier: MIT
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/detail/cell_energy.h>
#include <lacuna/sweep/improve.h>

#include "support/blocks.h"
#include "support/check_valid.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>
#include <span>

using namespace lacuna;

namespace {

std::vector<char> skin_nodes_of(const mesh::HexMesh& mesh)
{
    std::vector<char> skin(mesh.nodes.size(), 0);
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        for (const Index n : mesh::skin_quad(mesh, i).nodes) skin[static_cast<std::size_t>(n)] = 1;
    }
    return skin;
}

double cell_size(const mesh::HexMesh& mesh)
{
    const Hex first = mesh.hex(0);
    return (mesh.nodes[static_cast<std::size_t>(first[6])] - mesh.nodes[static_cast<std::size_t>(first[0])])
               .norm() /
           std::sqrt(3.0);
}

/// A block whose inside nodes are thrown about by `share` of a cell, its skin left alone.
mesh::HexMesh shaken(double share, unsigned seed, std::array<int, 3> cells = {6, 6, 6})
{
    mesh::HexMesh mesh = test::block({cells[0], cells[1], cells[2]});
    const std::vector<char> skin = skin_nodes_of(mesh);
    const double size = cell_size(mesh);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> throws(-share * size, share * size);
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
        if (skin[i] == 0) mesh.nodes[i] += Vec3(throws(random), throws(random), throws(random));
    }
    return mesh;
}

/// What slides where on a block whose sides lie in the planes of its box: nodes of one plane alone.
sweep::Sliding sliding_on(const mesh::HexMesh& mesh)
{
    Vec3 low = mesh.nodes.front(), high = low;
    for (const Vec3& p : mesh.nodes) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    sweep::Sliding sliding;
    for (const Vec3& p : mesh.nodes) {
        int planes = 0;
        Index on = -1;
        for (int d = 0; d < 3; ++d) {
            if (p[d] == low[d] || p[d] == high[d]) {
                ++planes;
                on = p[d] == low[d] ? 2 * d : 2 * d + 1;
            }
        }
        sliding.surface.push_back(planes == 1 ? on : -1);
    }
    sliding.project = [low, high](Index surface, std::span<Vec3> points) {
        const int d = surface / 2;
        for (Vec3& p : points) p[d] = surface % 2 == 0 ? low[d] : high[d];
    };
    return sliding;
}

} // namespace

TEST_CASE(
    "a block with its inside shaken until cells fold is valid again after untangling, its skin untouched")
{
    for (const double share : {0.6, 1.0, 1.5}) {
        for (unsigned seed = 1; seed <= 3; ++seed) {
            CAPTURE(share);
            CAPTURE(seed);
            mesh::HexMesh mesh = shaken(share, seed);
            const mesh::HexMesh before = mesh;
            REQUIRE(quality::measure(mesh).inverted > 0);
            const sweep::Improved report = sweep::improve(mesh);
            mesh = report.mesh;
            CHECK(report.after > 0.2);
            test::check_valid(mesh);
            for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
                for (const Index n : mesh::skin_quad(mesh, i).nodes) {
                    CHECK(mesh.nodes[static_cast<std::size_t>(n)] ==
                          before.nodes[static_cast<std::size_t>(n)]);
                }
            }
        }
    }
}

TEST_CASE("untangling leaves a good mesh as it is, and never lowers the least scaled Jacobian")
{
    mesh::HexMesh good = test::block({6, 6, 6});
    const std::vector<Vec3> nodes = good.nodes;
    good = sweep::improve(good).mesh;
    CHECK(good.nodes == nodes);
    for (unsigned seed = 1; seed <= 5; ++seed) {
        mesh::HexMesh mesh = shaken(0.35, seed);
        const double before = quality::measure(mesh).min_scaled_jacobian;
        mesh = sweep::improve(mesh).mesh;
        CHECK(quality::measure(mesh).min_scaled_jacobian >= before);
    }
}

TEST_CASE("a valid mesh with poor cells gets a better worst cell and keeps its mean, within its skin")
{
    for (unsigned seed = 1; seed <= 4; ++seed) {
        CAPTURE(seed);
        mesh::HexMesh mesh = shaken(0.24, seed);
        const quality::Quality before = quality::measure(mesh);
        REQUIRE(before.inverted == 0);
        REQUIRE(before.min_scaled_jacobian < 0.48);
        const sweep::Improved report = sweep::improve(mesh);
        mesh = report.mesh;
        const quality::Quality after = quality::measure(mesh);
        CHECK_FALSE(report.untangled);
        CHECK(after.min_scaled_jacobian >= 0.5);
        CHECK(after.mean_scaled_jacobian >= before.mean_scaled_jacobian - 0.01);
        CHECK(after.volume == doctest::Approx(before.volume).epsilon(1e-12));
        test::check_valid(mesh);
    }
}

TEST_CASE("skin nodes that may slide stay on their surfaces, all others where they were, and the mesh gets "
          "better for it")
{
    for (unsigned seed = 1; seed <= 3; ++seed) {
        CAPTURE(seed);
        mesh::HexMesh mesh = shaken(0.3, seed);
        const sweep::Sliding sliding = sliding_on(mesh);
        const double size = cell_size(test::block({6, 6, 6}));
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> throws(-0.75 * size, 0.75 * size);
        for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
            if (sliding.surface[i] < 0) continue;
            Vec3 p = mesh.nodes[i] + Vec3(throws(random), throws(random), throws(random));
            sliding.project(sliding.surface[i], std::span(&p, 1));
            mesh.nodes[i] = p;
        }
        REQUIRE(quality::measure(mesh).min_scaled_jacobian < 0);
        mesh::HexMesh locked = mesh;
        const mesh::HexMesh before = mesh;
        mesh = sweep::improve(mesh, {}, sliding).mesh;
        CHECK(quality::measure(mesh).min_scaled_jacobian > 0.4);
        test::check_valid(mesh);
        locked = sweep::improve(locked).mesh;
        CHECK(quality::measure(locked).min_scaled_jacobian < quality::measure(mesh).min_scaled_jacobian);
        const std::vector<char> skin = skin_nodes_of(mesh);
        for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
            if (sliding.surface[i] >= 0) {
                Vec3 p = mesh.nodes[i];
                sliding.project(sliding.surface[i], std::span(&p, 1));
                CHECK(p == mesh.nodes[i]);
            } else if (skin[i] != 0) {
                CHECK(mesh.nodes[i] == before.nodes[i]);
            }
        }
    }
}

TEST_CASE(
    "what ends the work is a budget of work or of time, and the report says so; without any nothing moves")
{
    const mesh::HexMesh before = shaken(1.0, 5, {12, 12, 12});
    sweep::ImproveOptions options;
    options.seconds = 1e-9;
    const sweep::Improved hurried = sweep::improve(before, options);
    CHECK(hurried.unfinished);
    CHECK(hurried.mesh.nodes == before.nodes);
    options = {};
    options.work = 1;
    const sweep::Improved none = sweep::improve(before, options);
    CHECK(none.unfinished);
    CHECK_FALSE(none.won);
    CHECK(none.mesh.nodes == before.nodes);
    const sweep::Improved all = sweep::improve(before);
    CHECK_FALSE(all.unfinished);
    CHECK(all.won);
    options.work = 2e4;
    mesh::HexMesh again = before;
    const sweep::Improved some = sweep::improve(before, options);
    CHECK(some.unfinished);
    RunContext one_thread;
    one_thread.threads = 1;
    again = sweep::improve(again, options, {}, one_thread).mesh;
    CHECK(some.mesh.nodes == again.nodes);
}

TEST_CASE("the same comes out for any number of threads")
{
    const mesh::HexMesh before = shaken(1.0, 5, {12, 12, 12});
    mesh::HexMesh one = before, four = before;
    RunContext context;
    context.threads = 1;
    one = sweep::improve(one, {}, {}, context).mesh;
    context.threads = 4;
    four = sweep::improve(four, {}, {}, context).mesh;
    CHECK(one.nodes == four.nodes);
    test::check_valid(one);
}

TEST_CASE("a corner that cannot move holds up no other cell")
{
    for (unsigned seed = 1; seed <= 4; ++seed) {
        CAPTURE(seed);
        mesh::HexMesh mesh = shaken(0.2, seed, {8, 8, 8});
        // Pull the block's last corner towards its inside: the cell there is poor by its locked nodes alone.
        Vec3& corner = mesh.nodes.back();
        const std::vector<char> skin = skin_nodes_of(mesh);
        REQUIRE(skin[mesh.nodes.size() - 1] == 1);
        corner -= 0.29 * cell_size(test::block({8, 8, 8})) * Vec3(1, 1, 1);
        const quality::Quality before = quality::measure(mesh);
        REQUIRE(before.inverted == 0);
        REQUIRE(before.min_scaled_jacobian < 0.25);
        mesh = sweep::improve(mesh).mesh;
        std::size_t poor = 0;
        for (std::size_t c = 0; c < mesh.hex_count(); ++c) {
            std::array<Vec3, 8> corners;
            for (std::size_t k = 0; k < 8; ++k)
                corners[k] = mesh.nodes[static_cast<std::size_t>(mesh.hex(c)[k])];
            poor += quality::scaled_jacobian(corners) < 0.45 ? 1 : 0;
        }
        CHECK(poor <= 2);
        CHECK(quality::measure(mesh).min_scaled_jacobian >= before.min_scaled_jacobian);
        test::check_valid(mesh);
    }
}

TEST_CASE("a mesh whose cells are as good as its skin allows is left as it is")
{
    // Sheared so far that every cell is poor; a block of one cell across has nothing inside to move.
    mesh::HexMesh mesh = test::block({4, 1, 1});
    for (Vec3& p : mesh.nodes) p.x() += 2.2 * p.z();
    const std::vector<Vec3> nodes = mesh.nodes;
    const sweep::Improved report = sweep::improve(mesh);
    CHECK_FALSE(report.won);
    CHECK(report.mesh.nodes == nodes);
}

TEST_CASE("the slopes of a cell's energy are those of differences, folded or not")
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> throws(-0.6, 0.6);
    for (int trial = 0; trial < 40; ++trial) {
        std::array<Vec3, 8> corners{
            {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
        for (Vec3& p : corners) p += Vec3(throws(random), throws(random), throws(random));
        const Vec3 box(1.2, 0.9, 0.5);
        const sweep::CellEnergy energy{0.1, trial % 2 == 0 ? 1.0 : 1e-3, trial % 3 == 0 ? 0.0 : 12.0};
        std::array<Vec3, 8> slope, other;
        sweep::cell_energy(energy, corners, box, slope);
        for (std::size_t i = 0; i < 8; ++i) {
            for (int d = 0; d < 3; ++d) {
                constexpr double kStep = 1e-6;
                std::array<Vec3, 8> low = corners, high = corners;
                low[i][d] -= kStep;
                high[i][d] += kStep;
                const double difference = (sweep::cell_energy(energy, high, box, other) -
                                           sweep::cell_energy(energy, low, box, other)) /
                                          (2 * kStep);
                CHECK(slope[i][d] ==
                      doctest::Approx(difference).epsilon(1e-4).scale(1 + std::abs(difference)));
            }
        }
    }
}
