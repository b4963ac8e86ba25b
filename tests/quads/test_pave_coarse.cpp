// SPDX-License-Identifier: MIT
#include "support/plane_domains.h"

#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/detail/coarse_region.h>
#include <lacuna/quads/detail/smooth_plane.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/quads/shared/odd_region.h>
#include <lacuna/quads/shared/pave.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace lacuna;
using namespace lacuna::quads;

namespace {

/// A round loop of so many nodes; clockwise where it is a hole.
void add_round(PlanarRegion& region, const Vec2& centre, double radius, int nodes)
{
    const double way = region.loops.empty() ? 1 : -1;
    std::vector<Index>& loop = region.loops.emplace_back();
    for (int i = 0; i < nodes; ++i) {
        const double angle = way * 2 * std::numbers::pi * i / nodes;
        loop.push_back(static_cast<Index>(region.points.size()));
        region.points.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
}

/// The shortest side of a mesh over the mean one.
double shortest_side(const PlanarQuads& mesh)
{
    double least = 1e300, sum = 0;
    for (const Quad& quad : mesh.quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            const double length =
                (mesh.points[index(quad[k])] - mesh.points[index(quad[(k + 1) % 4])]).norm();
            least = std::min(least, length);
            sum += length / 4;
        }
    }
    return least * static_cast<double>(mesh.quads.size()) / sum;
}

/// A disc with holes, whose nodes lie `size` apart.
PlanarRegion disc_with_holes(int outer, const std::vector<int>& holes)
{
    PlanarRegion region;
    add_round(region, Vec2::Zero(), 1, outer);
    const double size = 2 * std::numbers::pi / outer;
    for (std::size_t h = 0; h < holes.size(); ++h) {
        const double angle = 2.4 * static_cast<double>(h);
        add_round(region, 0.5 * Vec2(std::cos(angle), std::sin(angle)),
                  size * holes[h] / (2 * std::numbers::pi), holes[h]);
    }
    region.size = [size](const Vec2&) { return size; };
    return region;
}

/// A rectangle whose edges have so many sides, about one long.
PlanarRegion rectangle(const std::vector<int>& sides)
{
    PlanarRegion region;
    const double width = sides[0], height = sides[1];
    const Vec2 corners[] = {{0, 0}, {width, 0}, {width, height}, {0, height}};
    region.loops.emplace_back();
    for (std::size_t c = 0; c < 4; ++c) {
        for (int k = 0; k < sides[c]; ++k) {
            region.loops[0].push_back(static_cast<Index>(region.points.size()));
            region.points.push_back(corners[c] + (corners[(c + 1) % 4] - corners[c]) * k / sides[c]);
        }
    }
    region.size = [](const Vec2&) { return 1; };
    return region;
}

std::size_t sides_of(const PlanarRegion& region)
{
    std::size_t sides = 0;
    for (const auto& loop : region.loops) sides += loop.size();
    return sides;
}

PlanarQuads paved(const PlanarRegion& region, const RunContext& context = {})
{
    return pave(region, {}, context).mesh;
}

} // namespace

TEST_CASE("a coarse region has every other node of every loop, whatever loops there are")
{
    for (const int outer : {200, 202, 260}) {
        for (const std::vector<int>& holes : {std::vector<int>{}, {40}, {40, 42}, {38, 36, 50}}) {
            CAPTURE(outer);
            CAPTURE(holes.size());
            const PlanarRegion region = disc_with_holes(outer, holes);
            const auto coarse = paving::coarse_region(region);
            REQUIRE(coarse);
            CHECK(2 * sides_of(coarse->region) == sides_of(region));
            for (std::size_t p = 0; p < coarse->own.size(); ++p) {
                CHECK(coarse->region.points[p] == region.points[index(coarse->own[p])]);
                CHECK(coarse->next[p] != coarse->own[p]);
            }
            CHECK(coarse->region.size(Vec2::Zero()) == doctest::Approx(2 * region.size(Vec2::Zero())));
        }
    }
}

TEST_CASE("no region is made coarse that would lose many corners or has an odd number of sides")
{
    CHECK_FALSE(paving::coarse_region(disc_with_holes(201, {})));
    CHECK_FALSE(paving::coarse_region(disc_with_holes(201, {40})));
    CHECK_FALSE(paving::coarse_region(disc_with_holes(200, {12})));
}

TEST_CASE("odd loops and edges keep one side whole each, and quads cut in four keep all boundary nodes")
{
    std::vector<PlanarRegion> regions{disc_with_holes(121, {35}), disc_with_holes(161, {35, 36}),
                                      disc_with_holes(160, {35, 41}), disc_with_holes(161, {35, 41, 43})};
    for (const int first : {24, 25})
        for (const int second : {30, 31}) regions.push_back(rectangle({first, second, first, second}));
    regions.push_back(rectangle({25, 25, 24, 24}));
    regions.push_back(rectangle({31, 20, 30, 21}));
    for (const PlanarRegion& region : regions) {
        CAPTURE(region.points.size());
        CAPTURE(region.loops.size());
        auto coarse = paving::coarse_region(region);
        REQUIRE(coarse);
        CHECK(2 * sides_of(coarse->region) == sides_of(region) + coarse->runs.size());
        const PlanarQuads filled = fill_odd_region(coarse->region, paved);
        const auto whole = paving::choose_whole_sides(*coarse, filled);
        REQUIRE(whole);
        CHECK(std::count(coarse->next.begin(), coarse->next.end(), -1) ==
              static_cast<std::ptrdiff_t>(coarse->runs.size()));
        PlanarQuads fine = paving::cut_in_four(region, *coarse, filled, *whole);
        CHECK(std::none_of(fine.quads.begin(), fine.quads.end(), mesh::is_triangle));
        smooth_plane(fine.points, fine.quads, region.points.size(), {.size = region.size});
        CHECK(find_fault(fine, region) == "");
        for (std::size_t p = 0; p < region.points.size(); ++p) CHECK(fine.points[p] == region.points[p]);
    }
}

TEST_CASE("quads cut in four keep all boundary nodes, and are four for a quad and three for a triangle")
{
    for (const int outer : {120, 122, 160}) {
        for (const std::vector<int>& holes : {std::vector<int>{}, {36}, {38, 36}}) {
            CAPTURE(outer);
            CAPTURE(holes.size());
            const PlanarRegion region = disc_with_holes(outer, holes);
            auto coarse = paving::coarse_region(region);
            REQUIRE(coarse);
            const bool odd = sides_of(coarse->region) % 2 != 0;
            const PlanarQuads filled = fill_odd_region(coarse->region, paved);
            const auto whole = paving::choose_whole_sides(*coarse, filled);
            REQUIRE(whole);
            const PlanarQuads fine = paving::cut_in_four(region, *coarse, filled, *whole);
            CHECK(fine.quads.size() == 4 * filled.quads.size() - (odd ? 1 : 0));
            CHECK(find_fault(fine, region) == "");
            for (std::size_t p = 0; p < region.points.size(); ++p) CHECK(fine.points[p] == region.points[p]);
        }
    }
}

TEST_CASE("sides divided and closed again leave a triangle each, and every boundary node")
{
    for (const int outer : {120, 121}) {
        const PlanarRegion region = disc_with_holes(outer, {37, 36, 35});
        std::vector<RegionSide> sides{{1, 3}, {3, 20}};
        if (outer % 2 != 0) sides.push_back({0, 50});
        CAPTURE(outer);
        const PlanarQuads mesh = fill_divided_region(region, sides, paved);
        for (std::size_t p = 0; p < region.points.size(); ++p) CHECK(mesh.points[p] == region.points[p]);
        CHECK(std::count_if(mesh.quads.begin(), mesh.quads.end(), mesh::is_triangle) ==
              static_cast<std::ptrdiff_t>(sides.size()));
        const std::size_t first = mesh.quads.size() - sides.size();
        for (std::size_t q = 0; q < first; ++q) {
            CHECK_FALSE(mesh::is_triangle(mesh.quads[q]));
            CHECK(scaled_jacobian(mesh.points, mesh.quads[q]) > 0);
        }
    }
}

TEST_CASE("quads of a coarse mesh of a coarser one are good, whatever the numbers of sides of its loops")
{
    using Case = std::pair<int, std::vector<int>>;
    for (const auto& [outer, holes] :
         {Case{720, {}}, Case{720, {100}}, Case{720, {102}}, Case{720, {98, 106, 102}},
          Case{720, {110, 110, 112, 108, 110}}, Case{700, {66, 70, 74, 78, 82}},
          Case{700, {90, 94, 98, 102, 106}}, Case{740, {74, 78, 82, 86, 90}}, Case{721, {101}},
          Case{719, {103, 98}}, Case{720, {101, 103}}, Case{721, {67, 71, 75, 78, 82}}}) {
        CAPTURE(outer);
        CAPTURE(holes.size());
        const PlanarRegion region = disc_with_holes(outer, holes);
        const PlanarQuads mesh = paved(region);
        CHECK(find_fault(mesh, region) == "");
        CHECK(mesh.how.find("cut in four, each quad cut in four") != std::string::npos);
        const PlaneQuality quality = measure_plane(mesh, region);
        CHECK(quality.min_scaled_jacobian > 0.65);
        CHECK(quality.mean_scaled_jacobian > 0.97);
        CHECK(quality.size_share() > 0.95);
        // Right angles alone drew points together where a triangle was cut in three beside a hole.
        CHECK(shortest_side(mesh) > 0.2);
    }
}

TEST_CASE("many quads are as good as fewer, with hardly more irregular nodes")
{
    for (const std::string name : {"disc", "plate", "flange", "slot"}) {
        CAPTURE(name);
        const auto few = test::seed_domain(test::plane_domain(name), 12'000);
        const auto many = test::seed_domain(test::plane_domain(name), 40'000);
        const PlanarQuads small = paved(few.region), large = paved(many.region);
        CHECK(find_fault(large, many.region) == "");
        const PlaneQuality before = measure_plane(small, few.region),
                           after = measure_plane(large, many.region);
        CHECK(after.min_scaled_jacobian > 0.7);
        CHECK(after.mean_scaled_jacobian > 0.97);
        CHECK(after.size_share() > 0.95);
        CHECK(after.irregular < 2 * before.irregular + 40);
        CHECK(large.how.find("cut in four") != std::string::npos);
    }
}

TEST_CASE(
    "boundary rows of rings of many quads are as high as was asked, though sides of one loop are longer")
{
    for (const int quads : {24'000, 36'500, 60'000}) {
        CAPTURE(quads);
        const auto seeded = test::seed_domain(test::plane_domain("ring"), quads);
        const PlanarQuads mesh = paved(seeded.region);
        CHECK(find_fault(mesh, seeded.region) == "");
        CHECK(mesh.how.find("cut in four") != std::string::npos);
        const PlaneQuality quality = measure_plane(mesh, seeded.region);
        CHECK(quality.row_share() > 0.95);
        CHECK(quality.mean_scaled_jacobian > 0.99);
        CHECK(quality.size_share() > 0.95);
    }
}
