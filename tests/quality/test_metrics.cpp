// SPDX-License-Identifier: MIT
#include <lacuna/quality/quality.h>
#include <lacuna/quality/shared/metrics.h>

#include "support/blocks.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace lacuna;
using quality::Metric;

namespace {

using Corners = std::array<Vec3, 8>;

Corners box(const Vec3& sides)
{
    Corners corners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0),
                    Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(1, 1, 1), Vec3(0, 1, 1)};
    for (Vec3& corner : corners) corner = corner.cwiseProduct(sides);
    return corners;
}

Corners shaken_box(std::mt19937& random, double amount)
{
    std::uniform_real_distribution<double> shift(-amount, amount);
    Corners corners = box({1, 1, 1});
    for (Vec3& corner : corners) corner += Vec3(shift(random), shift(random), shift(random));
    return corners;
}

std::vector<Metric> all_metrics()
{
    std::vector<Metric> metrics;
    for (const quality::MetricInfo& info : quality::metric_infos()) metrics.push_back(info.metric);
    return metrics;
}

/// Many cells that share nothing, as a list.
struct Cells {
    std::vector<Vec3> nodes;
    std::vector<Hex> hexes;

    void add(const Corners& corners)
    {
        Hex hex;
        for (std::size_t i = 0; i < 8; ++i) {
            hex[i] = static_cast<Index>(nodes.size());
            nodes.push_back(corners[i]);
        }
        hexes.push_back(hex);
    }
};

Cells shaken_cells(std::size_t count, double amount)
{
    std::mt19937 random(3);
    Cells cells;
    for (std::size_t i = 0; i < count; ++i) cells.add(shaken_box(random, amount));
    return cells;
}

} // namespace

TEST_CASE("metrics are listed in the order of their enumeration")
{
    for (std::size_t i = 0; i < quality::kMetricCount; ++i) {
        const quality::MetricInfo& info = quality::metric_infos()[i];
        CHECK(static_cast<std::size_t>(info.metric) == i);
    }
}

TEST_CASE("a cube is perfect by every metric, and inside every acceptable range")
{
    for (const double size : {1e-6, 1.0, 1e6}) {
        const Corners cube = box({size, size, size});
        for (const quality::MetricInfo& info : quality::metric_infos()) {
            CAPTURE(info.name);
            const double value = quality::metric(info.metric, cube, size * size * size);
            double expected = info.larger_is_better || info.full.low == 1 ? 1 : 0;
            if (info.metric == Metric::edge_ratio) expected = 1;
            if (info.metric == Metric::volume || info.metric == Metric::jacobian)
                expected = size * size * size;
            if (info.metric == Metric::dimension) expected = size / std::sqrt(3);
            CHECK(value == doctest::Approx(expected).epsilon(1e-9));
        }
    }
}

TEST_CASE("metrics of a box follow from its sides")
{
    const Corners slab = box({3, 1, 6});
    CHECK(quality::metric(Metric::full_edge_ratio, slab) == doctest::Approx(6));
    CHECK(quality::metric(Metric::max_edge_ratio, slab) == doctest::Approx(6));
    CHECK(quality::metric(Metric::edge_ratio, slab) == doctest::Approx(3)); // the slip of VTK 9.1
    CHECK(quality::metric(Metric::stretch, slab) == doctest::Approx(std::sqrt(3.0 / 46)));
    CHECK(quality::metric(Metric::shape, slab) == doctest::Approx(3 * std::cbrt(18.0 * 18.0) / 46));
    CHECK(quality::metric(Metric::volume, slab) == doctest::Approx(18));
    CHECK(quality::metric(Metric::skew, slab) == doctest::Approx(0));
    CHECK(quality::metric(Metric::relative_size_squared, slab, 36) == doctest::Approx(0.25));
    CHECK(quality::metric(Metric::relative_size_squared, slab, 9) == doctest::Approx(0.25));
    CHECK(quality::metric(Metric::relative_size_squared, slab, 0) == 0);
}

TEST_CASE("metrics do not change when a cell is moved, turned or, but for those with a unit, scaled")
{
    std::mt19937 random(5);
    for (int trial = 0; trial < 200; ++trial) {
        const Corners corners = shaken_box(random, 0.25);
        Corners moved = corners;
        const double size = trial % 2 == 0 ? 1e-3 : 40.0;
        const Eigen::AngleAxisd turn(0.1 * trial, Vec3(1, 2, 3).normalized());
        for (Vec3& corner : moved) corner = size * (turn * corner + Vec3(1, -2, 0.5));
        for (const quality::MetricInfo& info : quality::metric_infos()) {
            CAPTURE(info.name);
            const Metric m = info.metric;
            const double unit = m == Metric::volume || m == Metric::jacobian ? size * size * size
                                : m == Metric::dimension                     ? size
                                                                             : 1;
            const double before = quality::metric(m, corners, 1);
            const double after = quality::metric(m, moved, size * size * size);
            CHECK(std::abs(after / unit - before) <= 1e-9 * std::max(1.0, std::abs(before)));
        }
    }
}

TEST_CASE("no value is infinite or no number, whatever the cell; a cell without shape is praised by none")
{
    Corners point;
    point.fill(Vec3(1, 1, 1));
    Corners nowhere = box({1, 1, 1});
    nowhere[3].x() = std::nan("");
    Corners endless = box({1, 1, 1});
    endless[6].z() = std::numeric_limits<double>::infinity();
    for (const Corners& corners : {point, nowhere, endless, box({1, 1, 0}), box({1, 0, 0})}) {
        for (const quality::MetricInfo& info : quality::metric_infos()) {
            CAPTURE(info.name);
            const double value = quality::metric(info.metric, corners);
            CHECK(std::isfinite(value));
        }
        CHECK(quality::metric(Metric::scaled_jacobian_with_centre, corners) == 0);
        CHECK(quality::metric(Metric::shape, corners) == 0);
        CHECK(quality::metric(Metric::distortion, corners) == 0);
        CHECK(quality::metric(Metric::condition, corners) >= 1e29);
    }
}

TEST_CASE("our scaled Jacobian is the corners' alone, bit for bit that of `scaled_jacobian()`")
{
    std::mt19937 random(9);
    int lower = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Corners corners = shaken_box(random, 0.9);
        const double ours = quality::metric(Metric::scaled_jacobian, corners);
        CHECK(ours == quality::scaled_jacobian(corners));
        const double with_centre = quality::metric(Metric::scaled_jacobian_with_centre, corners);
        CHECK(with_centre <= ours);
        if (with_centre < ours) ++lower;
    }
    CHECK(lower > 0);
}

TEST_CASE("a summary says what the values say: least, mean, largest, deviation, share outside, worst cell")
{
    const Cells cells = shaken_cells(5003, 0.4);
    const std::vector<Metric> metrics = all_metrics();
    const auto summaries = quality::measure_metrics(cells.nodes, cells.hexes, metrics);
    REQUIRE(summaries.size() == metrics.size());
    std::size_t outside_anywhere = 0;
    for (const quality::MetricSummary& summary : summaries) {
        const quality::MetricInfo& info = quality::metric_info(summary.metric);
        CAPTURE(info.name);
        const auto values = quality::metric_values(cells.nodes, cells.hexes, summary.metric);
        REQUIRE(values.size() == cells.hexes.size());
        const auto as_kept = [&](double value) {
            return summary.metric == Metric::scaled_jacobian ? double(float(value)) : value;
        };
        CHECK(as_kept(summary.min) == *std::min_element(values.begin(), values.end()));
        CHECK(as_kept(summary.max) == *std::max_element(values.begin(), values.end()));
        double mean = 0;
        std::size_t outside = 0;
        for (const double value : values) {
            mean += value / static_cast<double>(values.size());
            if (info.acceptable && !info.acceptable->contains(value)) ++outside;
        }
        double variance = 0;
        for (const double value : values)
            variance += (value - mean) * (value - mean) / static_cast<double>(values.size());
        CHECK(summary.mean == doctest::Approx(mean).epsilon(1e-9));
        CHECK(summary.deviation == doctest::Approx(std::sqrt(variance)).epsilon(1e-9));
        CHECK(summary.outside == outside);
        CHECK(summary.outside_share == doctest::Approx(double(outside) / double(values.size())));
        CHECK(summary.value == (info.larger_is_better ? summary.min : summary.max));
        CHECK(values[summary.worst] == as_kept(summary.value));
        CHECK(summary.layer == -1);
        Vec3 centre(0, 0, 0);
        for (const Index node : cells.hexes[summary.worst]) centre += cells.nodes[std::size_t(node)] / 8;
        CHECK((summary.centre - centre).norm() < 1e-12);
        outside_anywhere += outside;
    }
    CHECK(outside_anywhere > 0);
}

TEST_CASE("summaries and values are the same to the bit for any number of threads, swept or listed")
{
    std::mt19937 random(2);
    std::uniform_real_distribution<double> shift(-0.01, 0.01);
    const mesh::HexMesh mesh = test::block(
        {.columns = 47, .rows = 31, .layers = 9, .map = [&](const Vec3& p) -> Vec3 {
             return p + Vec3(shift(random), shift(random), shift(random));
         }});
    std::vector<Hex> hexes;
    for (std::size_t i = 0; i < mesh.hex_count(); ++i) hexes.push_back(mesh.hex(i));
    const std::vector<Metric> metrics = all_metrics();
    RunContext alone;
    alone.threads = 1;
    RunContext many;
    many.threads = 5;
    const auto first = quality::measure_metrics(mesh, metrics, alone);
    const auto second = quality::measure_metrics(mesh, metrics, many);
    for (std::size_t m = 0; m < metrics.size(); ++m) {
        CHECK(first[m].mean == second[m].mean);
        CHECK(first[m].deviation == second[m].deviation);
        CHECK(first[m].worst == second[m].worst);
        CHECK(first[m].layer == int(first[m].worst / mesh.quads.size()));
        if (quality::metric_info(metrics[m]).needs_average_volume) continue; // sums in another order
        CHECK(quality::metric_values(mesh, metrics[m], alone) ==
              quality::metric_values(mesh.nodes, hexes, metrics[m], many));
    }
    CHECK(quality::measure(mesh, alone).of_cells == nullptr);
    const auto kept = quality::measure(mesh, many, quality::Keep::of_cells).of_cells;
    REQUIRE(kept != nullptr);
    CHECK(std::vector<double>(kept->begin(), kept->end()) ==
          quality::metric_values(mesh, Metric::scaled_jacobian, alone));
}

TEST_CASE("the table names every metric with its acceptable range")
{
    const Cells cells = shaken_cells(100, 0.3);
    const std::vector<Metric> metrics = all_metrics();
    const std::string table = quality::to_table(quality::measure_metrics(cells.nodes, cells.hexes, metrics));
    for (const quality::MetricInfo& info : quality::metric_infos())
        CHECK(table.find(info.name) != std::string::npos);
    CHECK(table.find("0.5 to 1") != std::string::npos);
}

TEST_CASE("no cells, no numbers")
{
    const Metric shape = Metric::shape;
    CHECK(quality::measure_metrics(mesh::HexMesh{}, {&shape, 1})[0].mean == 0);
    CHECK(quality::metric_values(mesh::HexMesh{}, shape).empty());
}
