// SPDX-License-Identifier: MIT
#include "closure/sealing_checks.h"
#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/closure/close.h>
#include <lacuna/closure/readings.h>
#include <lacuna/core/error.h>

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

using namespace lacuna;
using namespace lacuna::topology;
using closure::CloseOptions;
using closure::Holes;

namespace {

bool walls_of_holes(const test::Part& part) { return part.role == Role::wall && part.loop > 0; }

/// Prisms of which holes of the source lack their walls.
struct Holed {
    test::PrismOptions options;
    double covered = 0, through = 0; ///< what they enclose [model length³]
};

std::vector<Holed> family(const std::function<bool(const test::Part&)>& drop)
{
    std::vector<Holed> members;
    for (const int sides : {0, 6}) {
        for (const int holes : {1, 2}) {
            for (const int hole_sides : {0, 5}) {
                for (const double bend : {0.0, 50.0}) {
                    for (const double taper : {1.0, 0.8}) {
                        test::PrismOptions options{.sides = sides,
                                                   .height = 3,
                                                   .hole_sides = hole_sides,
                                                   .levels = 12,
                                                   .taper = taper,
                                                   .bend = bend};
                        Holed member;
                        member.covered = test::prism(options).facet_volume;
                        options.holes = holes;
                        member.through = test::prism(options).facet_volume;
                        options.drop = drop;
                        member.options = options;
                        members.push_back(member);
                    }
                }
            }
        }
    }
    return members;
}

void capture_and_check(const Holed& member, const OpenVolume& open)
{
    for (const Holes holes : {Holes::cover, Holes::through}) {
        OpenVolume sealed = open;
        const closure::Closure made = test::seal(sealed, {.holes = holes});
        CHECK(made.assumptions.empty()); // it was asked for
        test::check_sealed(sealed);
        CHECK(closure::enclosed_volume(sealed) ==
              doctest::Approx(holes == Holes::cover ? member.covered : member.through).epsilon(0.01));
    }
}

/// The numbers behind a word of a text.
std::vector<double> numbers_behind(const std::string& text, const std::string& word)
{
    std::vector<double> found;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        found.push_back(std::strtod(text.c_str() + at + word.size(), nullptr));
    return found;
}

} // namespace

TEST_CASE("holes of a given end without walls are refused with both volumes, and closed as is asked for")
{
    for (const Holed& member : family(test::holes_and_target)) {
        const auto prism = test::prism(member.options);
        CAPTURE(member.options.sides);
        CAPTURE(member.options.holes);
        CAPTURE(member.options.hole_sides);
        CAPTURE(member.options.bend);
        CAPTURE(member.options.taper);
        OpenVolume open = prism.open();
        std::string told;
        try {
            test::seal(open);
        } catch (const NotClosed& error) {
            CHECK(error.code() == "closure.holes_open");
            told = error.what();
        }
        const std::vector<double> volumes = numbers_behind(told, "encloses ");
        REQUIRE(volumes.size() == 2);
        CHECK(volumes[0] == doctest::Approx(member.covered).epsilon(0.01));
        CHECK(volumes[1] == doctest::Approx(member.through).epsilon(0.01));
        capture_and_check(member, prism.open());
    }
}

TEST_CASE("where roles are found holes without walls wait for what becomes of them")
{
    for (const Holed& member : family(test::holes_and_target)) {
        const auto prism = test::prism(member.options);
        CAPTURE(member.options.sides);
        CAPTURE(member.options.holes);
        CAPTURE(member.options.hole_sides);
        CAPTURE(member.options.bend);
        CAPTURE(member.options.taper);
        closure::Reading reading = closure::find_reading(prism.model, all_faces(prism.model));
        CHECK(reading.holed.valid());
        REQUIRE(!reading.closure);
        CHECK(test::refusal([&] { test::seal(reading.volume); }) == "closure.holes_open");
        capture_and_check(member, reading.volume);
    }
}

TEST_CASE("a guess takes holes of a given end through, which is told where it matters")
{
    for (const double radius : {0.05, 0.1, 0.3, 0.5}) {
        const auto prism = test::prism({.sides = 0,
                                        .hole_sides = 0,
                                        .hole_list = {{{0.1, 0}, radius}},
                                        .cuts = 4,
                                        .drop = test::holes_and_target});
        CAPTURE(radius);
        OpenVolume volume = prism.open();
        const closure::Closure made = test::seal(volume, {.roles_by = closure::RolesBy::finding});
        CHECK(closure::enclosed_volume(volume) == doctest::Approx(prism.facet_volume).epsilon(1e-6));
        CHECK(made.assumptions.size() == (radius * radius > 0.02 ? 1 : 0));
    }
}

TEST_CASE("between given ends holes without walls go through unless they are to be covered")
{
    for (const Holed& member : family(walls_of_holes)) {
        if (member.options.bend > 0) continue; // a bore that follows the walls is tested beside them
        const auto prism = test::prism(member.options);
        CAPTURE(member.options.sides);
        CAPTURE(member.options.holes);
        CAPTURE(member.options.hole_sides);
        CAPTURE(member.options.taper);
        OpenVolume open = prism.open();
        test::seal(open);
        CHECK(closure::enclosed_volume(open) == doctest::Approx(member.through).epsilon(0.01));
        capture_and_check(member, prism.open());
    }
}

TEST_CASE("what becomes of holes is refused where no given end has one without walls")
{
    const std::vector<std::function<bool(const test::Part&)>> drops{
        nullptr,
        test::without(false, true, false),
        test::without(true, true, false),
        test::without(false, true, false, {1}),
        test::without(false, false, false, {0, 1}),
    };
    for (const int holes : {0, 1}) {
        for (const auto& drop : drops) {
            for (const Holes asked : {Holes::cover, Holes::through}) {
                OpenVolume volume = test::prism({.holes = holes, .drop = drop}).open();
                CAPTURE(holes);
                CHECK(test::refusal([&] { test::seal(volume, {.holes = asked}); }) == "closure.holes_unused");
            }
        }
    }
}
