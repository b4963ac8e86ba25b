// SPDX-License-Identifier: MIT
#include "support/plane_domains.h"

#include <lacuna/geometry/triangulate.h>
#include <lacuna/quads/detail/refill_cavities.h>
#include <lacuna/quads/detail/split_cells.h>
#include <lacuna/quads/detail/triangle_quads.h>
#include <lacuna/quads/measure_plane.h>

#include <doctest/doctest.h>

using namespace lacuna;
using quads::MixedMesh;

namespace {

bool can_be_filled(const quads::PlanarRegion& region)
{
    std::size_t sides = 0;
    for (const auto& loop : region.loops) sides += loop.size();
    return sides % 2 == 0 && !geometry::find_crossing(region.points, region.loops);
}

} // namespace

TEST_CASE("a triangle with two boundary sides and a neighbour becomes convex quads that leave the boundary "
          "as it is")
{
    // Two triangles: each has two boundary sides, so the side between is halved.
    const MixedMesh pair{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2, 2}, {0, 2, 3, 3}}, 4};
    const MixedMesh split = quads::split_cells(pair);
    CHECK(split.cells.size() == 10);
    for (const Quad& q : split.cells) CHECK(quads::scaled_jacobian(split.points, q) > 0);
}

TEST_CASE("split triangles fill every region that can be filled, spiked and crowded ones too")
{
    for (std::uint32_t seed = 0; seed < 120; ++seed) {
        const test::RandomDomain made = test::random_domain(seed, 40);
        if (!can_be_filled(made.region)) continue;
        CAPTURE(seed);
        const quads::PlanarQuads mesh = quads::quads_of_triangles(made.region);
        const std::string fault = quads::find_fault(mesh, made.region);
        CHECK_MESSAGE(fault.empty(), fault);
    }
}

TEST_CASE("folds made in a mesh are filled anew, and quads away from them stay")
{
    constexpr int kSide = 20;
    quads::PlanarRegion region;
    quads::PlanarQuads mesh;
    std::vector<std::vector<Index>> node(kSide + 1, std::vector<Index>(kSide + 1, -1));
    const auto add = [&](int x, int y) {
        node[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)] = static_cast<Index>(
            mesh.points.size());
        mesh.points.emplace_back(x, y);
    };
    for (int k = 0; k < kSide; ++k) add(k, 0);
    for (int k = 0; k < kSide; ++k) add(kSide, k);
    for (int k = kSide; k > 0; --k) add(k, kSide);
    for (int k = kSide; k > 0; --k) add(0, k);
    region.points = mesh.points;
    region.loops.emplace_back();
    for (std::size_t p = 0; p < mesh.points.size(); ++p) region.loops[0].push_back(static_cast<Index>(p));
    for (int x = 1; x < kSide; ++x)
        for (int y = 1; y < kSide; ++y) add(x, y);
    const auto at = [&](int x, int y) {
        return node[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)];
    };
    for (int x = 0; x < kSide; ++x)
        for (int y = 0; y < kSide; ++y)
            mesh.quads.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
    REQUIRE(quads::find_fault(mesh, region).empty());
    // One node far off in the middle, one beside a corner, pulled over its neighbours.
    mesh.points[static_cast<std::size_t>(at(10, 10))] += Vec2(2.4, 1.7);
    mesh.points[static_cast<std::size_t>(at(1, 1))] += Vec2(-0.9, 1.5);
    const quads::PlanarQuads folded = mesh;
    CHECK(quads::paving::refill_cavities(mesh, region, 0, [](const Vec2&) { return 1.0; }) == 2);
    const std::string fault = quads::find_fault(mesh, region);
    CHECK_MESSAGE(fault.empty(), fault);
    const Quad far{at(16, 3), at(17, 3), at(17, 4), at(16, 4)};
    std::size_t kept = 0;
    for (const Quad& q : mesh.quads) {
        std::array<Vec2, 4> corner, other;
        for (std::size_t k = 0; k < 4; ++k) {
            corner[k] = mesh.points[static_cast<std::size_t>(q[k])];
            other[k] = folded.points[static_cast<std::size_t>(far[k])];
        }
        kept += corner == other ? 1 : 0;
    }
    CHECK(kept == 1);
    // What is sound is left alone.
    const std::size_t quads = mesh.quads.size();
    CHECK(quads::paving::refill_cavities(mesh, region, 0, [](const Vec2&) { return 1.0; }) == 0);
    CHECK(mesh.quads.size() == quads);
}
