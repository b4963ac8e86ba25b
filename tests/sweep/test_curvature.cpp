// SPDX-License-Identifier: MIT
#include "support/check_valid.h"
#include "support/edit_model.h"
#include "support/whole_families.h"
#include "surface/sealed.h"

#include <lacuna/core/error.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace lacuna;
using namespace lacuna::topology;
using sweep::SweepOptions;
using sweep::Swept;
using test::End;
using test::PrismOptions;

namespace {

SweepOptions coarse(double size, int curvature, int layers = 2)
{
    SweepOptions options;
    options.layers.count = layers;
    options.size = [size](const Vec3&) { return size; };
    options.curvature = curvature;
    options.volume_share = 0; // the sides asked for, whatever they lose
    return options;
}

Swept swept_valid(const OpenVolume& volume, const SweepOptions& options)
{
    Swept swept = sweep::sweep(volume, options);
    test::check_valid(swept.mesh);
    return swept;
}

/// Sides of the source's rim within a distance of the axis.
std::vector<std::array<Vec3, 2>> rim_sides(const mesh::HexMesh& mesh, double from, double to)
{
    std::vector<std::array<Vec3, 2>> sides;
    for (const Segment& side : mesh.rim) {
        const Vec3 &a = mesh.nodes[index(side[0])], &b = mesh.nodes[index(side[1])];
        const double r = a.head<2>().norm();
        if (r >= from && r <= to) sides.push_back({a, b});
    }
    return sides;
}

double distance(const Vec3& p, const std::array<Vec3, 2>& side)
{
    const Vec3 d = side[1] - side[0];
    const double f = std::clamp((p - side[0]).dot(d) / d.squaredNorm(), 0.0, 1.0);
    return (p - side[0] - f * d).norm();
}

} // namespace

TEST_CASE("a round rim gets the sides asked for a full turn where the size is coarser, and no fewer else")
{
    for (const int hole : {0, 1}) {
        const auto volume = test::sealed({.sides = 0, .holes = hole, .hole_sides = 0, .cuts = 8});
        for (const int per_turn : {8, 12, 20, 32}) {
            CAPTURE(hole);
            CAPTURE(per_turn);
            const Swept swept = swept_valid(volume, coarse(10, per_turn));
            const auto loops = static_cast<std::size_t>(1 + hole);
            // A grid asks for as many sides one way as back: up to two more a loop.
            CHECK(swept.mesh.rim.size() >= loops * static_cast<std::size_t>(per_turn));
            CHECK(swept.mesh.rim.size() <= loops * static_cast<std::size_t>(per_turn + 2));
        }
        const Swept fine = swept_valid(volume, coarse(0.1, 12)), alone = swept_valid(volume, coarse(0.1, 0));
        CHECK(fine.mesh.quads == alone.mesh.quads);
        CHECK(fine.mesh.rim.size() > 24);
    }
}

TEST_CASE("where coarse sides lose volume, bends get as many sides as keep it within the share allowed")
{
    for (const double share : {0.05, 0.02, 0.01}) {
        for (const double size : {0.5, 10.0}) {
            SweepOptions options = coarse(size, 12, 4);
            options.volume_share = share;
            const Swept swept = swept_valid(test::sealed({.sides = 0, .cuts = 24}), options);
            CAPTURE(share);
            CAPTURE(size);
            CHECK(swept.fidelity.volume > (1 - share) * swept.fidelity.sealed_volume);
        }
    }
}

TEST_CASE("with the size alone a round rim keeps six sides")
{
    const auto volume = test::sealed({.sides = 0, .cuts = 8});
    CHECK(swept_valid(volume, coarse(10, 0)).mesh.rim.size() == 6);
}

TEST_CASE("corners are no curvature: straight-sided sources get no side more")
{
    for (const int sides : {3, 4, 5, 6, 8}) {
        const auto volume = test::sealed({.sides = sides});
        CAPTURE(sides);
        const Swept some = swept_valid(volume, coarse(0.4, 12)), none = swept_valid(volume, coarse(0.4, 0));
        CHECK(some.mesh.quads == none.mesh.quads);
        CHECK(some.mesh.nodes == none.mesh.nodes);
    }
    CHECK(swept_valid(test::sealed({.sides = 4}), coarse(10, 100)).mesh.quads.size() == 1);
}

TEST_CASE("a domed source is meshed as fine as it is curved")
{
    std::size_t before = 0;
    for (const double lift : {0.1, 0.4, 0.8}) {
        const auto volume = test::sealed({.sides = 4, .cuts = 12, .source = End::bowed, .lift = lift});
        SweepOptions options = coarse(10, 24);
        const Swept swept = swept_valid(volume, options);
        CAPTURE(lift);
        CHECK(swept.mesh.quads.size() > before);
        before = swept.mesh.quads.size();
    }
    CHECK(before > 16);
}

TEST_CASE("opposite rims of thin rings never come near each other, whatever the size")
{
    int rings = 0;
    test::MembersToRun run(5);
    for (const double inner : {0.8, 0.95, 0.98}) {
        for (const double off : {0.0, 0.3, 0.6}) {
            for (const int per_turn : {0, 12}) {
                for (const double size : {0.1, 0.5, 5.0}) {
                    if (!run.next()) continue;
                    const double width = 1 - inner, shift = off * width;
                    const auto volume = test::sealed(
                        {.sides = 0, .hole_sides = 0, .hole_list = {{Vec2(shift, 0), inner}}, .cuts = 16});
                    CAPTURE(inner);
                    CAPTURE(off);
                    CAPTURE(per_turn);
                    CAPTURE(size);
                    const Swept swept = swept_valid(volume, coarse(size, per_turn));
                    const auto outer = rim_sides(swept.mesh, 1 - 1e-6, 1 + 1e-6);
                    double least = 1e300;
                    for (const auto& hole : rim_sides(swept.mesh, 0, 1 - 1e-3)) {
                        for (const auto& side : outer) least = std::min(least, distance(hole[0], side));
                    }
                    CHECK(least > 0.4 * (width - shift));
                    CHECK(quality::measure(swept.mesh).min_scaled_jacobian > 0.05);
                    ++rings;
                }
            }
        }
    }
    MESSAGE(rings << " rings");
}

TEST_CASE("a neck gets as many quads across as asked for, and the rest stays coarse")
{
    int necks = 0;
    for (const double width : {0.3, 0.2}) {
        const double w = width / 2;
        const std::vector<Vec2> dumbbell{{-2, -1}, {-0.5, -1}, {-0.5, -w}, {0.5, -w}, {0.5, -1}, {2, -1},
                                         {2, 1},   {0.5, 1},   {0.5, w},   {-0.5, w}, {-0.5, 1}, {-2, 1}};
        const auto volume = test::sealed({.outline = dumbbell});
        for (const auto style : {sweep::Quads::paved, sweep::Quads::automatic}) {
            std::size_t before = 0;
            for (const int gap : {0, 2, 4}) {
                SweepOptions options = coarse(0.5, 12);
                options.gap = gap;
                options.quads = style;
                const Swept swept = swept_valid(volume, options);
                CAPTURE(width);
                CAPTURE(gap);
                CHECK(swept.mesh.quads.size() > before);
                before = swept.mesh.quads.size();
                // Quads that a line across the middle of the neck meets.
                int across = 0;
                for (const Quad& q : swept.mesh.quads) {
                    double low = 1e300, high = -1e300;
                    for (const Index n : q) {
                        low = std::min(low, swept.mesh.nodes[index(n)].x());
                        high = std::max(high, swept.mesh.nodes[index(n)].x());
                    }
                    across += low < 0.0123 && high > 0.0123 ? 1 : 0;
                }
                CHECK(across >= gap);
                CHECK(across <= 2 * gap + 2);
                ++necks;
            }
            CHECK(before < 40 * 2 * 8 * static_cast<std::size_t>(1 / width));
        }
    }
    MESSAGE(necks << " necks");
}

TEST_CASE("a wedge and the corners of a square are no narrow places")
{
    for (const auto& outline :
         std::vector<std::vector<Vec2>>{{{0, 0}, {4, 0}, {4, 1}}, {{0, 0}, {2, 0}, {2, 2}, {0, 2}}}) {
        const auto volume = test::sealed({.outline = outline});
        SweepOptions options = coarse(0.25, 12);
        options.quads = lacuna::sweep::Quads::paved; // across a gap no grids are tried
        const Swept plain = swept_valid(volume, options);
        options.gap = 2;
        CHECK(swept_valid(volume, options).mesh.quads == plain.mesh.quads);
    }
}

TEST_CASE("options of curvature, gap and deviation that mean nothing are refused by name")
{
    const auto volume = test::sealed({.sides = 4});
    const auto refused = [&](const std::function<void(SweepOptions&)>& set) {
        SweepOptions options = coarse(1, 12);
        set(options);
        try {
            sweep::sweep(volume, options);
        } catch (const InvalidInput& error) {
            return error.code();
        }
        return std::string("done");
    };
    CHECK(refused([](SweepOptions& o) { o.curvature = -1; }) == "sweep.curvature");
    CHECK(refused([](SweepOptions& o) { o.gap = -2; }) == "sweep.gap");
    CHECK(refused([](SweepOptions& o) { o.max_deviation = -0.1; }) == "sweep.max_deviation");
    CHECK(refused([](SweepOptions& o) { o.max_deviation = std::nan(""); }) == "sweep.max_deviation");
}

TEST_CASE("round walls are swept without a turn, though the diagonals of their facets all run one way")
{
    for (const double taper : {1.0, 0.6, 0.3, 1.5}) {
        for (const int holes : {0, 1}) {
            CAPTURE(taper);
            CAPTURE(holes);
            const auto volume = test::sealed({.sides = 0,
                                              .height = 4,
                                              .holes = holes,
                                              .hole_sides = 0,
                                              .cuts = 4,
                                              .levels = 12,
                                              .taper = taper});
            const Swept swept = swept_valid(volume, coarse(5.0, 8, 4));
            const auto layer = static_cast<std::size_t>(swept.mesh.nodes_per_layer);
            for (const Segment& side : swept.mesh.rim) {
                const Vec3& low = swept.mesh.nodes[index(side[0])];
                const Vec3& high = swept.mesh.nodes[index(side[0]) + 4 * layer];
                CHECK(low.head<2>().normalized().dot(high.head<2>().normalized()) >
                      std::cos(std::numbers::pi / 180));
            }
        }
    }
}

TEST_CASE("elbows and cones with holes are swept with eight sides for a full turn")
{
    int shapes = 0;
    double worst = 1;
    test::MembersToRun run(3); // seven of 20
    for (const int holes : {0, 1, 2}) {
        for (const int hole_sides : {0, 4}) {
            for (const double bend : {0.0, 90.0}) {
                for (const double taper : {1.0, 0.6}) {
                    if (holes == 0 && hole_sides == 4) continue;
                    if (!run.next()) continue;
                    const auto volume = test::sealed({.sides = 0,
                                                      .height = 4,
                                                      .holes = holes,
                                                      .hole_sides = hole_sides,
                                                      .cuts = 4,
                                                      .levels = 12,
                                                      .taper = taper,
                                                      .bend = bend});
                    CAPTURE(holes);
                    CAPTURE(hole_sides);
                    CAPTURE(bend);
                    CAPTURE(taper);
                    SweepOptions options = coarse(5.0, 8);
                    options.layers.count = 10;
                    const Swept swept = swept_valid(volume, options);
                    worst = std::min(worst, swept.min_scaled_jacobian);
                    CHECK(swept.min_scaled_jacobian >= 0.2);
                    ++shapes;
                }
            }
        }
    }
    MESSAGE(shapes << " shapes, scaled Jacobian " << worst << " at least");
}

namespace {

/// A rod of two straight legs and a bend of radius 2 between them, bent from an upright prism of as many
/// levels.
OpenVolume bent_rod(int sides, double leg, double degrees)
{
    constexpr double kRadius = 2;
    const double angle = degrees * std::numbers::pi / 180, arc = kRadius * angle;
    OpenVolume volume = test::sealed(
        {.sides = sides, .height = 2 * leg + arc, .cuts = sides == 0 ? 4 : 3, .levels = 96});
    test::edit(volume.model, [&](ModelBuilder& model) {
        for (Vec3& p : model.points) {
            const double turn = std::clamp(p.z() - leg, 0.0, arc) / kRadius;
            const double before = std::min(p.z(), leg), after = std::max(0.0, p.z() - leg - arc);
            const Vec3 out(std::cos(turn), 0, std::sin(turn)), up(-std::sin(turn), 0, std::cos(turn));
            const Vec3 centre(-kRadius, 0, before);
            p = centre + (kRadius + p.x()) * out + p.y() * Vec3::UnitY() + after * up;
        }
    });
    return volume;
}

std::vector<double> even_heights(int layers)
{
    std::vector<double> heights;
    for (int k = 1; k <= layers; ++k) heights.push_back(static_cast<double>(k) / layers);
    return heights;
}

} // namespace

TEST_CASE("layers that are counted are even, also where a rod bends")
{
    for (const double leg : {0.0, 2.0}) {
        for (const double degrees : {0.0, 80.0, 160.0}) {
            if (leg + degrees == 0) continue;
            CAPTURE(leg);
            CAPTURE(degrees);
            const OpenVolume rod = bent_rod(4, leg, degrees);
            SweepOptions options = coarse(0.5, 12, 0);
            options.layers.heights = even_heights(6);
            const Swept even = swept_valid(rod, options);
            const Swept counted = swept_valid(rod, coarse(0.5, 12, 6));
            CHECK(counted.mesh.nodes == even.mesh.nodes);
        }
    }
    const OpenVolume rod = bent_rod(4, 5, 90);
    SweepOptions options = coarse(0.5, 12, 0);
    options.layers.heights = even_heights(8);
    CHECK(swept_valid(rod, coarse(0.5, 0, 8)).mesh.nodes == swept_valid(rod, options).mesh.nodes);
}
