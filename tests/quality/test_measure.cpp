// SPDX-License-Identifier: MIT
#include "support/blocks.h"

#include <lacuna/core/error.h>
#include <lacuna/quality/quality.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

using namespace lacuna;

namespace {

mesh::HexMesh shaken_block(int n, int layers, double amount)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> shift(-amount / n, amount / n);
    return test::block({.columns = n, .rows = n, .layers = layers, .map = [&](const Vec3& p) -> Vec3 {
                            return p + Vec3(shift(random), shift(random), shift(random));
                        }});
}

} // namespace

TEST_CASE("a measured mesh has the least, the mean, the counts and the worst cells of its cells one by one")
{
    for (const double amount : {0.1, 0.6}) {
        for (const int layers : {1, 7, 41}) {
            CAPTURE(amount);
            CAPTURE(layers);
            const auto mesh = shaken_block(13, layers, amount);
            std::vector<double> scaled;
            std::size_t uncertified = 0;
            for (const Hex& hex : test::all_hexes(mesh)) {
                std::array<Vec3, 8> corners;
                for (std::size_t c = 0; c < 8; ++c) corners[c] = mesh.nodes[static_cast<std::size_t>(hex[c])];
                scaled.push_back(quality::scaled_jacobian(corners));
                if (!quality::certified_positive(corners)) ++uncertified;
            }
            const auto quality = quality::measure(mesh);
            CHECK(quality.hexes == scaled.size());
            CHECK(quality.min_scaled_jacobian == *std::min_element(scaled.begin(), scaled.end()));
            CHECK(
                quality.mean_scaled_jacobian ==
                doctest::Approx(std::accumulate(scaled.begin(), scaled.end(), 0.0) / double(scaled.size())));
            CHECK(quality.uncertified == uncertified);
            CHECK(quality.inverted ==
                  std::size_t(std::count_if(scaled.begin(), scaled.end(), [](double s) { return s <= 0; })));
            CHECK(std::accumulate(quality.histogram.begin(), quality.histogram.end(), std::size_t(0)) ==
                  scaled.size());
            REQUIRE(quality.worst.size() == 10);
            // One of each column: its least.
            std::vector<double> sorted(mesh.quads.size(), 2.0);
            for (std::size_t c = 0; c < scaled.size(); ++c) {
                double& least = sorted[c % sorted.size()];
                least = std::min(least, scaled[c]);
            }
            std::sort(sorted.begin(), sorted.end());
            std::set<std::size_t> columns;
            for (std::size_t i = 0; i < 10; ++i) {
                CHECK(columns.insert(quality.worst[i].cell % mesh.quads.size()).second);
                CHECK(quality.worst[i].scaled_jacobian == sorted[i]);
                CHECK(scaled[quality.worst[i].cell] == sorted[i]);
                CHECK(quality.worst[i].layer == int(quality.worst[i].cell / mesh.quads.size()));
            }
        }
    }
}

TEST_CASE("a mesh is measured the same to the bit for any number of threads, and as a list of cells alike")
{
    const auto mesh = shaken_block(40, 9, 0.3);
    const auto hexes = test::all_hexes(mesh);
    RunContext one;
    one.threads = 1;
    const auto expected = quality::measure(mesh, one);
    for (const int threads : {2, 3, 8}) {
        RunContext context;
        context.threads = threads;
        const auto quality = quality::measure(mesh, context);
        CHECK(quality.mean_scaled_jacobian == expected.mean_scaled_jacobian);
        CHECK(quality.volume == expected.volume);
        CHECK(quality.histogram == expected.histogram);
        CHECK(quality.worst.front().cell == expected.worst.front().cell);
    }
    std::vector<Index> columns;
    for (std::size_t c = 0; c < hexes.size(); ++c)
        columns.push_back(static_cast<Index>(c % mesh.quads.size()));
    const auto listed = quality::measure_cells(mesh.nodes, hexes, {}, columns);
    CHECK(listed.min_scaled_jacobian == expected.min_scaled_jacobian);
    CHECK(listed.histogram == expected.histogram);
    CHECK(listed.volume == doctest::Approx(expected.volume));
    for (std::size_t i = 0; i < 10; ++i) {
        CHECK(listed.worst[i].cell == expected.worst[i].cell);
        CHECK((listed.worst[i].centre - expected.worst[i].centre).norm() == 0);
        CHECK(listed.worst[i].layer == -1);
    }
}

TEST_CASE("the ten worst of a list of cells without columns are the ten worst of all")
{
    const auto mesh = shaken_block(6, 30, 0.5);
    const auto hexes = test::all_hexes(mesh);
    std::vector<double> scaled;
    for (const Hex& hex : hexes) {
        std::array<Vec3, 8> corners;
        for (std::size_t c = 0; c < 8; ++c) corners[c] = mesh.nodes[static_cast<std::size_t>(hex[c])];
        scaled.push_back(quality::scaled_jacobian(corners));
    }
    std::sort(scaled.begin(), scaled.end());
    const auto listed = quality::measure_cells(mesh.nodes, hexes);
    REQUIRE(listed.worst.size() == 10);
    for (std::size_t i = 0; i < 10; ++i) CHECK(listed.worst[i].scaled_jacobian == scaled[i]);
}

TEST_CASE("the volume of a mesh follows an affine map by its determinant")
{
    Eigen::Matrix3d linear;
    linear << 2, 0.5, 0.1, 0, 1.5, 0.3, 0.2, 0, 3;
    auto mesh = shaken_block(6, 4, 0.2);
    const double before = quality::measure(mesh).volume;
    for (Vec3& node : mesh.nodes) node = linear * node + Vec3(100, 200, 300);
    CHECK(quality::measure(mesh).volume == doctest::Approx(before * linear.determinant()));
}

TEST_CASE("an empty mesh is measured as one of no cells")
{
    CHECK(quality::measure({}).hexes == 0);
    CHECK(quality::measure_cells({}, {}).worst.empty());
    CHECK_FALSE(quality::to_table(quality::Quality{}).empty());
}

TEST_CASE("measuring stops when asked to")
{
    const std::atomic<bool> cancel{true};
    RunContext context;
    context.cancel = &cancel;
    CHECK_THROWS_AS(quality::measure(test::block({}), context), Cancelled);
}

TEST_CASE("the table tells every count and the bins that hold cells")
{
    const auto quality = quality::measure(test::block({.columns = 4, .rows = 5, .layers = 6}));
    const std::string table = quality::to_table(quality);
    CHECK(table.find("120") != std::string::npos);
    CHECK(table.find("1.0000") != std::string::npos);
    CHECK(table.find('#') != std::string::npos);
    CHECK(std::count(table.begin(), table.end(), '#') == 40);
}
