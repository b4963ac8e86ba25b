// SPDX-License-Identifier: MIT
#include "support/plane_domains.h"

#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/quads/detail/split_cells.h>
#include <lacuna/quads/detail/triangle_quads.h>
#include <lacuna/quads/shared/measure_plane.h>

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
