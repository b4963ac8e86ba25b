// SPDX-License-Identifier: MIT
#include "support/plane_domains.h"
#include "support/whole_families.h"

#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/quads/shared/pave.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

using namespace lacuna;

namespace {

/// No quad may be flatter than this, unless the flattest triangle over the same nodes is as flat: where sides
/// all but touch there are none but needles.
constexpr double kFlat = 0.02, kOfTriangles = 0.2;

/// A sweep of loops of up to 400 edges, as many as LACUNA_RANDOM_DOMAINS says from LACUNA_RANDOM_FIRST on;
/// else 14 of smaller ones, which take seconds, or 40 where whole families are run.
struct Sweep {
    std::uint32_t first = 0, count = test::whole_families() ? 40 : 14;
    int most_edges = 32;
};

Sweep sweep()
{
    Sweep asked;
    if (const char* count = std::getenv("LACUNA_RANDOM_DOMAINS")) {
        asked.count = static_cast<std::uint32_t>(std::stoul(count));
        asked.most_edges = 400;
    }
    if (const char* first = std::getenv("LACUNA_RANDOM_FIRST"))
        asked.first = static_cast<std::uint32_t>(std::stoul(first));
    return asked;
}

std::size_t sides(const quads::PlanarRegion& region)
{
    std::size_t count = 0;
    for (const auto& loop : region.loops) count += loop.size();
    return count;
}

/// Why no mesh of quads can be asked for; empty where one can.
std::string reason_to_refuse(const quads::PlanarRegion& region)
{
    if (sides(region) % 2 != 0) return "odd";
    if (geometry::find_crossing(region.points, region.loops)) return "crossed";
    return {};
}

/// Least sine of a triangle's corners in the Delaunay triangulation of the boundary nodes alone.
double flattest_triangle(const quads::PlanarRegion& region)
{
    const geometry::Triangulation mesh = geometry::triangulate(region.points, region.loops,
                                                               {.interior_points = false});
    double least = 1;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2& p = mesh.points[static_cast<std::size_t>(t[k])];
            const Vec2 a = mesh.points[static_cast<std::size_t>(t[(k + 1) % 3])] - p,
                       b = mesh.points[static_cast<std::size_t>(t[(k + 2) % 3])] - p;
            least = std::min(least, (a.x() * b.y() - a.y() * b.x()) / (a.norm() * b.norm()));
        }
    }
    return least;
}

} // namespace

TEST_CASE("the random domains are what they are said to be")
{
    std::size_t most_loops = 0, longest = 0, odd = 0, crossed = 0;
    double widest_jump = 1;
    for (std::uint32_t seed = 0; seed < 300; ++seed) {
        const test::RandomDomain made = test::random_domain(seed);
        CAPTURE(seed);
        CAPTURE(made.words);
        CHECK((sides(made.region) % 2 != 0) == made.odd);
        if (!made.crossed) CHECK(!geometry::find_crossing(made.region.points, made.region.loops));
        most_loops = std::max(most_loops, made.region.loops.size());
        odd += made.odd ? 1 : 0;
        crossed += reason_to_refuse(made.region) == "crossed" ? 1 : 0;
        for (const auto& loop : made.region.loops) {
            CHECK(loop.size() >= 4);
            longest = std::max(longest, loop.size());
            double shortest = 1e9, widest = 0;
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const double side =
                    (made.region.points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])] -
                     made.region.points[static_cast<std::size_t>(loop[i])])
                        .norm();
                shortest = std::min(shortest, side);
                widest = std::max(widest, side);
            }
            widest_jump = std::max(widest_jump, widest / shortest);
        }
    }
    CHECK(most_loops == 8);
    CHECK(longest > 380);
    CHECK(widest_jump > 50);
    CHECK(odd > 0);
    CHECK(crossed > 0);
}

TEST_CASE("every random domain that can be filled is filled with valid quads; the others are refused")
{
    const Sweep asked = sweep();
    std::size_t filled = 0, refused = 0, needles = 0;
    for (std::uint32_t seed = asked.first; seed < asked.first + asked.count; ++seed) {
        const test::RandomDomain made = test::random_domain(seed, asked.most_edges);
        const std::string reason = reason_to_refuse(made.region);
        CAPTURE(seed);
        CAPTURE(made.words);
        if (!reason.empty()) {
            CHECK_THROWS_AS(quads::pave(made.region), InvalidInput);
            ++refused;
            continue;
        }
        const quads::PlanarQuads mesh = quads::pave(made.region).mesh;
        const std::string fault = quads::find_fault(mesh, made.region);
        CHECK_MESSAGE(fault.empty(), "domain " << seed << ": " << fault);
        const double least = quads::measure_plane(mesh, made.region).min_scaled_jacobian;
        if (least < kFlat) {
            ++needles;
            CHECK(least >= kOfTriangles * std::min(kFlat / kOfTriangles, flattest_triangle(made.region)));
        }
        ++filled;
    }
    MESSAGE(filled << " filled, " << needles << " of them with needles where the boundary leaves no better; "
                   << refused << " refused for a reason");
    CHECK(filled > refused);
}

TEST_CASE("the same random domain gives the same quads")
{
    for (std::uint32_t seed = 0; seed < 4; ++seed) {
        const test::RandomDomain made = test::random_domain(seed, 24);
        if (!reason_to_refuse(made.region).empty()) continue;
        CAPTURE(seed);
        const quads::PlanarQuads once = quads::pave(made.region).mesh, again = quads::pave(made.region).mesh;
        CHECK(once.quads == again.quads);
        CHECK(once.points == again.points);
    }
}
