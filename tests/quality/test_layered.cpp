// SPDX-License-Identifier: MIT
#include "support/blocks.h"

#include <lacuna/quality/shared/layered.h>
#include <lacuna/quality/shared/metrics.h>

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace lacuna;

namespace {

/// Many enough nodes a layer for the layers to be made in several parts.
constexpr int kAcross = 120, kLayers = 60;

/// A block bent round by some part of a turn about an axis beside it.
mesh::HexMesh bent(double turn)
{
    mesh::HexMesh mesh = test::block({.columns = kAcross, .rows = kAcross, .layers = kLayers});
    const double height = mesh.nodes.back().z();
    for (Vec3& p : mesh.nodes) {
        const double angle = 2 * std::numbers::pi * turn * p.z() / height, out = 3 + p.x();
        p = {out * std::cos(angle), p.y(), out * std::sin(angle)};
    }
    // The first level and the last of a whole turn are one but for rounding.
    return mesh;
}

/// What makes the nodes of a mesh that has them.
mesh::LayeredNodes nodes_of(const mesh::HexMesh& whole)
{
    const auto row = index(whole.nodes_per_layer);
    return {[&whole, row](int first, int last, std::span<Vec3> out, const RunContext&) {
                std::copy(whole.nodes.begin() + std::ptrdiff_t(std::size_t(first) * row),
                          whole.nodes.begin() + std::ptrdiff_t(std::size_t(last) * row), out.begin());
            },
            [&whole](Index node) { return whole.nodes[index(node)]; }};
}

/// The proof of a mesh whose nodes are made, which is to be that of the whole.
quality::Proof layered_proof(const mesh::HexMesh& whole, double limit = 0)
{
    mesh::HexMesh bare = whole;
    bare.nodes.resize(index(whole.nodes_per_layer));
    const mesh::LayeredNodes nodes = nodes_of(whole);
    const mesh::LayeredMesh layered{bare, nodes};
    REQUIRE(mesh::layers_at_once(bare) < kLayers / 3);
    const quality::MeasuredLayers measured = quality::measure(layered);
    quality::Proof found = quality::prove(layered, measured.quality,
                                          quality::find_misplaced(layered, measured.slabs), limit);
    const quality::Proof held = quality::prove(whole, limit);
    REQUIRE(found.finding.has_value() == held.finding.has_value());
    if (found.finding && held.finding) {
        CHECK(found.finding->fault == held.finding->fault);
        CHECK(found.finding->message.text() == held.finding->message.text());
    }
    CHECK(found.quality.hexes == held.quality.hexes);
    CHECK(found.quality.min_scaled_jacobian == held.quality.min_scaled_jacobian);
    CHECK(found.quality.mean_scaled_jacobian == doctest::Approx(held.quality.mean_scaled_jacobian));
    CHECK(found.quality.volume == doctest::Approx(held.quality.volume));
    CHECK(found.quality.histogram == held.quality.histogram);
    REQUIRE(found.quality.worst.size() == held.quality.worst.size());
    for (std::size_t i = 0; i < held.quality.worst.size(); ++i) {
        CHECK(found.quality.worst[i].cell == held.quality.worst[i].cell);
        CHECK(found.quality.worst[i].layer == held.quality.worst[i].layer);
        CHECK(found.quality.worst[i].centre.isApprox(held.quality.worst[i].centre));
    }
    return found;
}

} // namespace

TEST_CASE("a mesh whose nodes are made is proved as one that holds them")
{
    for (const double turn : {0.0, 0.25, 0.9}) {
        CAPTURE(turn);
        const mesh::HexMesh whole =
            turn > 0 ? bent(turn) : test::block({.columns = kAcross, .rows = kAcross, .layers = kLayers});
        CHECK_FALSE(layered_proof(whole).finding);
    }
}

TEST_CASE("nodes of layers far apart that lie in one place are found where nodes are made")
{
    const quality::Proof proof = layered_proof(bent(1));
    REQUIRE(proof.finding);
    CHECK(proof.finding->fault == quality::Fault::coincident_nodes);
}

TEST_CASE("what is wrong in one of many layers is found where nodes are made")
{
    const std::size_t middle = std::size_t(kLayers / 2) * (kAcross + 1) * (kAcross + 1) + 40 * kAcross;
    mesh::HexMesh twins = test::block({.columns = kAcross, .rows = kAcross, .layers = kLayers});
    mesh::HexMesh inverted = twins;
    inverted.nodes[middle] += 2.5 * (inverted.nodes[middle + 1] - inverted.nodes[middle]);
    CHECK(layered_proof(inverted).finding->fault == quality::Fault::inverted);
    CHECK(layered_proof(twins, 2).finding->fault == quality::Fault::below_limit);
    twins.rim.pop_back();
    mesh::HexMesh bare = twins;
    bare.nodes.resize(index(twins.nodes_per_layer));
    const mesh::LayeredNodes nodes = nodes_of(twins);
    const mesh::LayeredMesh layered{bare, nodes};
    CHECK(quality::prove(layered, quality::measure(layered).quality, {}).finding.has_value());
}

TEST_CASE("sizes compare with one mean to the bit, whether nodes are held or made, for any number of threads")
{
    const mesh::HexMesh whole = bent(0.4);
    mesh::HexMesh bare = whole;
    bare.nodes.resize(index(whole.nodes_per_layer));
    const mesh::LayeredNodes nodes = nodes_of(whole);
    const auto held = quality::metric_values(whole, quality::Metric::relative_size_squared);
    for (const int threads : {1, 3}) {
        RunContext context;
        context.threads = threads;
        const double mean = quality::mean_volume(mesh::LayeredMesh{bare, nodes}, context);
        CHECK(quality::metric_values(whole, quality::Metric::relative_size_squared, context, mean) == held);
    }
    const auto volume = quality::measure_metrics(whole, std::vector{quality::Metric::volume});
    CHECK(quality::mean_volume(mesh::LayeredMesh{bare, nodes}) == doctest::Approx(volume[0].mean));
}
