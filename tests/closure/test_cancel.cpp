// SPDX-License-Identifier: MIT
#include "sealing_checks.h"
#include "support/cancelling.h"

#include <lacuna/closure/shared/along.h>

#include <chrono>

using namespace lacuna;
using namespace lacuna::topology;
using test::without;

TEST_CASE("matching and closing heed a cancel in every class")
{
    for (const auto& drop :
         {without(false, false, true), without(false, false, false, {0, 1}),
          without(false, false, false, {0}), without(false, true, false), without(true, true, false)}) {
        const OpenVolume volume = test::prism({.sides = 4, .drop = drop}).open();
        const bool ends = !volume.faces(Role::source).empty() && !volume.faces(Role::target).empty();
        matching::Match match;
        if (ends) {
            match = matching::match(volume);
            for (const auto method : {matching::Method::aligned, matching::Method::nearest}) {
                matching::MatchOptions options;
                options.method = method;
                CHECK(test::heeds_cancel(
                    [&](const RunContext& context) { matching::match(volume, options, context); }));
            }
        }
        CHECK(test::heeds_cancel(
            [&](const RunContext& context) { closure::close(volume, match, {}, context); }));
    }
}

TEST_CASE("a source along a path heeds a cancel, and stops within half a second")
{
    const OpenVolume source =
        test::prism({.sides = 4, .cuts = 40, .drop = without(false, true, true)}).open();
    const closure::Along along{closure::Along::Helix{Vec3(4, 0, 0), Vec3(0, 1, 0), 4, 5}, {}, {}};
    const auto seal = [&](const RunContext& context) {
        closure::close_along(closure::swept_source(source.model, source, along, context), {}, context);
    };
    CHECK(test::heeds_cancel(seal));
    const auto seconds = test::stops_within(std::chrono::milliseconds(30), [&](const RunContext& context) {
        for (;;) seal(context);
    });
    REQUIRE(seconds);
    CHECK(*seconds < 0.5);
}

TEST_CASE("matching many loops stops within half a second")
{
    std::vector<test::RoundHole> holes;
    for (int i = 0; i < 64; ++i) holes.push_back({Vec2(0.1 * (i % 8) - 0.35, 0.1 * (i / 8) - 0.35), 0.03});
    const OpenVolume volume =
        test::prism({.sides = 4, .hole_list = holes, .cuts = 4, .drop = without(false, false, true)}).open();
    const auto seconds = test::stops_within(std::chrono::milliseconds(30), [&](const RunContext& context) {
        for (;;) matching::match(volume, {}, context);
    });
    REQUIRE(seconds);
    CHECK(*seconds < 0.5);
}

TEST_CASE("closing along bent walls of many facets stops within half a second, wherever it is")
{
    const OpenVolume volume = test::prism({.sides = 4,
                                           .height = 5,
                                           .cuts = 40,
                                           .levels = 120,
                                           .bend = 90,
                                           .drop = without(false, false, false, {0})})
                                  .open();
    for (const int wait : {10, 100, 300, 600}) {
        CAPTURE(wait);
        const auto seconds = test::stops_within(
            std::chrono::milliseconds(wait), [&](const RunContext& context) {
                for (;;) closure::close(volume, matching::match(volume, {}, context), {}, context);
            });
        REQUIRE(seconds);
        CHECK(*seconds < 0.5);
    }
}
