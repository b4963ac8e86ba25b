// SPDX-License-Identifier: MIT
#include "closure/sealing_checks.h"
#include "support/refusal.h"
#include "support/volumes.h"
#include "support/whole_families.h"

#include <lacuna/closure/readings.h>

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <vector>

using namespace lacuna;
using namespace lacuna::topology;

namespace {

/// Outlines by name: with corners that point outward and inward, and with a round side.
std::vector<std::vector<Vec2>> outlines()
{
    std::vector<Vec2> pentagon, keyway{{1, 1}, {-1, 1}};
    for (int k = 0; k < 5; ++k) pentagon.emplace_back(std::cos(1.2566 * k), std::sin(1.2566 * k));
    for (int k = 0; k <= 12; ++k)
        keyway.emplace_back(std::cos(3.14159265 * (1 + k / 12.0)), std::sin(3.14159265 * (1 + k / 12.0)));
    return {pentagon,
            keyway,
            {{-1, -1}, {1, -1}, {1, -0.4}, {-0.4, -0.4}, {-0.4, 1}, {-1, 1}},
            {{-0.3, -1}, {0.3, -1}, {0.3, 0.4}, {1, 0.4}, {1, 1}, {-1, 1}, {-1, 0.4}, {-0.3, 0.4}},
            {{-1, -1}, {1, -1}, {1, 1}, {0.5, 1}, {0.5, -0.4}, {-0.5, -0.4}, {-0.5, 1}, {-1, 1}}};
}

/// Parts left out: the target, and walls of the outer loop by their side, or all walls of the holes.
std::function<bool(const test::Part&)> without_end(std::set<int> sides, bool holes)
{
    return [sides = std::move(sides), holes](const test::Part& part) {
        if (part.role != Role::wall) return part.role == Role::target;
        return part.loop == 0 ? sides.contains(part.side) : holes;
    };
}

} // namespace

TEST_CASE("where an end and walls beside it are missing the other end tells their shape")
{
    test::MembersToRun run(5);
    for (const std::vector<Vec2>& outline : outlines()) {
        const int sides = static_cast<int>(outline.size());
        for (const double bend : {0.0, 70.0}) {
            for (const double taper : {1.0, 0.7}) {
                for (int first = 0; first < sides; ++first) {
                    for (int count = 1; count <= 3 && count < sides - 1; ++count) {
                        if (!run.next()) continue;
                        std::set<int> missing;
                        for (int k = 0; k < count; ++k) missing.insert((first + k) % sides);
                        const auto prism = test::prism({.height = 4,
                                                        .outline = outline,
                                                        .levels = bend > 0 ? 24 : 1,
                                                        .taper = taper,
                                                        .bend = bend,
                                                        .drop = without_end(missing, false)});
                        CAPTURE(sides);
                        CAPTURE(bend);
                        CAPTURE(taper);
                        CAPTURE(first);
                        CAPTURE(count);
                        const auto reading = closure::find_reading(prism.model, all_faces(prism.model));
                        CHECK(reading.enclosed == doctest::Approx(prism.facet_volume).epsilon(0.01));
                        CHECK(test::closed_volume(reading) ==
                              doctest::Approx(prism.facet_volume).epsilon(0.01));
                    }
                }
            }
        }
    }
}

TEST_CASE("a named source tells a missing target's shape where walls are missing too")
{
    test::MembersToRun run(5);
    for (const std::vector<Vec2>& outline : outlines()) {
        const int sides = static_cast<int>(outline.size());
        for (const double bend : {0.0, 70.0}) {
            for (const double taper : {1.0, 0.7}) {
                for (int first = 0; first < sides; ++first) {
                    for (int count = 1; count <= 2; ++count) {
                        if (!run.next()) continue;
                        std::set<int> missing;
                        for (int k = 0; k < count; ++k) missing.insert((first + k) % sides);
                        const auto prism = test::prism({.height = 4,
                                                        .outline = outline,
                                                        .levels = bend > 0 ? 24 : 1,
                                                        .taper = taper,
                                                        .bend = bend,
                                                        .drop = without_end(missing, false)});
                        CAPTURE(sides);
                        CAPTURE(bend);
                        CAPTURE(taper);
                        CAPTURE(first);
                        CAPTURE(count);
                        OpenVolume volume = prism.open();
                        CHECK(test::seal(volume).value == VolumeClass::IV);
                        CHECK(closure::enclosed_volume(volume) ==
                              doctest::Approx(prism.facet_volume).epsilon(0.01));
                        test::check_sealed(volume);
                    }
                }
            }
        }
    }
}

TEST_CASE("a missing slanted end lies in the plane of the tops of all walls but one")
{
    for (const std::vector<Vec2>& outline : outlines()) {
        const int sides = static_cast<int>(outline.size());
        for (int gone = 0; gone < sides; ++gone) {
            auto prism = test::prism({.height = 4, .outline = outline, .drop = without_end({gone}, false)});
            const auto slanted = [](const Vec3& p) {
                return Vec3(p.x(), p.y(), p.z() * (1 + 0.2 * p.x() - 0.1 * p.y()));
            };
            auto whole = test::prism({.height = 4, .outline = outline});
            whole.model = test::moved(std::move(whole.model), slanted);
            prism.model = test::moved(std::move(prism.model), slanted);
            CAPTURE(sides);
            CAPTURE(gone);
            OpenVolume volume = prism.open();
            test::seal(volume);
            CHECK(closure::enclosed_volume(volume) ==
                  doctest::Approx(closure::enclosed_volume(whole.open())).epsilon(0.01));
        }
    }
}

TEST_CASE("where tops of walls lie in no plane a named source tells nothing of a missing bent target")
{
    for (int gone = 0; gone < 4; ++gone) {
        auto saddle = test::prism({.target = test::End::saddle, .drop = without_end({gone}, false)}).open();
        CHECK(test::refusal([&] { test::seal(saddle); }, {"edge ", "tops of the given walls"}) ==
              "closure.wall_missing");
    }
}

TEST_CASE(
    "a bore without its wall is blind or goes through, for the person to say, where an end is missing too")
{
    test::MembersToRun run(5);
    for (const int sides : {4, 6}) {
        for (const int hole_sides : {0, 4}) {
            for (const double taper : {1.0, 0.8}) {
                for (int wall = 0; wall < sides; ++wall) {
                    if (!run.next()) continue;
                    const auto prism = test::prism({.sides = sides,
                                                    .holes = 1,
                                                    .hole_sides = hole_sides,
                                                    .taper = taper,
                                                    .drop = without_end({wall}, true)});
                    CAPTURE(sides);
                    CAPTURE(hole_sides);
                    CAPTURE(taper);
                    CAPTURE(wall);
                    const std::vector<FaceId> faces = all_faces(prism.model);
                    int through = 0;
                    for (const closure::Reading& reading : closure::find_readings(prism.model, faces)) {
                        const double off = test::closed_volume(reading) / prism.facet_volume - 1;
                        through += std::abs(off) < 0.01 ? 1 : 0;
                    }
                    CHECK(through == 1);
                    closure::Reading asked = closure::find_reading(prism.model, faces);
                    CHECK(asked.holed.valid());
                    CHECK(test::refusal([&] { test::seal(asked.volume); }) == "closure.holes_open");
                    test::seal(asked.volume, {.holes = closure::Holes::through});
                    CHECK(closure::enclosed_volume(asked.volume) ==
                          doctest::Approx(prism.facet_volume).epsilon(0.01));
                }
            }
        }
    }
}

TEST_CASE("a taper of a bore says nothing of the walls that are missing round it")
{
    for (const int sides : {4, 6}) {
        for (const int hole_sides : {0, 4}) {
            for (const double taper : {0.6, 0.8}) {
                std::set<int> outer;
                for (int side = 0; side < sides; ++side) outer.insert(side);
                const auto prism = test::prism({.sides = sides,
                                                .holes = 1,
                                                .hole_sides = hole_sides,
                                                .taper = taper,
                                                .drop = without_end(outer, false)});
                CAPTURE(sides);
                CAPTURE(hole_sides);
                CAPTURE(taper);
                const std::vector<FaceId> faces = all_faces(prism.model);
                CHECK_THROWS_AS((void)closure::find_reading(prism.model, faces), InvalidInput);
            }
        }
    }
}

TEST_CASE("walls of a bent channel that are missing side by side bend as both its ends say")
{
    test::MembersToRun run(5);
    for (const std::vector<Vec2>& outline : outlines()) {
        const int sides = static_cast<int>(outline.size());
        if (sides > 8) continue;
        for (const double bend : {40.0, 60.0}) {
            for (int first = 0; first < sides; ++first) {
                if (!run.next()) continue;
                std::set<int> missing{first, (first + 1) % sides};
                const auto bar = test::prism(
                    {.height = 5,
                     .outline = outline,
                     .levels = 24,
                     .bend = bend,
                     .drop = test::without(false, false, false, {missing.begin(), missing.end()})});
                CAPTURE(sides);
                CAPTURE(bend);
                CAPTURE(first);
                test::check_found(bar, 0.01);
            }
        }
    }
}

TEST_CASE("what a rim leaves open is refused, and taken where it is asked for by its number")
{
    for (const int sides : {3, 4, 5, 6, 0}) {
        const auto prism = test::prism(
            {.sides = sides, .target = test::End::saddle, .drop = test::without(false, true, false)});
        CAPTURE(sides);
        const std::vector<FaceId> faces = all_faces(prism.model);
        const auto readings = closure::find_readings(prism.model, faces);
        REQUIRE(readings.size() == 1);
        const std::string code = test::refusal([&] { closure::find_reading(prism.model, faces); });
        CHECK((code == "topology.shape_open") == readings.front().guess.has_value());
        CHECK(test::closed_volume(closure::find_reading(prism.model, faces, 1)) ==
              doctest::Approx(prism.facet_volume).epsilon(0.2));
    }
}

TEST_CASE("a missing top whose rim lies on a ball or a cylinder is closed, for the rim tells how it bends")
{
    constexpr double kRadius = 2.2, kHeight = 3;
    for (const std::vector<Vec2>& outline : outlines()) {
        for (const bool ball : {true, false}) {
            const auto bent = [&](const Vec3& p) {
                const double aside = ball ? p.head<2>().squaredNorm() : p.x() * p.x();
                const double top = kHeight - kRadius + std::sqrt(kRadius * kRadius - aside);
                return Vec3(p.x(), p.y(), p.z() / kHeight * top);
            };
            const auto made = [&](std::function<bool(const test::Part&)> drop) {
                return test::moved(
                    test::prism({.height = kHeight, .outline = outline, .cuts = 12, .drop = std::move(drop)})
                        .model,
                    bent);
            };
            const Model whole = made(nullptr), open = made(without_end({}, false));
            CAPTURE(outline.size());
            CAPTURE(ball);
            const double volume = closure::enclosed_volume(topology::open_volume(
                whole, test::prism({.height = kHeight, .outline = outline, .cuts = 12}).roles));
            const auto reading = closure::find_reading(open, all_faces(open));
            CHECK(test::closed_volume(reading) == doctest::Approx(volume).epsilon(0.03));
        }
    }
}

namespace {

template <class Options>
concept SaysWhetherToHint = requires(Options options)
{
    options.hints;
};

} // namespace

TEST_CASE("what closing gives does not depend on who asks: a host, a recipe, or whoever looks for roles")
{
    // There was an option for messages that also chose how an end without walls is closed.
    static_assert(!SaysWhetherToHint<closure::CloseOptions>);
    int compared = 0;
    for (const std::vector<Vec2>& outline : outlines()) {
        for (const double taper : {1.0, 0.7}) {
            for (int missing = 0; missing < static_cast<int>(outline.size()); ++missing) {
                CAPTURE(missing);
                CAPTURE(taper);
                const auto prism = test::prism(
                    {.height = 4, .outline = outline, .taper = taper, .drop = without_end({missing}, false)});
                std::optional<closure::Reading> found;
                try {
                    found = closure::find_reading(prism.model, all_faces(prism.model), 1);
                } catch (const InvalidInput&) {
                    continue;
                }
                const auto [named, closure] = closure::close(prism.open(), {},
                                                             {.roles_by = closure::RolesBy::finding});
                CHECK(closure.value == VolumeClass::IV);
                // Of the taper nothing tells where a moved end is not known to shrink.
                if (found->classification.value != VolumeClass::IV) continue;
                ++compared;
                CHECK(closure::enclosed_volume(named) == doctest::Approx(found->enclosed).epsilon(1e-9));
                if (!found->sealed) continue;
                const OpenVolume again = closure::close(found->volume, found->sealed->match,
                                                        {.roles_by = closure::RolesBy::finding})
                                             .volume;
                CHECK(closure::enclosed_volume(again) ==
                      doctest::Approx(closure::enclosed_volume(found->sealed->volume)).epsilon(1e-12));
            }
        }
    }
    CHECK(compared > 20);
}
