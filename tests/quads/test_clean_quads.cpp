// SPDX-License-Identifier: MIT
#include "patch_outline.h"
#include "plane_grids.h"
#include "support/plane_domains.h"
#include "support/quad_meshers.h"

#include <lacuna/quads/detail/clean_quads.h>
#include <lacuna/quads/detail/patch_template.h>
#include <lacuna/quads/detail/smooth_plane.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

using namespace lacuna;
using test::outline;
using test::PlaneGrid;

namespace {

std::vector<quads::TemplateMesh> fillings(const std::vector<Vec2>& loop,
                                          const std::vector<std::size_t>& corners, std::size_t most)
{
    std::vector<quads::TemplateMesh> made;
    for (const quads::TemplateCut& cut : quads::find_cuts(loop, corners, most))
        made.push_back(quads::fill_template(loop, corners, cut));
    return made;
}

/// Inner points with two quads.
std::size_t doublets(const quads::PlanarQuads& mesh, std::size_t fixed)
{
    std::vector<int> valence(mesh.points.size(), 0);
    for (const Quad& quad : mesh.quads)
        for (const Index p : quad) ++valence[static_cast<std::size_t>(p)];
    return static_cast<std::size_t>(
        std::count(valence.begin() + static_cast<std::ptrdiff_t>(fixed), valence.end(), 2));
}

/// A filling uses every side of its loop once, others twice, and has one quad at a corner, two elsewhere on
/// the loop.
void check_filling(const std::vector<Vec2>& loop, const std::vector<std::size_t>& corners,
                   const quads::TemplateMesh& filling)
{
    quads::PlanarQuads mesh{loop, filling.quads};
    mesh.points.insert(mesh.points.end(), filling.inner.begin(), filling.inner.end());
    quads::PlanarRegion region{loop, {{}}, {}};
    for (std::size_t p = 0; p < loop.size(); ++p) region.loops[0].push_back(static_cast<Index>(p));
    const std::string fault = quads::find_fault(mesh, region);
    const bool only_folded = fault.empty() || fault.find("not positive") != std::string::npos;
    CHECK_MESSAGE(only_folded, fault);
    std::vector<int> valence(mesh.points.size(), 0);
    for (const Quad& quad : mesh.quads) {
        for (const Index p : quad) ++valence[static_cast<std::size_t>(p)];
    }
    int irregular = 0;
    for (std::size_t p = 0; p < valence.size(); ++p) {
        if (p >= loop.size()) {
            irregular += valence[p] != 4 ? 1 : 0;
        } else {
            const bool corner = std::find(corners.begin(), corners.end(), p) != corners.end();
            CHECK(valence[p] == (corner ? 1 : 2));
        }
    }
    CHECK(irregular == filling.irregular);
}

} // namespace

TEST_CASE("patches of three to six sides are filled with as few irregular points as promised")
{
    int filled = 0;
    for (const int count : {3, 4, 5, 6}) {
        std::vector<int> sides(static_cast<std::size_t>(count), 1);
        // All lengths from 1 to 4.
        for (bool more = true; more;) {
            std::vector<std::size_t> corners;
            const std::vector<Vec2> loop = outline(sides, corners);
            const auto found = fillings(loop, corners, 3);
            const int promised = quads::fewest_irregular(loop.size(), corners);
            for (const quads::TemplateMesh& filling : found) {
                check_filling(loop, corners, filling);
                CHECK(filling.irregular <= promised); // two may come together in one
                ++filled;
            }
            std::size_t i = 0;
            while (i < sides.size() && sides[i] == 4) sides[i++] = 1;
            more = i < sides.size();
            if (more) ++sides[i];
        }
    }
    CHECK(filled > 500);
}

TEST_CASE("fillings of a rectangle are grids, and of two sides or lengths that differ by one have two "
          "irregular points")
{
    for (const int m : {1, 3, 6}) {
        std::vector<std::size_t> corners;
        const std::vector<Vec2> loop = outline({m, 4, m, 4}, corners);
        const auto grid = fillings(loop, corners, 3);
        REQUIRE(grid.size() == 1);
        CHECK(grid[0].irregular == 0);
        CHECK(grid[0].quads.size() == static_cast<std::size_t>(4 * m));
    }
    std::vector<std::size_t> corners;
    const std::vector<Vec2> loop = outline({5, 5, 6, 6}, corners);
    for (const auto& filling : fillings(loop, corners, 3)) {
        check_filling(loop, corners, filling);
        CHECK(filling.irregular == 2);
    }
    CHECK_FALSE(fillings(loop, corners, 3).empty());
}

TEST_CASE("quads over the named domains lose half of their irregular points and none of their quality")
{
    std::size_t all_before = 0, all_after = 0;
    for (const test::PlaneDomain& domain : test::plane_domains()) {
        CAPTURE(domain.name);
        const test::SeededDomain seeded = test::seed_domain(domain, 500);
        quads::PlanarQuads mesh = test::midpoint_quads(seeded.region, {});
        const std::size_t fixed = seeded.region.points.size();
        quads::smooth_plane(mesh.points, mesh.quads, fixed);
        const quads::PlaneQuality before = quads::measure_plane(mesh, seeded.region);
        quads::clean_quads(mesh, fixed, {.size = {}, .effort = 1000});
        const quads::PlaneQuality after = quads::measure_plane(mesh, seeded.region);
        CHECK(quads::find_fault(mesh, seeded.region) == "");
        CHECK(4 * after.irregular <= 3 * before.irregular);
        all_before += before.irregular;
        all_after += after.irregular;
        CHECK(after.min_scaled_jacobian >= std::min(before.min_scaled_jacobian, 0.6));
        CHECK(after.mean_scaled_jacobian >= before.mean_scaled_jacobian);
    }
    CHECK(2 * all_after <= all_before);
}

TEST_CASE("a patch is cut in each way once, the straightest and squarest first")
{
    for (const std::vector<int>& sides : {std::vector<int>{5, 5, 6, 6},
                                          {4, 3, 5, 6},
                                          {3, 3, 3, 3, 4, 4},
                                          {2, 3, 4, 5, 4, 4},
                                          {3, 5, 3, 4, 2, 5}}) {
        std::vector<std::size_t> corners;
        const std::vector<Vec2> loop = outline(sides, corners);
        const auto cuts = quads::find_cuts(loop, corners, 1000);
        REQUIRE_FALSE(cuts.empty());
        std::set<std::array<std::size_t, 3>> seen;
        for (std::size_t i = 0; i < cuts.size(); ++i) {
            const auto [from, to] = std::minmax(cuts[i].from, cuts[i].to);
            CHECK(seen.insert({from, to, static_cast<std::size_t>(cuts[i].edges)}).second);
            if (i > 0) CHECK(cuts[i - 1].fault <= cuts[i].fault);
        }
    }
}

TEST_CASE("no quad becomes worse than the worst there was, or than the least that was asked for")
{
    std::size_t changed = 0;
    for (const test::PlaneDomain& domain : test::plane_domains()) {
        CAPTURE(domain.name);
        const test::SeededDomain seeded = test::seed_domain(domain, 300);
        const std::size_t fixed = seeded.region.points.size();
        quads::PlanarQuads start = test::midpoint_quads(seeded.region, {});
        quads::smooth_plane(start.points, start.quads, fixed);
        // Else two quads with a straight angle or more are one afterwards.
        REQUIRE(doublets(start, fixed) == 0);
        const quads::PlaneQuality before = quads::measure_plane(start, seeded.region);
        for (const double least : {0.0, 0.3, 0.6, 1.0}) {
            for (const bool sized : {false, true}) {
                CAPTURE(least);
                CAPTURE(sized);
                quads::PlanarQuads mesh = start;
                quads::CleanOptions options;
                options.least = least;
                if (sized) options.size = seeded.region.size;
                quads::clean_quads(mesh, fixed, options);
                const quads::PlaneQuality after = quads::measure_plane(mesh, seeded.region);
                CHECK(after.min_scaled_jacobian >= std::min(before.min_scaled_jacobian, least));
                CHECK(after.irregular + after.boundary_irregular <=
                      before.irregular + before.boundary_irregular);
                changed += mesh.quads != start.quads ? 1U : 0U;
            }
        }
    }
    CHECK(changed > 0);
}

TEST_CASE("points with two quads go")
{
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        PlaneGrid grid = test::plane_grid(8, 8);
        const std::vector<Vec2> regular = grid.mesh.points;
        // Every few quads one is cut in two along a bent diagonal.
        std::size_t cut = 0;
        for (std::size_t q = seed; q < 64; q += 7 + seed) {
            const Quad quad = grid.mesh.quads[q];
            Vec2 middle(0, 0);
            for (const Index p : quad) middle += grid.mesh.points[static_cast<std::size_t>(p)] / 4;
            const auto made = static_cast<Index>(grid.mesh.points.size());
            grid.mesh.points.push_back(middle);
            grid.mesh.quads[q] = {made, quad[0], quad[1], quad[2]};
            grid.mesh.quads.push_back({made, quad[2], quad[3], quad[0]});
            ++cut;
        }
        CHECK(doublets(grid.mesh, grid.region.points.size()) == cut);
        quads::clean_quads(grid.mesh, grid.region.points.size());
        CHECK(quads::measure_plane(grid.mesh, grid.region).irregular == 0);
        CHECK(grid.mesh.quads.size() == 64);
        CHECK(grid.mesh.points == regular);
        CHECK(quads::find_fault(grid.mesh, grid.region) == "");
    }
}

TEST_CASE("a mesh without irregular points, or with those its outline needs alone, stays as it is")
{
    for (const PlaneGrid& good : {test::plane_grid(1, 1), test::plane_grid(9, 5), test::plane_corner(4),
                                  test::plane_polygon(3, 4), test::plane_polygon(5, 4)}) {
        PlaneGrid grid = good;
        quads::clean_quads(grid.mesh, grid.region.points.size());
        CHECK(grid.mesh.points == good.mesh.points);
        CHECK(grid.mesh.quads == good.mesh.quads);
    }
}

TEST_CASE("cleaning gives the same quads every time")
{
    for (const char* name : {"plate", "gear"}) {
        const test::SeededDomain seeded = test::seed_domain(test::plane_domain(name), 400);
        quads::PlanarQuads one = test::midpoint_quads(seeded.region, {});
        quads::PlanarQuads two = one;
        quads::clean_quads(one, seeded.region.points.size());
        quads::clean_quads(two, seeded.region.points.size());
        CHECK(one.points == two.points);
        CHECK(one.quads == two.quads);
    }
}
