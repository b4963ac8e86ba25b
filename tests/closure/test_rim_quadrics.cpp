// SPDX-License-Identifier: MIT
#include "closure/sealing_checks.h"
#include "support/refusal.h"
#include "support/volumes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

using namespace lacuna;
using namespace lacuna::topology;

namespace {

using Height = std::function<double(double, double)>;

std::vector<Vec2> circle(int facets)
{
    std::vector<Vec2> corners;
    for (int k = 0; k < facets; ++k) {
        const double angle = 2 * std::numbers::pi * k / facets;
        corners.emplace_back(std::cos(angle), std::sin(angle));
    }
    return corners;
}

const std::vector<Vec2> kBox{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

std::vector<Vec2> half_circle(int facets)
{
    std::vector<Vec2> corners;
    for (int k = 0; k <= facets; ++k)
        corners.emplace_back(std::cos(std::numbers::pi * k / facets),
                             std::sin(std::numbers::pi * k / facets));
    return corners;
}

/// A block over an outline round the origin, under a height that is missing.
struct Block {
    test::Prism prism;
    double volume = 0; ///< between the floor and the height, all over the outline
};

Block block_under(const std::vector<Vec2>& outline, int cuts, const Height& height)
{
    constexpr int kParts = 60; // of each side of the triangles that are summed
    Block block{test::prism(
        {.height = 1, .outline = outline, .cuts = cuts, .drop = test::without(false, true, false)})};
    block.prism.model = test::moved(
        block.prism.model, [&](const Vec3& p) { return Vec3(p.x(), p.y(), p.z() * height(p.x(), p.y())); });
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
        const double part = (a.x() * b.y() - b.x() * a.y()) / 2 / (kParts * kParts);
        for (int k = 0; k < kParts; ++k) {
            for (int j = 0; j < 2 * k + 1; ++j) { // upright and turned triangles of a row by turns
                const double up = j % 2 == 0 ? 2.0 / 3 : 1.0 / 3, row = k + up;
                const double along = (j / 2 + (j % 2 == 0 ? 1.0 / 3 : 2.0 / 3)) / row;
                const Vec2 at = row / kParts * ((1 - along) * a + along * b);
                block.volume += part * height(at.x(), at.y());
            }
        }
    }
    return block;
}

void check_closed(const Block& block, double epsilon)
{
    OpenVolume volume = block.prism.open();
    test::seal(volume);
    test::check_sealed(volume);
    CHECK(closure::enclosed_volume(volume) == doctest::Approx(block.volume).epsilon(epsilon));
}

std::string refusal_of(const Block& block)
{
    OpenVolume volume = block.prism.open();
    return test::refusal([&] { test::seal(volume); });
}

} // namespace

TEST_CASE("a round stub that ends on a bore or a shaft is closed by its cylinder")
{
    for (const double radius : {1.1, 1.5, 3.0}) {
        for (const double offset : {0.0, 0.08}) {
            for (const double tilt : {0.0, 0.4}) {
                for (const double side : {1.0, -1.0}) {
                    for (const int facets : {16, 24, 60}) {
                        const Height height = [=](double x, double y) {
                            const double rise = std::sqrt(radius * radius - (y - offset) * (y - offset));
                            return 2 + side * (rise - radius) / std::cos(tilt) + x * std::tan(tilt);
                        };
                        CAPTURE(radius);
                        CAPTURE(offset);
                        CAPTURE(tilt);
                        CAPTURE(side);
                        CAPTURE(facets);
                        check_closed(block_under(circle(facets), 1, height), 0.004);
                    }
                }
            }
        }
    }
}

TEST_CASE("an end aside on a ball or a cone is closed by it, where no other goes through its rim")
{
    for (const double offset : {0.1, 0.3}) {
        const Height ball = [=](double x, double y) {
            return std::sqrt(4 - (x - offset) * (x - offset) - y * y) - 0.5;
        };
        const Height cone = [=](double x, double y) {
            return std::sqrt(std::pow(2 + 0.2 * x, 2) - (y - offset) * (y - offset)) - 0.5;
        };
        CAPTURE(offset);
        for (const auto& [sides, cuts] : {std::pair(5, 8), std::pair(8, 6), std::pair(40, 1)}) {
            CAPTURE(sides);
            check_closed(block_under(circle(sides), cuts, cone), 0.004);
            const Block on_ball = block_under(circle(sides), cuts, ball);
            if (sides == 40) // the rim lies on a round cone as well, far from the ball
                CHECK(refusal_of(on_ball) == "closure.shape_open");
            else
                check_closed(on_ball, 0.004);
        }
    }
}

TEST_CASE("an end of many corners on a cylinder is closed by it")
{
    for (const int sides : {5, 6, 8}) {
        for (const double radius : {1.1, 2.0}) {
            for (const double side : {1.0, -1.0}) {
                const Height height = [=](double x, double) {
                    return 2 + side * (std::sqrt(radius * radius - x * x) - radius);
                };
                CAPTURE(sides);
                CAPTURE(radius);
                CAPTURE(side);
                check_closed(block_under(circle(sides), 8, height), 0.004);
            }
        }
    }
}

TEST_CASE("two planes over a round end or one of many sides are closed as they are, however little they bend")
{
    for (const int sides : {8, 10, 14, 40}) {
        for (const double slope : {0.05, 0.2, 0.35, 0.8}) {
            for (const double other : {0.0, 1.0}) { // a ramp beside a flat half, and a roof
                const Height height = [=](double x, double) { return 2 - slope * (x > 0 ? x : -other * x); };
                CAPTURE(sides);
                CAPTURE(slope);
                CAPTURE(other);
                check_closed(block_under(circle(sides), 2, height), 0.002);
            }
        }
    }
}

TEST_CASE("a round end on many quadrics of which none is special is refused where they are far apart")
{
    for (const int facets : {16, 40}) {
        for (const double bend : {0.02, 0.2, 0.4}) {
            const Height arch = [=](double x, double) { return 1 - bend * x * x; };
            const Height saddle = [=](double x, double y) { return 1 + bend * (x * x - y * y); };
            CAPTURE(facets);
            CAPTURE(bend);
            for (const Height& height : {arch, saddle})
                CHECK(refusal_of(block_under(circle(facets), 1, height)) ==
                      (bend > 0.1 ? "closure.shape_open" : "done"));
        }
    }
}

TEST_CASE("a tube that ends on one as wide may end in two planes, and is refused")
{
    for (const int facets : {24, 60}) {
        const Height height = [](double x, double) { return 2 + std::sqrt(std::max(0.0, 1 - x * x)); };
        CAPTURE(facets);
        CHECK(refusal_of(block_under(circle(facets), 1, height)) == "closure.shape_open");
    }
}

TEST_CASE("the wall beside a missing end is no part of it")
{
    for (const double bend : {0.15, 0.3, 0.5}) {
        const Height bowed = [=](double x, double y) { return 1 + bend * (1 - x * x - y * y); };
        for (const int facets : {16, 24}) {
            const Block block = block_under(half_circle(facets), 8, bowed);
            CAPTURE(bend);
            CAPTURE(facets);
            OpenVolume volume = block.prism.open();
            if (test::refusal([&] { test::seal(volume); }) == "done")
                CHECK(closure::enclosed_volume(volume) == doctest::Approx(block.volume).epsilon(0.03));
        }
    }
}

TEST_CASE("a wavy end of a box is refused where two smooth faces over its rim differ")
{
    for (const double wave : {0.3, 0.4, 0.6}) {
        const Height height = [=](double x, double y) {
            return 1 + wave * std::sin(3 * x + 0.5) * std::cos(2 * y);
        };
        CAPTURE(wave);
        CHECK(refusal_of(block_under(kBox, 12, height)) == "closure.shape_open");
    }
}
