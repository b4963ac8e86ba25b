// SPDX-License-Identifier: MIT
#include "closure/sealing_checks.h"
#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/closure/readings.h>
#include <lacuna/closure/shared/steps.h>

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <utility>
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

const std::vector<Vec2> kTee{{-1, 0.2},  {-0.4, 0.2}, {-0.4, -1}, {0.4, -1},
                             {0.4, 0.2}, {1, 0.2},    {1, 0.9},   {-1, 0.9}};

double area_of(const std::vector<Vec2>& outline)
{
    double sum = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
        sum += (a.x() * b.y() - b.x() * a.y()) / 2;
    }
    return sum;
}

/// The integral of x over what of an outline lies beyond x = 0. @pre the outline is its own image in x = 0
double moment_beyond(const std::vector<Vec2>& outline)
{
    double sum = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        Vec2 a = outline[i], b = outline[(i + 1) % outline.size()];
        if (a.x() <= 0 && b.x() <= 0) continue;
        for (Vec2* low : {&a, &b})
            if (low->x() < 0) *low = {0, low->y()}; // such a side lies along x
        sum += (a.x() + b.x()) * (a.x() * b.y() - b.x() * a.y()) / 6;
    }
    return sum;
}

bool is_upper_wall(const test::Part& part, int side)
{
    return part.role == Role::wall && part.loop == 0 && part.row == 1 && part.side == side;
}

/// A bar of which the first side is the source and what else is left the walls.
OpenVolume open_on_floor(const test::Prism& bar)
{
    Roles roles;
    for (std::size_t f = 0; f < bar.part.size(); ++f) {
        const bool floor = bar.part[f].role == Role::wall && bar.part[f].side == 0;
        (floor ? roles.source : roles.walls).emplace_back(f);
    }
    return open_volume(bar.model, roles);
}

} // namespace

TEST_CASE("a hole without walls is asked about where an end is missing to which it may go through")
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
                    options.drop = test::holes_and_target;
                    Model model = test::prism(options).model;
                    CAPTURE(sides);
                    CAPTURE(hole_sides);
                    CAPTURE(bend);
                    CAPTURE(taper);
                    closure::Reading asked = closure::find_reading(model, all_faces(model));
                    CHECK(asked.holed.valid());
                    CHECK(test::refusal([&] { test::seal(asked.volume); }) == "closure.holes_open");
                    const auto taken = closure::find_reading(model, all_faces(model), 1);
                    CHECK(test::closed_volume(taken) == doctest::Approx(filled).epsilon(0.01));
                    // Faces of a counterbore look into it: what is round them is solid.
                    flip_faces(model, all_faces(model));
                    CHECK(!closure::find_reading(model, all_faces(model)).holed.valid());
                }
            }
        }
    }
}

TEST_CASE("named roles do not settle how a missing end bends: it is refused unless a guess is asked for")
{
    for (const int sides : {4, 5, 6}) {
        for (int missing = 0; missing < sides; ++missing) {
            const int next = (missing + 1) % sides;
            const auto stack = test::prism({.sides = sides, .rows = 2, .drop = [=](const test::Part& p) {
                                                return p.role == Role::target || is_upper_wall(p, missing) ||
                                                       is_upper_wall(p, next);
                                            }});
            CAPTURE(sides);
            CAPTURE(missing);
            OpenVolume named = stack.open();
            const std::size_t given = named.model.faces.size();
            CHECK(test::refusal([&] { test::seal(named); }, {"beside face "}) == "closure.shape_open");
            CHECK(named.model.faces.size() == given);
            const closure::CloseOptions guess{.roles_by = closure::RolesBy::finding},
                flat{.cap = closure::Cap::flat};
            for (const closure::CloseOptions& asked : {guess, flat}) {
                OpenVolume taken = stack.open();
                test::seal(taken, asked);
                test::check_sealed(taken);
            }
        }
    }
}

TEST_CASE("a bent end that named roles leave out is closed where its rim tells it, and refused where not")
{
    const std::vector<Vec2> ell{{-0.8, -0.8}, {0.8, -0.8}, {0.8, -0.1},
                                {-0.1, -0.1}, {-0.1, 0.8}, {-0.8, 0.8}};
    for (const std::vector<Vec2>& outline : {polygon(5), polygon(6), polygon(8), ell, kTee}) {
        for (const double lift : {0.2, 0.35, 0.5}) {
            for (const bool both_ends : {false, true}) {
                for (const test::End end : {test::End::saddle, test::End::bowed}) {
                    const auto stack = test::prism({.height = 1.2,
                                                    .outline = outline,
                                                    .cuts = 6,
                                                    .target = end,
                                                    .lift = lift,
                                                    .drop = test::without(both_ends, true, false)});
                    CAPTURE(outline.size());
                    CAPTURE(lift);
                    CAPTURE(both_ends);
                    CAPTURE(int(end));
                    OpenVolume volume = stack.open();
                    const std::string refusal = test::refusal([&] { test::seal(volume); });
                    OpenVolume taken = stack.open();
                    test::seal(taken, {.roles_by = closure::RolesBy::finding});
                    const double off = closure::enclosed_volume(taken) / stack.facet_volume - 1;
                    CHECK(refusal == (std::abs(off) < 0.02 ? "done" : "closure.shape_open"));
                }
            }
        }
    }
}

TEST_CASE("no lid is sealed over a slot in an end that named roles leave out")
{
    for (const double half : {0.2, 0.35, 0.6}) { // of the slot's width
        for (const double floor : {0.4, 0.8}) {
            for (const double depth : {1.0, 3.0}) {
                for (const double lean : {0.0, 0.15}) { // of its sides
                    const std::vector<Vec2> outline{{0, 0},
                                                    {2, 0},
                                                    {2, 1},
                                                    {1 + half, 1},
                                                    {1 + half - lean, floor},
                                                    {1 - half + lean, floor},
                                                    {1 - half, 1},
                                                    {0, 1}};
                    const auto part = test::prism(
                        {.height = depth, .outline = outline, .drop = [](const test::Part& p) {
                             return p.role == Role::wall && p.side > 1 && p.side < 7;
                         }});
                    CAPTURE(half);
                    CAPTURE(floor);
                    CAPTURE(depth);
                    CAPTURE(lean);
                    OpenVolume volume = open_on_floor(part);
                    const bool refused = !test::refusal([&] { test::seal(volume); }).starts_with("done");
                    if (lean == 0) CHECK(refused);
                    if (refused) continue;
                    CHECK(closure::enclosed_volume(volume) ==
                          doctest::Approx(part.facet_volume).epsilon(0.02));
                }
            }
        }
    }
}

TEST_CASE("an end in two planes that named roles leave out is right or refused, however flat the ridge is")
{
    constexpr double kHeight = 1.2;
    int refused = 0;
    for (const std::vector<Vec2>& outline : {polygon(6), kTee}) {
        for (const double slope : {0.15, 0.3, 0.5, 0.7}) {
            for (const double other : {0.0, slope}) { // a ramp from a flat half, and a roof
                auto stack = test::prism(
                    {.height = kHeight, .outline = outline, .drop = test::without(false, true, false)});
                stack.model = test::moved(stack.model, [&](const Vec3& p) {
                    const double low = p.x() > 0 ? slope * p.x() : -other * p.x();
                    return Vec3(p.x(), p.y(), p.z() * (1 - low / kHeight));
                });
                const double volume = kHeight * area_of(outline) - (slope + other) * moment_beyond(outline);
                CAPTURE(outline.size());
                CAPTURE(slope);
                CAPTURE(other);
                OpenVolume named = stack.open();
                const std::string refusal = test::refusal([&] { test::seal(named); });
                if (refusal == "done")
                    CHECK(closure::enclosed_volume(named) == doctest::Approx(volume).epsilon(0.03));
                else
                    CHECK(refusal == "closure.shape_open");
                refused += refusal == "done" ? 0 : 1;
            }
        }
    }
    MESSAGE(refused << " refused");
}

TEST_CASE("an end that named roles leave out with walls beside it is closed by flat faces")
{
    struct Shape {
        double taper = 1;
        test::End target = test::End::planar;
        int holes = 0;
    };
    for (const int sides : {3, 4, 5, 7}) {
        for (const Shape& shape : {Shape{}, Shape{.taper = 0.7}, Shape{.target = test::End::tilted},
                                   Shape{.holes = 1}, Shape{.taper = 1.2, .holes = 1}}) {
            for (int missing = 0; missing < sides; ++missing) {
                for (const int apart : {0, 2}) { // one wall, or two that have no edge in common
                    if (apart > sides - 2) continue;
                    const int other = (missing + apart) % sides;
                    const auto stack = test::prism({.sides = sides,
                                                    .holes = shape.holes,
                                                    .rows = 2,
                                                    .taper = shape.taper,
                                                    .target = shape.target,
                                                    .drop = [=](const test::Part& p) {
                                                        return p.role == Role::target ||
                                                               is_upper_wall(p, missing) ||
                                                               is_upper_wall(p, other);
                                                    }});
                    CAPTURE(sides);
                    CAPTURE(shape.taper);
                    CAPTURE(int(shape.target));
                    CAPTURE(shape.holes);
                    CAPTURE(missing);
                    CAPTURE(apart);
                    OpenVolume volume = stack.open();
                    test::seal(volume);
                    test::check_sealed(volume);
                    CHECK(closure::enclosed_volume(volume) ==
                          doctest::Approx(stack.facet_volume).epsilon(1e-9));
                    CHECK(volume.faces(Role::target).size() == 1);
                }
            }
        }
    }
}

TEST_CASE(
    "a missing end with steps, valleys and ridges is a flat face in each plane, and can be cut into pieces")
{
    // Heights over x of the end that is missing, above a floor from 0 to 2.
    using Profile = std::vector<Vec2>;
    const std::vector<std::pair<Profile, std::size_t>> ends{
        {{{2, 1}, {1, 1}, {1, 1.5}, {0, 1.5}}, 2}, // a step, and its heights
        {{{2, 1}, {1.1, 1}, {0.9, 2}, {0, 2}}, 2}, // a steep slope between them
        {{{2, 1}, {1.3, 1}, {0.7, 2}, {0, 2}}, 1}, // a slope
        {{{2, 1.6}, {1, 1}, {0, 1.6}}, 1},         // a valley
        {{{2, 2.7}, {1, 1}, {0, 2.7}}, 1},         {{{2, 1}, {1, 2}, {0, 1}}, 1}}; // a ridge
    for (const auto& [profile, heights] : ends) {
        for (const double depth : {1.0, 3.0}) {
            std::vector<Vec2> outline{{0, 0}, {2, 0}};
            outline.insert(outline.end(), profile.begin(), profile.end());
            const int last = static_cast<int>(outline.size()) - 1; // the wall down from the end
            const auto part = test::prism(
                {.height = depth, .outline = outline, .drop = [=](const test::Part& p) {
                     return p.role == Role::wall && p.side > 1 && p.side < last;
                 }});
            CAPTURE(profile.size());
            CAPTURE(profile[1].y());
            CAPTURE(depth);
            OpenVolume volume = open_on_floor(part);
            test::seal(volume);
            test::check_sealed(volume);
            CHECK(closure::enclosed_volume(volume) == doctest::Approx(part.facet_volume).epsilon(1e-9));
            CHECK(connected_parts(volume.model, volume.faces(Role::target)).size() == heights);
            CHECK(closure::cut_steps(volume).size() == heights);
        }
    }
}

TEST_CASE("the sector of a ring without its ends and a round wall is not closed along a chord")
{
    constexpr int kSteps = 10;
    for (const double inner : {1.5, 2.0}) {
        for (const double turn : {0.8, 1.6, 2.6}) {
            for (const bool outside : {false, true}) { // the round wall that is missing
                std::vector<Vec2> outline;
                for (const double radius : {inner, 3.0})
                    for (int k = 0; k <= kSteps; ++k) {
                        const double angle = turn * (radius == inner ? kSteps - k : k) / kSteps;
                        outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
                    }
                const auto is_missing = [=](const test::Part& p) {
                    const bool round = outside ? p.side > kSteps && p.side <= 2 * kSteps : p.side < kSteps;
                    return p.role != Role::wall || round;
                };
                const auto sector = test::prism({.height = 2, .outline = outline, .drop = is_missing});
                CAPTURE(inner);
                CAPTURE(turn);
                CAPTURE(outside);
                test::check_found(sector, 0.025);
            }
        }
    }
}

TEST_CASE("a bar with a round top that lacks its ends and the bottom between parallel sides has a flat one")
{
    constexpr int kSteps = 8;
    for (const double bulge : {-0.6, 0.6}) {
        for (const double height : {1.5, 3.0}) {
            for (const int missing : {0, 1}) { // the bottom, or a side beside the round top
                std::vector<Vec2> outline{{-1, 0}, {1, 0}};
                for (int k = 0; k <= kSteps; ++k) {
                    const double x = 1 - 2.0 * k / kSteps;
                    outline.emplace_back(x, height + bulge * (1 - x * x));
                }
                const auto bar = test::prism(
                    {.height = 4, .outline = outline, .drop = test::without(true, true, false, {missing})});
                CAPTURE(bulge);
                CAPTURE(height);
                CAPTURE(missing);
                test::check_found(bar, 1e-9);
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
                test::check_found(bar, 0.02);
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
                test::check_found(frustum, 1e-9);
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
                    test::check_found(block, 1e-9);
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
                            test::check_found(bar, 0.025);
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
