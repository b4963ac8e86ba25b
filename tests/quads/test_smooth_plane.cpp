// SPDX-License-Identifier: MIT
#include "plane_grids.h"
#include "support/plane_domains.h"
#include "support/quad_meshers.h"

#include <lacuna/quads/detail/smooth_plane.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

using namespace lacuna;
using test::PlaneGrid;

namespace {

void smooth(PlaneGrid& grid, const quads::SmoothPlaneOptions& options = {})
{
    quads::smooth_plane(grid.mesh.points, grid.mesh.quads, grid.region.points.size(), options);
}

double least(const PlaneGrid& grid)
{
    return quads::least_scaled_jacobian(grid.mesh.points, grid.mesh.quads);
}

std::vector<PlaneGrid> family()
{
    std::vector<PlaneGrid> grids{test::plane_grid(2, 2), test::plane_grid(9, 7), test::plane_grid(30, 3),
                                 test::plane_corner(6)};
    for (const int sides : {3, 5, 6}) {
        grids.push_back(test::plane_polygon(sides, 5));
        test::map(grids.back(), [](const Vec2& p) { return Vec2(6 * p); });
    }
    PlaneGrid bent = test::plane_grid(20, 6);
    test::map(bent, [](const Vec2& p) {
        const double angle = p.x() / 8, radius = 10 - p.y();
        return Vec2(radius * std::cos(angle), radius * std::sin(angle));
    });
    grids.push_back(bent);
    return grids;
}

} // namespace

TEST_CASE("shaken grids become valid again, however folded, and fixed points stay")
{
    for (const PlaneGrid& good : family()) {
        for (const double most : {0.2, 0.6, 2.0}) {
            for (const std::uint32_t seed : {1U, 2U, 3U}) {
                PlaneGrid grid = good;
                test::shake(grid, most, seed);
                CAPTURE(good.mesh.quads.size());
                CAPTURE(most);
                CAPTURE(seed);
                const double before = least(grid);
                smooth(grid, {.size = {}, .sweeps = 30});
                CHECK(quads::find_fault(grid.mesh, grid.region) == "");
                CHECK(least(grid) >= before);
                CHECK(least(grid) >= 0.5);
            }
        }
    }
}

TEST_CASE("what is perfect is left alone")
{
    for (const auto& [m, n] : {std::pair(4, 4), std::pair(12, 5)}) {
        PlaneGrid grid = test::plane_grid(m, n);
        const std::vector<Vec2> before = grid.mesh.points;
        smooth(grid);
        for (std::size_t p = 0; p < before.size(); ++p)
            CHECK((grid.mesh.points[p] - before[p]).norm() < 1e-12);
    }
}

TEST_CASE("the least scaled Jacobian never falls, with any options")
{
    for (const PlaneGrid& good : family()) {
        for (std::uint32_t seed = 0; seed < 20; ++seed) {
            PlaneGrid grid = good;
            test::shake(grid, 0.1 + 0.04 * seed, seed);
            const double before = least(grid);
            CAPTURE(seed);
            quads::SmoothPlaneOptions options;
            options.sweeps = static_cast<int>(seed % 4);
            options.repairs = static_cast<int>(seed % 3);
            options.untangle = seed % 2 == 0;
            if (seed % 5 == 0) options.size = [](const Vec2& p) { return p.x() > 3 ? 0.3 : 2.0; };
            smooth(grid, options);
            CHECK(least(grid) >= before);
            CHECK(least(grid) == quads::measure_plane(grid.mesh, grid.region).min_scaled_jacobian);
            CHECK(std::equal(grid.region.points.begin(), grid.region.points.end(), grid.mesh.points.begin()));
        }
    }
}

TEST_CASE("poor quads over the named domains get better, in the worst and in the mean")
{
    for (const test::PlaneDomain& domain : test::plane_domains()) {
        CAPTURE(domain.name);
        const test::SeededDomain seeded = test::seed_domain(domain, 600);
        quads::PlanarQuads mesh = test::midpoint_quads(seeded.region, {});
        const quads::PlaneQuality before = quads::measure_plane(mesh, seeded.region);
        quads::smooth_plane(mesh.points, mesh.quads, seeded.region.points.size(),
                            {.size = seeded.region.size});
        const quads::PlaneQuality after = quads::measure_plane(mesh, seeded.region);
        CHECK(quads::find_fault(mesh, seeded.region) == "");
        CHECK(after.min_scaled_jacobian >= before.min_scaled_jacobian);
        CHECK(after.mean_scaled_jacobian > before.mean_scaled_jacobian);
    }
}

TEST_CASE("with a size the quads follow it better than without")
{
    // The rim is even, the size asked grows along x: only inner points can follow.
    PlaneGrid grid = test::plane_grid(16, 8);
    // No step may lower the least scaled Jacobian: so it must not be 1 at first.
    test::shake(grid, 0.3, 3);
    grid.region.size = [](const Vec2& p) { return 0.6 + 0.05 * p.x(); };
    // Area of the quads on the left, where less is asked, over that of as many on the right.
    const auto contrast = [&](const quads::SmoothPlaneOptions& options) {
        PlaneGrid tried = grid;
        smooth(tried, options);
        double left = 0, right = 0;
        for (std::size_t q = 0; q < tried.mesh.quads.size(); ++q) {
            const Quad& quad = tried.mesh.quads[q];
            const auto at = [&](std::size_t k) {
                return tried.mesh.points[static_cast<std::size_t>(quad[k])];
            };
            const Vec2 u = at(2) - at(0), v = at(3) - at(1);
            (q % 16 < 8 ? left : right) += (u.x() * v.y() - u.y() * v.x()) / 2;
        }
        return left / right;
    };
    quads::SmoothPlaneOptions options;
    options.sweeps = 60;
    const double without = contrast(options);
    CHECK(without == doctest::Approx(1).epsilon(0.02));
    options.size = grid.region.size;
    options.size_weight = 3;
    CHECK(contrast(options) < 0.9 * without);
}

TEST_CASE("the same comes out every time")
{
    for (const PlaneGrid& good : family()) {
        PlaneGrid one = good;
        test::shake(one, 0.8, 5);
        PlaneGrid two = one;
        smooth(one);
        smooth(two);
        CHECK(one.mesh.points == two.mesh.points);
    }
}

TEST_CASE("many points come out the same on any number of threads, and as good as few")
{
    for (const double most : {0.2, 0.35}) {
        CAPTURE(most);
        PlaneGrid shaken = test::plane_grid(180, 140);
        test::shake(shaken, most, 5);
        PlaneGrid few = test::plane_grid(40, 30);
        test::shake(few, most, 5);
        smooth(few);
        std::vector<Vec2> first;
        for (const int threads : {1, 2, 3, 7}) {
            PlaneGrid grid = shaken;
            RunContext context;
            context.threads = threads;
            quads::smooth_plane(grid.mesh.points, grid.mesh.quads, grid.region.points.size(), {}, context);
            CHECK(quads::find_fault(grid.mesh, grid.region) == "");
            CHECK(least(grid) >= least(few) - 0.05);
            if (first.empty()) first = grid.mesh.points;
            CHECK(grid.mesh.points == first);
        }
    }
}

TEST_CASE("smoothing stops when it is told to")
{
    PlaneGrid grid = test::plane_grid(9, 9);
    test::shake(grid, 0.3, 1);
    const std::atomic<bool> cancel = true;
    RunContext context;
    context.cancel = &cancel;
    CHECK_THROWS(
        quads::smooth_plane(grid.mesh.points, grid.mesh.quads, grid.region.points.size(), {}, context));
}
