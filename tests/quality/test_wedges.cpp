// SPDX-License-Identifier: MIT
#include "support/blocks.h"
#include "support/check_valid.h"
#include "support/prove_cells.h"

#include <lacuna/quality/quality.h>
#include <lacuna/quality/shared/metrics.h>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

using namespace lacuna;

namespace {

using WedgeCorners = std::array<Vec3, 6>;

WedgeCorners even_wedge(double height)
{
    const double h = std::sqrt(0.75);
    WedgeCorners c{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, h, 0)};
    for (std::size_t i = 0; i < 3; ++i) c[3 + i] = c[i] + Vec3(0, 0, height);
    return c;
}

/// Determinant of the map's derivatives at barycentric (1 - u - v, u, v) and height w.
double jacobian(const WedgeCorners& c, double u, double v, double w)
{
    Eigen::Matrix3d d;
    d.col(0) = (1 - w) * (c[1] - c[0]) + w * (c[4] - c[3]);
    d.col(1) = (1 - w) * (c[2] - c[0]) + w * (c[5] - c[3]);
    d.col(2) = (1 - u - v) * (c[3] - c[0]) + u * (c[4] - c[1]) + v * (c[5] - c[2]);
    return d.determinant();
}

double least_sampled(const WedgeCorners& c)
{
    double least = std::numeric_limits<double>::infinity();
    constexpr int n = 12;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j)
            for (int k = 0; k <= 2 * n; ++k)
                least = std::min(least, jacobian(c, double(i) / n, double(j) / n, double(k) / (2 * n)));
    return least;
}

Vec3 bent_place(const Vec3& p)
{
    return {p.x() + 0.1 * std::sin(3 * p.y()), p.y() * (1 + 0.2 * p.x()), p.z() * (1 + 0.3 * p.x() * p.y())};
}

std::vector<Hex> cells_of(const mesh::HexMesh& mesh)
{
    std::vector<Hex> cells;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) cells.push_back(mesh.hex(c));
    return cells;
}

std::vector<Quad> skin_of(const mesh::HexMesh& mesh)
{
    std::vector<Quad> skin;
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) skin.push_back(mesh::skin_quad(mesh, i).nodes);
    return skin;
}

} // namespace

TEST_CASE("an even triangle times a height has scaled Jacobian 1, whatever its height and place")
{
    for (const double height : {1e-6, 0.5, 1.0, 40.0}) {
        CHECK(quality::wedge_scaled_jacobian(even_wedge(height)) == doctest::Approx(1));
        CHECK(quality::wedge_certified_positive(even_wedge(height)));
        WedgeCorners folded = even_wedge(height);
        std::swap(folded[0], folded[1]);
        CHECK(quality::wedge_scaled_jacobian(folded) < 0);
        CHECK_FALSE(quality::wedge_certified_positive(folded));
    }
}

TEST_CASE("a wedge is certified only where its Jacobian is positive at every sample, and mostly where it is")
{
    std::mt19937 random(7);
    std::normal_distribution<double> move(0, 1);
    int certified = 0, positive = 0, corners_alone = 0;
    for (int i = 0; i < 4000; ++i) {
        WedgeCorners c = even_wedge(1);
        const double size = 0.1 + 0.5 * (i % 10) / 10.0;
        for (Vec3& p : c) p += size * Vec3(move(random), move(random), move(random));
        const bool proved = quality::wedge_certified_positive(c);
        const bool sampled = least_sampled(c) > 0;
        CHECK((!proved || sampled));
        certified += proved;
        positive += sampled;
        corners_alone += quality::wedge_scaled_jacobian(c) > 0 && !sampled;
        if (proved) CHECK(quality::wedge_scaled_jacobian(c) > 0);
    }
    CHECK(certified > 0.98 * positive);
    CHECK(corners_alone > 0); // wedges that corners alone would let pass are among them
    MESSAGE(certified << " certified of " << positive << " positive at all samples; " << corners_alone
                      << " positive at their corners alone");
}

TEST_CASE("a mesh with wedges is proved, as swept and as a list, and measured as cell by cell")
{
    for (const std::size_t every : {1, 3, 7}) {
        for (const mesh::HexMesh& plain :
             {test::block({.columns = 4, .rows = 5, .layers = 3, .map = bent_place}), test::ring(9, 2)}) {
            const mesh::HexMesh mesh = test::with_wedges(plain, every);
            test::check_valid(mesh);
            const quality::Proof proof = quality::prove(mesh);
            CHECK_FALSE(proof.finding);
            CHECK(proof.quality.wedges == mesh.wedge_count());
            CHECK(proof.quality.volume == doctest::Approx(quality::measure(plain).volume).epsilon(0.02));
            const quality::Proof listed = test::prove_cells(mesh.nodes, cells_of(mesh), skin_of(mesh));
            CHECK_FALSE(listed.finding);
            CHECK(listed.quality.wedges == mesh.wedge_count());
            CHECK(listed.quality.hexes == mesh.hex_count());
            CHECK(listed.quality.min_scaled_jacobian == proof.quality.min_scaled_jacobian);
        }
    }
}

TEST_CASE("faults of meshes with wedges are found")
{
    const mesh::HexMesh good = test::with_wedges(test::block({.columns = 3, .rows = 3, .layers = 2}));
    const auto fault = [](const mesh::HexMesh& mesh) {
        const quality::Proof proof = quality::prove(mesh);
        return proof.finding ? quality::fault_code(proof.finding->fault) : "none";
    };
    mesh::HexMesh first = good;
    std::swap(first.quads.front(), first.quads.back());
    CHECK(fault(first) == "quality.wrong_size");
    mesh::HexMesh turned = good;
    std::swap(turned.quads.back()[0], turned.quads.back()[1]);
    CHECK(fault(turned) == "quality.not_conformal");
    mesh::HexMesh moved = good;
    moved.nodes[index(good.quads.back()[0])] += Vec3(5, 5, 0);
    CHECK(fault(moved) == "quality.inverted");

    const mesh::HexMesh larger = test::with_wedges(test::block({.columns = 4, .rows = 4, .layers = 3}), 5);
    std::vector<Hex> cells = cells_of(larger);
    cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(cells.size() / 2));
    const quality::Proof missing = test::prove_cells(larger.nodes, cells, skin_of(larger));
    REQUIRE(missing.finding);
    CHECK(missing.finding->fault == quality::Fault::skin_differs);
}

TEST_CASE("metrics of wedges are theirs alone: the others are over the hexahedra")
{
    const mesh::HexMesh mesh = test::with_wedges(test::block({.columns = 4, .rows = 4, .layers = 2}));
    const quality::Metric metrics[] = {quality::Metric::scaled_jacobian, quality::Metric::volume,
                                       quality::Metric::skew};
    const auto summaries = quality::measure_metrics(mesh, metrics);
    CHECK(summaries[0].min == doctest::Approx(2 / std::sqrt(3.0) * std::sqrt(0.5)));
    CHECK(summaries[1].min == doctest::Approx(summaries[1].max / 2));
    CHECK(summaries[2].max == doctest::Approx(0));
    CHECK(std::isfinite(summaries[2].mean));
    const auto values = quality::metric_values(mesh, quality::Metric::volume);
    const auto kept = quality::measure(mesh, {}, quality::Keep::of_cells).of_cells;
    REQUIRE(kept != nullptr);
    CHECK(std::vector<double>(kept->begin(), kept->end()) ==
          quality::metric_values(mesh, quality::Metric::scaled_jacobian));
    double sum = 0;
    for (const double v : values) sum += v;
    CHECK(sum == doctest::Approx(1));
}
