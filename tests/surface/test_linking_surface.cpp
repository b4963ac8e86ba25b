// SPDX-License-Identifier: MIT
#include "surface/sealed.h"

#include <lacuna/core/error.h>
#include <lacuna/surface/detail/linking_map.h>
#include <lacuna/surface/shared/linking_surface.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using surface::LinkingSurface;
using test::Part;
using test::PrismOptions;
using test::without;

namespace {

/// Lines in order round both rims; segments one after the other, once round each.
void check_link(const LinkingSurface& link)
{
    for (std::size_t i = 0; i + 1 < link.lines.size(); ++i) {
        CHECK(link.lines[i].source_at < link.lines[i + 1].source_at);
        CHECK(link.lines[i].target_at < link.lines[i + 1].target_at);
    }
    REQUIRE(!link.segments.empty());
    CHECK(link.segments.front().source_from == 0);
    CHECK(link.segments.back().source_to == doctest::Approx(link.source.length()));
    CHECK(link.segments.back().target_to - link.segments.front().target_from ==
          doctest::Approx(link.target.length()));
    for (std::size_t i = 0; i < link.segments.size(); ++i) {
        const auto& s = link.segments[i];
        CHECK(s.source_from < s.source_to);
        CHECK(s.target_from < s.target_to);
        CHECK(s.source_from >= link.source.start(s.use) - 1e-9);
        CHECK(s.source_to <= link.source.start(s.use + 1) + 1e-9);
        if (i == 0) continue;
        CHECK(s.source_from == link.segments[i - 1].source_to);
        CHECK(s.target_from == link.segments[i - 1].target_to);
    }
}

} // namespace

TEST_CASE(
    "there is a linking surface a loop, its lines in order round both ends, and together they have all walls")
{
    int combinations = 0;
    for (const int sides : {0, 3, 4, 6}) {
        for (const int holes : {0, 1, 3}) {
            for (const int hole_sides : {0, 4}) {
                for (const int rows : {1, 3}) {
                    for (const int pieces : {1, 2}) {
                        for (const double bend : {0.0, 80.0}) {
                            const auto volume = test::sealed({.sides = sides,
                                                              .height = 4,
                                                              .holes = holes,
                                                              .hole_sides = hole_sides,
                                                              .rows = rows,
                                                              .pieces = pieces,
                                                              .levels = 4,
                                                              .bend = bend});
                            CAPTURE(sides);
                            CAPTURE(holes);
                            CAPTURE(hole_sides);
                            CAPTURE(rows);
                            CAPTURE(pieces);
                            CAPTURE(bend);
                            const auto links = surface::linking_surfaces(volume);
                            REQUIRE(links.size() == static_cast<std::size_t>(holes) + 1);
                            std::set<FaceId> walls;
                            for (std::size_t b = 0; b < links.size(); ++b) {
                                check_link(links[b]);
                                for (const FaceId wall : links[b].walls) CHECK(walls.insert(wall).second);
                                const int n = b == 0 ? sides : hole_sides;
                                const int lines = n == 0 ? (pieces == 1 ? 0 : pieces) : n * pieces;
                                CHECK(links[b].lines.size() == static_cast<std::size_t>(lines));
                            }
                            CHECK(walls.size() == volume.faces(Role::wall).size());
                            ++combinations;
                        }
                    }
                }
            }
        }
    }
    MESSAGE(combinations << " sealed prisms");
}

TEST_CASE("linking surfaces of void walls are like those of given ones")
{
    int combinations = 0;
    for (const int sides : {0, 3, 4, 5}) {
        for (const int holes : {0, 2}) {
            for (const auto& drop : {without(false, false, true), without(false, false, false, {0}),
                                     without(false, false, false, {0, 1}), without(true, true, false),
                                     without(false, true, false)}) {
                const auto volume = test::sealed(
                    {.sides = sides, .holes = holes, .taper = 0.7, .drop = drop});
                const auto links = surface::linking_surfaces(volume);
                REQUIRE(links.size() == static_cast<std::size_t>(holes) + 1);
                for (const LinkingSurface& link : links) check_link(link);
                ++combinations;
            }
        }
    }
    MESSAGE(combinations << " sealed prisms");
}

TEST_CASE("without side lines the target is started where the walls lead straight up")
{
    for (const double twist : {0.0, 40.0, -100.0}) {
        for (const int hole_sides : {0}) {
            const auto volume = test::sealed({.sides = 0,
                                              .height = 3,
                                              .holes = 1,
                                              .hole_sides = hole_sides,
                                              .cuts = 4,
                                              .levels = 12,
                                              .twist = twist});
            for (const LinkingSurface& link : surface::linking_surfaces(volume)) {
                REQUIRE(link.lines.empty());
                const std::vector<double> low{0},
                    high{std::fmod(link.segments.front().target_from, link.target.length())};
                const Vec3 a = link.source.points(low)[0], b = link.target.points(high)[0];
                const double turn = std::remainder(std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x()),
                                                   2 * std::numbers::pi) *
                                    180 / std::numbers::pi;
                // Walls that turn their facets lead half of the way round with them; a smooth round wall does
                // not turn anything.
                CAPTURE(twist);
                CHECK(std::abs(turn) <= std::abs(twist) + 2);
            }
        }
    }
}

TEST_CASE("walls that do not join one loop to one are refused")
{
    const auto bare = test::prism({.drop = without(false, false, true)}).open();
    CHECK_THROWS_AS(surface::linking_surfaces(bare), NotSweepable);
    const auto fewer = test::prism({.holes = 1, .drop = [](const Part& p) { return p.loop == 1; }}).open();
    try {
        surface::linking_surfaces(fewer);
        FAIL("a loop without walls was taken");
    } catch (const NotSweepable& error) {
        CHECK(error.code() == "surface.no_belt");
        CHECK(std::string(error.what()).find("edge ") != std::string::npos);
    }
}

TEST_CASE("the strip of a linking surface is one to one: neighbours stay neighbours, and it turns once round "
          "and once up")
{
    int combinations = 0;
    for (const int sides : {0, 3, 4}) {
        for (const int rows : {1, 3}) {
            for (const int pieces : {1, 2}) {
                for (const double twist : {0.0, 30.0}) {
                    const auto volume = test::sealed({.sides = sides,
                                                      .height = 2,
                                                      .cuts = 3,
                                                      .rows = rows,
                                                      .pieces = pieces,
                                                      .levels = 4,
                                                      .twist = twist,
                                                      .taper = 0.8});
                    const LinkingSurface link = surface::linking_surfaces(volume).front();
                    const surface::LinkingMap map(volume, link);
                    CAPTURE(sides);
                    CAPTURE(rows);
                    CAPTURE(pieces);
                    CAPTURE(twist);
                    const auto at = [&](double s, double t) {
                        const auto place = map.locate(s, t);
                        const std::vector<surface::FacetPosition> one{place.at};
                        return surface::points_at(volume.model, place.face, one)[0];
                    };
                    constexpr int kRound = 48, kUp = 12;
                    double turned = 0;
                    std::size_t backward = 0;
                    for (int k = 0; k <= kUp; ++k) {
                        double round = 0;
                        for (int i = 0; i < kRound; ++i) {
                            const Vec3 a = at(double(i) / kRound, double(k) / kUp),
                                       b = at(double(i + 1) / kRound, double(k) / kUp);
                            const double step = std::remainder(
                                std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x()), 2 * std::numbers::pi);
                            backward += step < 0 ? 1 : 0;
                            round += step;
                            if (k < kUp) {
                                const Vec3 c = at(double(i) / kRound, double(k + 1) / kUp);
                                backward += c.z() <= a.z() ? 1 : 0;
                            }
                            if (k == 0) CHECK(a.z() == doctest::Approx(0));
                            if (k == kUp) CHECK(a.z() == doctest::Approx(2));
                        }
                        turned = round;
                        CHECK(std::abs(turned) == doctest::Approx(2 * std::numbers::pi));
                    }
                    // All one way round: the source's rim runs clockwise seen from above.
                    CHECK((backward == 0 || backward == std::size_t(kRound) * (kUp + 1)));
                    const auto rings = map.rings();
                    CHECK(rings.size() == static_cast<std::size_t>(rows - 1));
                    ++combinations;
                }
            }
        }
    }
    MESSAGE(combinations << " strips");
}

TEST_CASE("linking surfaces and their maps stop where they are asked to")
{
    for (const int sides : {0, 4}) {
        CAPTURE(sides);
        const auto volume = test::sealed({.sides = sides, .levels = 4});
        const auto links = surface::linking_surfaces(volume);
        const std::atomic<bool> cancel{true};
        RunContext context;
        context.cancel = &cancel;
        CHECK_THROWS_AS(surface::linking_surfaces(volume, surface::Turning::each, {}, context), Cancelled);
        CHECK_THROWS_AS(surface::LinkingMap(volume, links.front(), true, context), Cancelled);
    }
}
