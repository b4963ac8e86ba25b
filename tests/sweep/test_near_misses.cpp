// SPDX-License-Identifier: MIT
#include "support/assemblies.h"
#include "support/dice.h"
#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/core/shared/number_text.h>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

using namespace lacuna;
using sweep::NearMiss;
using sweep::SweptAssembly;
using test::Brick;
using test::brick;
using test::Members;

namespace {

/// Two blocks that meet in the plane of an axis, the second moved off the first.
struct Pair {
    Brick below, above;
    int axis = 2;
    double area = 0; ///< that they have over each other

    [[nodiscard]] Members members(double tolerance = 0) const
    {
        Members both;
        for (Brick each : {below, above}) {
            each.tolerance = tolerance;
            both.add(brick(each), 0.5);
        }
        return both;
    }
    [[nodiscard]] double volume() const
    {
        return (below.high - below.low).prod() + (above.high - above.low).prod();
    }
};

/// @param off  of the second, along the axis and across it.
Pair pair_of(test::Dice& dice, bool smaller, double off, double across)
{
    Pair pair;
    pair.axis = dice.whole(0, 2);
    const int u = (pair.axis + 1) % 3, v = (pair.axis + 2) % 3;
    pair.below.low = Vec3(dice.between(-5, 5), dice.between(-5, 5), dice.between(-5, 5));
    pair.below.high = pair.below.low + Vec3(dice.between(0.8, 2), dice.between(0.8, 2), dice.between(0.8, 2));
    pair.above.low = pair.below.low;
    pair.above.high = pair.below.high;
    pair.above.low[pair.axis] = pair.below.high[pair.axis];
    pair.above.high[pair.axis] = pair.below.high[pair.axis] + dice.between(0.8, 2);
    if (smaller) {
        pair.above.low[u] += 0.2;
        pair.above.high[v] -= 0.3;
    }
    pair.area = (pair.above.high - pair.above.low)[u] * (pair.above.high - pair.above.low)[v];
    for (Vec3* corner : {&pair.above.low, &pair.above.high}) {
        (*corner)[pair.axis] += off;
        (*corner)[u] += across;
    }
    pair.below.axis = dice.whole(0, 2);
    pair.above.axis = dice.whole(0, 2);
    pair.below.cuts = dice.whole(1, 4);
    pair.above.cuts = dice.whole(1, 4);
    return pair;
}

double tolerance_of(const Pair& pair)
{
    const Members members = pair.members();
    return std::max(members.volumes[0].model.tolerance, members.volumes[1].model.tolerance);
}

/// The number after "tolerance = " in a message.
/// The tolerance that a remedy names, in its digits.
double tolerance_in(const Message& message)
{
    REQUIRE(!message.needed().empty());
    return std::stod(with_digits(std::get<double>(message.needed().back()), 2));
}

Message message_of(const Members& members)
{
    try {
        sweep::sweep_assembly(members.list());
    } catch (const Error& error) {
        return error.message();
    }
    return {"test.no_error", "nothing is refused"};
}

void check_joined(const Members& members, double volume, double share)
{
    const SweptAssembly whole = sweep::sweep_assembly(members.list());
    test::check_assembly(whole, volume, share);
    CHECK(whole.near_misses.empty());
    CHECK(whole.shared.size() == 1);
    CHECK(test::inner_quads(whole) > 0);
}

} // namespace

TEST_CASE("faces a little further apart than the tolerance are named, with the tolerance that joins them")
{
    int joined = 0;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        CAPTURE(seed);
        test::Dice dice(seed);
        const bool smaller = dice.chance(0.5);
        const double times = std::pow(10.0, dice.between(0.1, 2.95));
        const unsigned other = seed;
        test::Dice again(other), first(other);
        const double gap = times * tolerance_of(pair_of(first, smaller, 0, 0));
        const Pair pair = pair_of(again, smaller, gap, 0);
        std::string log;
        RunContext context;
        context.log = [&](std::string_view line) { log += line; };
        const SweptAssembly whole = sweep::sweep_assembly(pair.members().list(), context);
        CHECK(whole.shared.empty());
        REQUIRE(whole.near_misses.size() == 1);
        const NearMiss& miss = whole.near_misses.front();
        CHECK(miss.width == doctest::Approx(gap).epsilon(1e-6));
        CHECK(miss.least == doctest::Approx(gap).epsilon(1e-6));
        CHECK(miss.area == doctest::Approx(pair.area).epsilon(1e-6));
        CHECK(!miss.reach_in);
        CHECK(log.find(miss.message.text()) != std::string::npos);
        CHECK(miss.message.text().find("part_1") != std::string::npos);
        CHECK(miss.message.text().find("part_2") != std::string::npos);
        CHECK(miss.message.entities().size() == 2);
        CHECK(tolerance_in(miss.message) == doctest::Approx(miss.tolerance));
        check_joined(pair.members(tolerance_in(miss.message)), pair.volume(), 5e-3);
        ++joined;
    }
    MESSAGE(joined << " gaps");
}

TEST_CASE("one face whose rims are a little further apart than the tolerance is refused, and joined with it")
{
    for (unsigned seed = 1; seed <= 40; ++seed) {
        CAPTURE(seed);
        test::Dice dice(seed);
        const double times = std::pow(10.0, dice.between(0.2, 2.9));
        test::Dice first(seed), again(seed);
        const Pair pair = pair_of(again, false, 0, times * tolerance_of(pair_of(first, false, 0, 0)));
        const Members members = pair.members();
        CHECK(test::refusal([&] { sweep::sweep_assembly(members.list()); }, {"part_1", "part_2"}) ==
              "assembly.rims_apart");
        check_joined(pair.members(tolerance_in(message_of(members))), pair.volume(), 5e-3);
    }
}

TEST_CASE("volumes that reach into each other by little are refused, and joined with the tolerance named")
{
    for (unsigned seed = 1; seed <= 40; ++seed) {
        CAPTURE(seed);
        test::Dice dice(seed);
        const double times = std::pow(10.0, dice.between(0.2, 2.9));
        const bool smaller = dice.chance(0.5);
        test::Dice first(seed), again(seed);
        const Pair pair = pair_of(again, smaller, -times * tolerance_of(pair_of(first, smaller, 0, 0)), 0);
        const Members members = pair.members();
        CHECK(test::refusal([&] { sweep::sweep_assembly(members.list()); },
                            {"part_1", "part_2", "reach into"}) == "assembly.overlap");
        check_joined(pair.members(tolerance_in(message_of(members))), pair.volume(), 5e-3);
    }
}

TEST_CASE("faces that part from a common edge by little are a crack, refused by name")
{
    for (const double times : {3.0, 30.0, 300.0}) {
        CAPTURE(times);
        const Brick below{.low = {0, 0, 0}, .high = {2, 1, 1}};
        Brick above{.low = {0, 0, 1}, .high = {2, 1, 2}};
        const double rise = times * brick(below).model.tolerance / 2;
        above.map = [rise](const Vec3& p) { return Vec3(p + Vec3(0, 0, rise * p.x())); };
        Members members;
        members.add(brick(below), 0.5);
        members.add(brick(above), 0.5);
        CHECK(test::refusal([&] { sweep::sweep_assembly(members.list()); }, {"part_1", "part_2", "crack"}) ==
              "assembly.crack");
        Members joined;
        for (Brick each : {below, above}) {
            each.tolerance = tolerance_in(message_of(members));
            joined.add(brick(each), 0.5);
        }
        check_joined(joined, 4, 5e-3);
    }
}

TEST_CASE("round faces that miss each other by more than their facets' sag are named")
{
    for (const double gap : {1.5e-3, 2.5e-3}) {
        CAPTURE(gap);
        test::PrismOptions core{.sides = 0, .radius = 1 - gap, .height = 2, .cuts = 10};
        test::PrismOptions ring{.sides = 0, .radius = 2, .height = 2, .cuts = 10};
        ring.hole_list = {{{0, 0}, 1}};
        Members members;
        members.add(test::closed(test::prism(core).open()), 0.5);
        members.add(test::closed(test::prism(ring).open()), 0.5);
        const SweptAssembly whole = sweep::sweep_assembly(members.list());
        REQUIRE(whole.near_misses.size() == 1);
        CHECK(whole.near_misses[0].width == doctest::Approx(gap).epsilon(0.2));
    }
}

TEST_CASE("edges of two volumes that miss each other are named, where no faces are over each other")
{
    for (const double times : {2.0, 20.0, 200.0}) {
        CAPTURE(times);
        const Brick below{.low = {0, 0, 0}, .high = {1, 2, 1}};
        const double gap = times * brick(below).model.tolerance;
        Members members;
        members.add(brick(below), 0.5);
        members.add(brick({.low = {1 + gap, 0, 1}, .high = {2, 2, 2}}), 0.5);
        const SweptAssembly whole = sweep::sweep_assembly(members.list());
        REQUIRE(!whole.near_misses.empty());
        for (const NearMiss& miss : whole.near_misses) {
            CHECK(miss.edge.has_value());
            CHECK(miss.width == doctest::Approx(gap).epsilon(1e-6));
            CHECK(miss.length == doctest::Approx(2).epsilon(0.05));
        }
    }
}

TEST_CASE("what is meant to be apart is no near miss: wide gaps, thin volumes between, faces that bend away")
{
    const Brick below{.low = {0, 0, 0}, .high = {2, 1, 1}};
    const double tolerance = brick(below).model.tolerance;
    for (const double times : {1100.0, 5000.0}) {
        CAPTURE(times);
        Members wide;
        wide.add(brick(below), 0.5);
        wide.add(brick({.low = {0, 0, 1 + times * tolerance}, .high = {2, 1, 2}}), 0.5);
        CHECK(sweep::sweep_assembly(wide.list()).near_misses.empty());
    }
    for (const double times : {100.0, 900.0}) {
        CAPTURE(times);
        const double gap = times * tolerance;
        Members gasket;
        gasket.add(brick(below), 0.5);
        gasket.add(brick({.low = {0, 0, 1}, .high = {2, 1, 1 + gap}}), 0.5, 1);
        gasket.add(brick({.low = {0, 0, 1 + gap}, .high = {2, 1, 2}}), 0.5);
        const SweptAssembly three = sweep::sweep_assembly(gasket.list());
        CHECK(three.near_misses.empty());
        CHECK(three.shared.size() == 2);
    }
    // A bowed end that comes nearest in its middle, and an edge over a face.
    for (const double gap : {1e-5, 1e-4, 1e-3}) {
        CAPTURE(gap);
        Members bowed;
        bowed.add(test::closed(
                      test::prism({.sides = 4, .cuts = 6, .target = test::End::bowed, .lift = 0.4}).open()),
                  0.5);
        bowed.add(brick({.low = {-1, -1, 2.4 + gap}, .high = {1, 1, 3.4}, .cuts = 2}), 0.5);
        CHECK(sweep::sweep_assembly(bowed.list()).near_misses.empty());
    }
}
