// SPDX-License-Identifier: MIT
#include "closure/sealing_checks.h"
#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/closure/readings.h>

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <vector>

using namespace lacuna;
using namespace lacuna::topology;

namespace {

std::vector<Vec2> polygon(int sides)
{
    std::vector<Vec2> corners;
    for (int k = 0; k < sides; ++k)
        corners.emplace_back(std::cos(6.28318531 * k / sides), std::sin(6.28318531 * k / sides));
    return corners;
}

/// The target and the walls of holes left out.
bool holes_and_target(const test::Part& part)
{
    return part.role == Role::target || (part.role == Role::wall && part.loop > 0);
}

std::string refusal_of(const Model& model)
{
    return test::refusal([&] { (void)closure::find_reading(model, all_faces(model)); });
}

} // namespace

TEST_CASE("a hole without walls is refused where an end is missing to which it may go through")
{
    for (const int sides : {0, 4, 6}) {
        for (const int hole_sides : {0, 5}) {
            for (const double bend : {0.0, 60.0}) {
                for (const double taper : {1.0, 0.8}) {
                    test::PrismOptions options{.sides = sides,
                                               .height = 3,
                                               .hole_sides = hole_sides,
                                               .levels = 12,
                                               .taper = taper,
                                               .bend = bend};
                    const double filled = test::prism(options).facet_volume;
                    options.holes = 1;
                    options.drop = holes_and_target;
                    Model model = test::prism(options).model;
                    CAPTURE(sides);
                    CAPTURE(hole_sides);
                    CAPTURE(bend);
                    CAPTURE(taper);
                    CHECK(refusal_of(model) == "topology.shape_open");
                    const auto taken = closure::find_reading(model, all_faces(model), 1);
                    CHECK(test::closed_volume(taken) == doctest::Approx(filled).epsilon(0.01));
                    // Faces of a counterbore look into it: what is round them is solid.
                    flip_faces(model, all_faces(model));
                    CHECK(refusal_of(model) == "done");
                }
            }
        }
    }
}

TEST_CASE("a channel without its ends and a wall has flat ends that are alike")
{
    for (const int sides : {5, 6, 8}) {
        for (const double bend : {0.0, 40.0, 70.0}) {
            for (int missing = 0; missing < sides; ++missing) {
                const auto bar = test::prism({.height = 4,
                                              .outline = polygon(sides),
                                              .levels = bend > 0 ? 24 : 1,
                                              .bend = bend,
                                              .drop = test::without(true, true, false, {missing})});
                CAPTURE(sides);
                CAPTURE(bend);
                CAPTURE(missing);
                const auto reading = closure::find_reading(bar.model, all_faces(bar.model));
                CHECK(test::closed_volume(reading) == doctest::Approx(bar.facet_volume).epsilon(0.02));
            }
        }
    }
}

TEST_CASE("two walls of a frustum that are missing side by side are flat, whichever roles are found")
{
    for (const int sides : {5, 6, 7}) {
        for (const double taper : {0.5, 0.8}) {
            for (int missing = 0; missing < sides; ++missing) {
                const auto frustum = test::prism(
                    {.height = 3,
                     .outline = polygon(sides),
                     .taper = taper,
                     .drop = test::without(false, false, false, {missing, (missing + 1) % sides})});
                CAPTURE(sides);
                CAPTURE(taper);
                CAPTURE(missing);
                const auto reading = closure::find_reading(frustum.model, all_faces(frustum.model));
                CHECK(test::closed_volume(reading) == doctest::Approx(frustum.facet_volume).epsilon(1e-9));
            }
        }
    }
}

TEST_CASE("a chamfer and the wall beside it that are missing are two flat faces, and no membrane rivals them")
{
    for (const double width : {6.0, 8.0}) {
        for (const double depth : {3.0, 5.0}) {
            for (const double chamfer : {1.0, 2.0}) {
                for (const int missing : {1, 2}) {
                    const std::vector<Vec2> outline{
                        {0, 0}, {width, 0}, {width, depth - chamfer}, {width - chamfer, depth}, {0, depth}};
                    const auto block = test::prism(
                        {.height = 4,
                         .outline = outline,
                         .drop = test::without(false, false, false, {missing, missing + 1})});
                    CAPTURE(width);
                    CAPTURE(depth);
                    CAPTURE(chamfer);
                    CAPTURE(missing);
                    const auto reading = closure::find_reading(block.model, all_faces(block.model));
                    CHECK(test::closed_volume(reading) == doctest::Approx(block.facet_volume).epsilon(1e-9));
                }
            }
        }
    }
}

TEST_CASE("what two missing faces make of a bent bar is right or refused")
{
    int right = 0, refused = 0;
    for (const int sides : {4, 5, 6}) {
        for (const double bend : {30.0, 80.0}) {
            for (int wall = 0; wall < sides; ++wall) {
                for (const bool end : {false, true}) {
                    for (int next = wall + 1; next < sides + (end ? 1 : 0); ++next) {
                        std::vector<int> missing{wall};
                        if (next < sides) missing.push_back(next);
                        const auto bar = test::prism({.height = 3,
                                                      .outline = polygon(sides),
                                                      .levels = 24,
                                                      .bend = bend,
                                                      .drop = test::without(false, end, false, missing)});
                        CAPTURE(sides);
                        CAPTURE(bend);
                        CAPTURE(wall);
                        CAPTURE(end);
                        CAPTURE(next);
                        try {
                            const auto reading = closure::find_reading(bar.model, all_faces(bar.model));
                            CHECK(test::closed_volume(reading) ==
                                  doctest::Approx(bar.facet_volume).epsilon(0.025));
                            ++right;
                        } catch (const InvalidInput&) {
                            ++refused;
                        }
                    }
                }
            }
        }
    }
    MESSAGE(right << " right, " << refused << " refused");
    CHECK(right > 4 * refused);
}
