// SPDX-License-Identifier: MIT
#include "surface/sealed.h"

#include <lacuna/core/error.h>
#include <lacuna/surface/belt.h>
#include <lacuna/surface/detail/wall_map.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using surface::Belt;
using test::Part;
using test::PrismOptions;
using test::without;

namespace {

/// Lines in order round both rims; stretches one after the other, once round each.
void check_belt(const Belt& belt)
{
    for (std::size_t i = 0; i + 1 < belt.lines.size(); ++i) {
        CHECK(belt.lines[i].source_at < belt.lines[i + 1].source_at);
        CHECK(belt.lines[i].target_at < belt.lines[i + 1].target_at);
    }
    REQUIRE(!belt.stretches.empty());
    CHECK(belt.stretches.front().source_from == 0);
    CHECK(belt.stretches.back().source_to == doctest::Approx(belt.source.length()));
    CHECK(belt.stretches.back().target_to - belt.stretches.front().target_from ==
          doctest::Approx(belt.target.length()));
    for (std::size_t i = 0; i < belt.stretches.size(); ++i) {
        const auto& s = belt.stretches[i];
        CHECK(s.source_from < s.source_to);
        CHECK(s.target_from < s.target_to);
        CHECK(s.source_from >= belt.source.start(s.use) - 1e-9);
        CHECK(s.source_to <= belt.source.start(s.use + 1) + 1e-9);
        if (i == 0) continue;
        CHECK(s.source_from == belt.stretches[i - 1].source_to);
        CHECK(s.target_from == belt.stretches[i - 1].target_to);
    }
}

} // namespace

TEST_CASE("there is a belt a loop, its lines in order round both ends, and together they have all walls")
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
                            const auto belts = surface::belts(volume);
                            REQUIRE(belts.size() == static_cast<std::size_t>(holes) + 1);
                            std::set<FaceId> walls;
                            for (std::size_t b = 0; b < belts.size(); ++b) {
                                check_belt(belts[b]);
                                for (const FaceId wall : belts[b].walls) CHECK(walls.insert(wall).second);
                                const int n = b == 0 ? sides : hole_sides;
                                const int lines = n == 0 ? (pieces == 1 ? 0 : pieces) : n * pieces;
                                CHECK(belts[b].lines.size() == static_cast<std::size_t>(lines));
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

TEST_CASE("belts of void walls are like those of given ones")
{
    int combinations = 0;
    for (const int sides : {0, 3, 4, 5}) {
        for (const int holes : {0, 2}) {
            for (const auto& drop : {without(false, false, true), without(false, false, false, {0}),
                                     without(false, false, false, {0, 1}), without(true, true, false),
                                     without(false, true, false)}) {
                const auto volume = test::sealed(
                    {.sides = sides, .holes = holes, .taper = 0.7, .drop = drop});
                const auto belts = surface::belts(volume);
                REQUIRE(belts.size() == static_cast<std::size_t>(holes) + 1);
                for (const Belt& belt : belts) check_belt(belt);
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
            for (const Belt& belt : surface::belts(volume)) {
                REQUIRE(belt.lines.empty());
                const std::vector<double> low{0},
                    high{std::fmod(belt.stretches.front().target_from, belt.target.length())};
                const Vec3 a = belt.source.points(low)[0], b = belt.target.points(high)[0];
                const double turn = std::remainder(std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x()),
                                                   2 * std::numbers::pi) *
                                    180 / std::numbers::pi;
                // Walls that turn their facets lead half of the way round with them; a smooth round wall does not turn anything.
                CAPTURE(twist);
                CHECK(std::abs(turn) <= std::abs(twist) + 2);
            }
        }
    }
}

TEST_CASE("walls that do not join one loop to one are refused")
{
    const auto bare = test::prism({.drop = without(false, false, true)}).open();
    CHECK_THROWS_AS(surface::belts(bare), NotSweepable);
    const auto fewer = test::prism({.holes = 1, .drop = [](const Part& p) { return p.loop == 1; }}).open();
    try {
        surface::belts(fewer);
        FAIL("a loop without walls was taken");
    } catch (const NotSweepable& error) {
        CHECK(error.code() == "surface.no_belt");
        CHECK(std::string(error.what()).find("edge ") != std::string::npos);
    }
}

TEST_CASE(
    "the strip of a belt is one to one: neighbours stay neighbours, and it turns once round and once up")
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
                    const Belt belt = surface::belts(volume).front();
                    const surface::WallMap map(volume, belt);
                    CAPTURE(sides);
                    CAPTURE(rows);
                    CAPTURE(pieces);
                    CAPTURE(twist);
                    const auto at = [&](double s, double t) {
                        const auto place = map.locate(s, t);
                        const std::vector<surface::FacetPlace> one{place.at};
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
