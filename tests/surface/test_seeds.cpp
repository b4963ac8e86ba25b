// SPDX-License-Identifier: MIT
#include "support/dice.h"
#include "support/measure_sources.h"
#include "surface/sealed.h"

#include <lacuna/core/error.h>
#include <lacuna/quads/shared/pave.h>
#include <lacuna/surface/detail/face_sides.h>
#include <lacuna/surface/shared/default_size.h>
#include <lacuna/surface/shared/seeds.h>
#include <lacuna/surface/shared/source_mesh.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace lacuna;
using namespace lacuna::topology;
using surface::QuadStyle;
using surface::Seeds;
using test::PrismOptions;
using test::without;

namespace {

surface::SizeField even(double size)
{
    return [size](const Vec3&) { return size; };
}

int total(const Model& model, FaceId face, const Seeds& seeds)
{
    int sum = 0;
    for (const Loop& loop : model[face].loops) {
        for (const EdgeUse& use : loop.uses) sum += seeds.count(use.edge);
    }
    return sum;
}

/// Mapped faces: as many sides opposite each other. Free ones: an even number in all. Pieces run over each
/// edge without a gap.
void check_seeds(const OpenVolume& volume, const Seeds& seeds)
{
    const Model& model = volume.model;
    for (const FaceId face : volume.faces(Role::source)) {
        const auto corners = seeds.corners.find(face);
        if (corners == seeds.corners.end()) {
            CHECK(total(model, face, seeds) % 2 == 0);
            continue;
        }
        REQUIRE(corners->second.size() == 4);
        const Loop& loop = model[face].loops.front();
        std::array<int, 4> side{};
        for (std::size_t s = 0; s < 4; ++s) {
            for (std::size_t i = corners->second[s]; i != corners->second[(s + 1) % 4];
                 i = (i + 1) % loop.uses.size())
                side[s] += seeds.count(loop.uses[i].edge);
        }
        CHECK(side[0] == side[2]);
        CHECK(side[1] == side[3]);
    }
    for (const auto& [edge, pieces] : seeds.pieces) {
        double at = 0;
        for (const auto& piece : pieces) {
            CHECK(piece.from == doctest::Approx(at));
            CHECK(piece.count >= 1);
            at = piece.to;
        }
        CHECK(at == doctest::Approx(1));
        const auto fractions = seeds.fractions(edge);
        CHECK(fractions.size() == static_cast<std::size_t>(seeds.count(edge)) + 1);
        CHECK(std::is_sorted(fractions.begin(), fractions.end()));
        CHECK(fractions.front() == 0);
        CHECK(fractions.back() == 1);
    }
}

} // namespace

TEST_CASE(
    "seeds follow the size, are even in all where faces are free, and equal on opposite sides where mapped")
{
    int combinations = 0;
    for (const int sides : {0, 3, 4, 5, 7}) {
        for (const int holes : {0, 1, 3}) {
            for (const int hole_sides : {0, 3, 4}) {
                for (const double size : {0.03, 0.11, 0.4, 5.0}) {
                    for (const QuadStyle style : {QuadStyle::automatic, QuadStyle::free}) {
                        const auto volume = test::sealed(
                            {.sides = sides, .holes = holes, .hole_sides = hole_sides});
                        const auto links = surface::linking_surfaces(volume);
                        const Seeds seeds = surface::seed_source(volume, links, even(size), style);
                        CAPTURE(sides);
                        CAPTURE(holes);
                        CAPTURE(hole_sides);
                        CAPTURE(size);
                        check_seeds(volume, seeds);
                        CHECK((!seeds.corners.empty()) ==
                              (sides == 4 && holes == 0 && style == QuadStyle::automatic));
                        int raised = 0;
                        for (const auto& [edge, pieces] : seeds.pieces) {
                            const double wanted = edge_length(volume.model, edge) / size;
                            const bool round = volume.model[edge].from == volume.model[edge].to;
                            const int least = round ? surface::ShapeSizing{}.curvature : 1;
                            const int plain = std::max(least, static_cast<int>(std::lround(wanted - 1e-6)));
                            const int count = seeds.count(edge);
                            raised += std::abs(count - plain);
                            if (style == QuadStyle::free) {
                                CHECK(count >= plain);
                                continue;
                            }
                            // A ring's loops meet half way; others stay within a quarter, or four sides.
                            const double most = holes == 1 ? 1.72 : 1.25;
                            CHECK((std::abs(count - plain) <= 4 ||
                                   (count <= most * plain && plain <= most * count)));
                        }
                        if (style == QuadStyle::free) CHECK(raised <= 1);
                        ++combinations;
                    }
                }
            }
        }
    }
    MESSAGE(combinations << " sources");
}

TEST_CASE("boards of source faces agree along the edges they share")
{
    int combinations = 0;
    for (const auto& [n, m] : std::vector<std::pair<int, int>>{{1, 2}, {3, 2}, {4, 4}, {5, 3}}) {
        for (const bool hole : {false, true}) {
            if (hole && (n < 3 || m < 3)) continue;
            const auto volume = test::board_box(n, m, 1,
                                                [&](int i, int j) { return hole && i == 1 && j == 1; });
            const auto links = surface::linking_surfaces(volume);
            for (const QuadStyle style : {QuadStyle::automatic, QuadStyle::free, QuadStyle::mapped}) {
                const auto graded = [](const Vec3& p) { return 0.15 + 0.1 * p.x() + 0.03 * p.y() * p.y(); };
                CAPTURE(n);
                CAPTURE(m);
                CAPTURE(hole);
                check_seeds(volume, surface::seed_source(volume, links, graded, style));
                check_seeds(volume, surface::seed_source(volume, links, even(0.37), style));
                combinations += 2;
            }
        }
    }
    MESSAGE(combinations << " boards");
}

TEST_CASE("a face that is to be mapped and is no grid of right angles is refused by name")
{
    for (const int sides : {3, 5, 0}) {
        const auto volume = test::sealed({.sides = sides});
        const auto links = surface::linking_surfaces(volume);
        try {
            surface::seed_source(volume, links, even(0.2), QuadStyle::mapped);
            FAIL("it was mapped");
        } catch (const NotSweepable& error) {
            CHECK(error.code() == "surface.not_four_sided");
            CHECK(std::string(error.what()).find("face ") != std::string::npos);
        }
    }
    // Four corners, and a round hole.
    const auto holed = test::sealed({.sides = 4, .holes = 1, .hole_sides = 0});
    CHECK_THROWS_AS(
        surface::seed_source(holed, surface::linking_surfaces(holed), even(0.2), QuadStyle::mapped),
        NotSweepable);
}

TEST_CASE("a size that varies is followed along an edge")
{
    const auto volume = test::sealed({.sides = 4});
    const auto links = surface::linking_surfaces(volume);
    const auto graded = [](const Vec3& p) { return p.x() > 0 ? 0.05 : 0.2; };
    const Seeds seeds = surface::seed_source(volume, links, graded, QuadStyle::free);
    int fine = 0, coarse = 0;
    for (const auto& [edge, pieces] : seeds.pieces) {
        const Vec3 a = volume.model.at(volume.model[edge].points.front()),
                   b = volume.model.at(volume.model[edge].points.back());
        ((a + b).x() > 0 ? fine : coarse) += seeds.count(edge);
    }
    CHECK(fine == doctest::Approx(4 * coarse).epsilon(0.1));
}

TEST_CASE("the spacing of the rim is the mean of its facets' sides")
{
    for (const int cuts : {1, 4}) {
        const auto volume = test::sealed({.sides = 6, .cuts = cuts});
        CHECK(surface::default_size(volume).length == doctest::Approx(1.0 / cuts));
    }
}

TEST_CASE("counts of faces of right angles are made to agree, so that their grid has no irregular node")
{
    const std::vector<Vec2> corners{{0, 0}, {3.1, 0}, {3.1, 1.2}, {1.4, 1.2}, {1.4, 2.7}, {0, 2.7}};
    for (const double size : {0.31, 0.23, 0.17, 0.11}) {
        CAPTURE(size);
        const topology::OpenVolume volume = test::sealed({.outline = corners});
        const auto links = surface::linking_surfaces(volume);
        const auto even = [size](const Vec3&) { return size; };
        const surface::Seeds seeds = surface::seed_source(volume, links, even, surface::QuadStyle::automatic);
        for (const FaceId face : volume.faces(topology::Role::source)) {
            CHECK(seeds.submapped.contains(face));
            const auto total = [&](const std::vector<EdgeId>& edges) {
                int sum = 0;
                for (const EdgeId edge : edges) sum += seeds.count(edge);
                return sum;
            };
            const auto pairs = surface::grid_sides(volume.model, face);
            REQUIRE(pairs.size() == 2);
            for (const auto& sides : pairs) CHECK(total(sides[0]) == total(sides[1]));
        }
        const surface::SourceMesh mesh = surface::mesh_source(
            volume, links, seeds, {even}, [](const quads::PlanarRegion& region, const RunContext& context) {
                return quads::pave(region, {}, context).mesh;
            });
        REQUIRE(mesh.notes.size() == 1);
        CHECK(mesh.notes.front().find("submapped") != std::string::npos);
    }
}

TEST_CASE("edges that mirror each other get as many sides, whatever the size")
{
    struct Case {
        std::vector<Vec2> corners;
        std::vector<std::size_t> mirror; ///< of each side
    };
    const std::vector<Case> cases{
        {{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {5, 4, 3, 2, 1, 0}},
        {{{-0.4, 0}, {0.4, 0}, {0.4, 2}, {1.5, 2}, {1.5, 2.8}, {-1.5, 2.8}, {-1.5, 2}, {-0.4, 2}},
         {0, 7, 6, 5, 4, 3, 2, 1}},
        {{{0, 0},
          {5, 0},
          {5, 3},
          {4, 3},
          {4, 1.3},
          {3, 1.3},
          {3, 3},
          {2, 3},
          {2, 1.3},
          {1, 1.3},
          {1, 3},
          {0, 3}},
         {0, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1}},
        {{{0, 0}, {3, 0}, {2.2, 2.1}, {0.8, 2.1}}, {0, 3, 2, 1}},
        {{{0, 0}, {2, 0}, {3, 1.1}, {1, 2.3}, {-1, 1.1}}, {0, 4, 3, 2, 1}},
    };
    for (const Case& c : cases) {
        for (const double size : {0.61, 0.43, 0.31, 0.23, 0.171, 0.113}) {
            CAPTURE(c.corners.size());
            CAPTURE(size);
            const topology::OpenVolume volume = test::sealed({.outline = c.corners});
            const auto links = surface::linking_surfaces(volume);
            const surface::Seeds seeds = surface::seed_source(volume, links, even(size),
                                                              surface::QuadStyle::automatic);
            check_seeds(volume, seeds);
            const auto count_between = [&](const Vec2& a, const Vec2& b) {
                for (const auto& [edge, pieces] : seeds.pieces) {
                    const auto near = [&](VertexId v, const Vec2& p) {
                        const Vec3& at = volume.model.at(volume.model[v].point);
                        return (Vec2(at.x(), at.y()) - p).norm() < 1e-9;
                    };
                    const Edge& e = volume.model[edge];
                    if ((near(e.from, a) && near(e.to, b)) || (near(e.from, b) && near(e.to, a)))
                        return seeds.count(edge);
                }
                return 0;
            };
            const std::size_t n = c.corners.size();
            for (std::size_t s = 0; s < n; ++s) {
                const std::size_t m = c.mirror[s];
                const int own = count_between(c.corners[s], c.corners[(s + 1) % n]);
                CHECK(own > 0);
                CHECK(own == count_between(c.corners[m], c.corners[(m + 1) % n]));
            }
        }
    }
}

TEST_CASE("sources of three sides get as many quads as asked, within a quarter, whatever the size")
{
    test::Dice dice(37);
    int near = 0, all = 0;
    for (int n = 0; n < 60; ++n) {
        // Neither a corner nor a side much smaller than the others.
        const Vec2 top(dice.between(0.3, 0.7), dice.between(0.7, 1.1));
        const topology::OpenVolume volume = test::sealed({.outline = {{0, 0}, {1, 0}, top}});
        const auto links = surface::linking_surfaces(volume);
        const double quads = dice.log_between(30, 1000), size = std::sqrt(top.y() / 2 / quads);
        CAPTURE(n);
        CAPTURE(quads);
        const Seeds seeds = surface::seed_source(volume, links, even(size), QuadStyle::automatic);
        const surface::SourceMesh mesh = surface::mesh_source(
            volume, links, seeds, {even(size), {}},
            [](const quads::PlanarRegion& region, const RunContext& context) {
                return quads::pave(region, {}, context).mesh;
            });
        const test::UnionQuality q = test::measure_union(mesh, size);
        CHECK(q.bad_sides == 0);
        CHECK(q.min_scaled_jacobian > 0.6);
        near += std::abs(static_cast<double>(q.quads) / quads - 1) <= 0.25 ? 1 : 0;
        ++all;
    }
    CHECK(near >= 0.95 * all);
    MESSAGE(near << " of " << all);
}

TEST_CASE("sides between corners are even where quads are made of a quarter as many, and only there")
{
    int odd_of_few = 0;
    for (const int corners : {6, 7, 9, 11}) {
        std::vector<Vec2> outline;
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * std::acos(-1.0) * i / corners, radius = 1 + 0.05 * (i % 3);
            outline.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
        }
        const topology::OpenVolume volume = test::sealed({.outline = outline});
        const auto links = surface::linking_surfaces(volume);
        const double area = face_area(volume.model, volume.faces(Role::source).front());
        for (const double quads : {5000.0, 5500.0, 25000.0, 26000.0, 41000.0, 99000.0}) {
            CAPTURE(outline.size());
            CAPTURE(quads);
            const Seeds seeds = surface::seed_source(volume, links, even(std::sqrt(area / quads)),
                                                     QuadStyle::automatic);
            check_seeds(volume, seeds);
            for (const auto& [edge, pieces] : seeds.pieces) {
                const int odd = seeds.count(edge) % 2;
                if (quads > 20'000) CHECK(odd == 0);
                if (quads < 20'000) odd_of_few += odd;
            }
        }
    }
    CHECK(odd_of_few > 0);
}
