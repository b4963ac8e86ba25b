// SPDX-License-Identifier: MIT
#include <lacuna/quads/face_pattern.h>
#include <lacuna/quads/measure_plane.h>
#include <lacuna/quads/pattern_counts.h>
#include <lacuna/quads/symmetry.h>

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

using namespace lacuna;
using quads::BoundarySegment;
using quads::PlanarRegion;

namespace {

constexpr double kPi = std::numbers::pi;

/// A segment of a loop: points at shares 0…1 of it, and its length.
struct Piece {
    std::function<Vec2(double)> at;
    double length = 0;
    bool fixed = false;
    int given = 0;
};

Piece line(const Vec2& a, const Vec2& b)
{
    return {[a, b](double t) { return Vec2(a + t * (b - a)); }, (b - a).norm()};
}

Piece arc(const Vec2& centre, double radius, double from, double to)
{
    return {[=](double t) {
                const double angle = from + t * (to - from);
                return Vec2(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
            },
            radius * std::abs(to - from)};
}

struct Seeded {
    PlanarRegion region;
    std::vector<int> segment;
    std::vector<BoundarySegment> segments;
};

/// Nodes by counts, or by the size where there are none.
Seeded seed(const std::vector<std::vector<Piece>>& loops, double size, const std::vector<int>* counts)
{
    Seeded seeded;
    for (const auto& loop : loops) {
        seeded.region.loops.emplace_back();
        for (const Piece& piece : loop) {
            const std::size_t s = seeded.segments.size();
            const double wanted = piece.fixed ? piece.given : piece.length / size;
            const int sides = counts != nullptr ? (*counts)[s]
                                                : std::max(1, static_cast<int>(std::lround(wanted)));
            for (int i = 0; i < sides; ++i) {
                seeded.region.loops.back().push_back(static_cast<Index>(seeded.region.points.size()));
                seeded.region.points.push_back(piece.at(static_cast<double>(i) / sides));
                seeded.segment.push_back(static_cast<int>(s));
            }
            seeded.segments.push_back({wanted, 1, piece.fixed});
        }
    }
    seeded.region.size = [size](const Vec2&) { return size; };
    return seeded;
}

/// Numbers are found, near to those wanted and kept where given, and a grid fills the region with them.
void check_counts(const std::vector<std::vector<Piece>>& loops, double size, double most,
                  std::size_t irregular)
{
    const Seeded plain = seed(loops, size, nullptr);
    const auto counts = quads::pattern_counts(plain.region, plain.segment, plain.segments);
    REQUIRE(counts.has_value());
    for (std::size_t s = 0; s < counts->size(); ++s) {
        const BoundarySegment& own = plain.segments[s];
        CAPTURE(own.wanted);
        CAPTURE((*counts)[s]);
        if (own.fixed) {
            CHECK((*counts)[s] == std::lround(own.wanted));
        } else {
            const double off = (*counts)[s] / own.wanted;
            CHECK((std::abs((*counts)[s] - own.wanted) <= 4 || (off <= most && off >= 1 / most)));
        }
    }
    const Seeded made = seed(loops, size, &*counts);
    const auto meshes = quads::fill_patterns(made.region);
    REQUIRE(!meshes.empty());
    CHECK(quads::measure_plane(meshes[0], made.region).irregular == irregular);
}

} // namespace

TEST_CASE("a ring's loops get as many sides each, up to two and a half times as long as each other")
{
    for (const double inner : {0.4, 0.45, 0.5, 0.7, 0.85}) {
        for (const double size : {0.08, 0.15}) {
            CAPTURE(inner);
            CAPTURE(size);
            check_counts({{arc({0, 0}, 1, 0, 2 * kPi)}, {arc({0, 0}, inner, 0, -2 * kPi)}}, size, 1.72, 0);
        }
    }
}

TEST_CASE("shapes of straight and round sides get numbers that close, whatever their proportions")
{
    std::mt19937 dice(7);
    const auto roll = [&](double from, double to) {
        return from + (to - from) * static_cast<double>(dice()) / static_cast<double>(std::mt19937::max());
    };
    for (int n = 0; n < 40; ++n) {
        CAPTURE(n);
        const double a = roll(1, 2), b = roll(1, 1.5), r = roll(0.3, 0.5), size = roll(0.09, 0.14);
        // A plate with two round corners, as one or with a hole.
        std::vector<std::vector<Piece>> plate{{line({0, 0}, {a, 0}), line({a, 0}, {a, b - r}),
                                               arc({a - r, b - r}, r, 0, kPi / 2), line({a - r, b}, {r, b}),
                                               arc({r, b - r}, r, kPi / 2, kPi), line({0, b - r}, {0, 0})}};
        check_counts(plate, size, 1.25, 2);
        // An L and a T of straight sides.
        const double c = roll(0.4, 0.6) * a, d = roll(0.4, 0.6) * b;
        check_counts({{line({0, 0}, {a, 0}), line({a, 0}, {a, d}), line({a, d}, {c, d}), line({c, d}, {c, b}),
                       line({c, b}, {0, b}), line({0, b}, {0, 0})}},
                     size, 1.25, 0);
    }
}

TEST_CASE("given numbers of sides are kept, and none are found where they contradict each other")
{
    std::vector<std::vector<Piece>> box{
        {line({0, 0}, {1, 0}), line({1, 0}, {1, 1}), line({1, 1}, {0, 1}), line({0, 1}, {0, 0})}};
    box[0][0].fixed = true;
    box[0][0].given = 9;
    check_counts(box, 0.12, 1.25, 0);
    box[0][2].fixed = true;
    box[0][2].given = 8;
    const Seeded plain = seed(box, 0.12, nullptr);
    CHECK(!quads::pattern_counts(plain.region, plain.segment, plain.segments));
    // A given circle: its turns move.
    std::vector<std::vector<Piece>> disc{{arc({0, 0}, 1, 0, 2 * kPi)}};
    disc[0][0].fixed = true;
    for (const int sides : {22, 24, 26, 38}) {
        disc[0][0].given = sides;
        check_counts(disc, 0.2, 1, 4);
    }
}

TEST_CASE("a plate with a hole in its middle stays symmetric, whatever the size asked")
{
    for (int n = 0; n < 24; ++n) {
        CAPTURE(n);
        const double size = 0.08 + 0.005 * n;
        const std::vector<std::vector<Piece>> plate{{line({-1.5, -1}, {1.5, -1}), line({1.5, -1}, {1.5, 1}),
                                                     line({1.5, 1}, {-1.5, 1}), line({-1.5, 1}, {-1.5, -1})},
                                                    {arc({0, 0}, 0.45, kPi / 4, kPi / 4 - 2 * kPi)}};
        const Seeded plain = seed(plate, size, nullptr);
        const auto counts = quads::pattern_counts(plain.region, plain.segment, plain.segments);
        REQUIRE(counts.has_value());
        const Seeded made = seed(plate, size, &*counts);
        auto meshes = quads::fill_patterns(made.region);
        REQUIRE(!meshes.empty());
        // About the middle at least; about axes only where the circle has nodes there.
        CAPTURE((*counts)[0]);
        CAPTURE((*counts)[1]);
        CAPTURE((*counts)[4]);
        CHECK(quads::symmetrise(meshes[0], made.region) >= 2);
    }
}
