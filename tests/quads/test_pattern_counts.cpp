// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/face_pattern.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/quads/shared/pattern_counts.h>
#include <lacuna/quads/shared/pave.h>
#include <lacuna/quads/shared/symmetry.h>

#include "support/cancelling.h"
#include "support/dice.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

using namespace lacuna;
using quads::BoundarySegment;
using quads::PlanarRegion;

namespace {

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
            check_counts(
                {{arc({0, 0}, 1, 0, 2 * std::numbers::pi)}, {arc({0, 0}, inner, 0, -2 * std::numbers::pi)}},
                size, 1.72, 0);
        }
    }
}

TEST_CASE("shapes of straight and round sides get numbers that close, whatever their proportions")
{
    test::Dice dice(7);
    for (int n = 0; n < 40; ++n) {
        CAPTURE(n);
        const double a = dice.between(1, 2), b = dice.between(1, 1.5), r = dice.between(0.3, 0.5),
                     size = dice.between(0.09, 0.14);
        // A plate with two round corners, as one or with a hole.
        std::vector<std::vector<Piece>> plate{
            {line({0, 0}, {a, 0}), line({a, 0}, {a, b - r}), arc({a - r, b - r}, r, 0, std::numbers::pi / 2),
             line({a - r, b}, {r, b}), arc({r, b - r}, r, std::numbers::pi / 2, std::numbers::pi),
             line({0, b - r}, {0, 0})}};
        check_counts(plate, size, 1.25, 2);
        // An L and a T of straight sides.
        const double c = dice.between(0.4, 0.6) * a, d = dice.between(0.4, 0.6) * b;
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
    std::vector<std::vector<Piece>> disc{{arc({0, 0}, 1, 0, 2 * std::numbers::pi)}};
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
        const std::vector<std::vector<Piece>> plate{
            {line({-1.5, -1}, {1.5, -1}), line({1.5, -1}, {1.5, 1}), line({1.5, 1}, {-1.5, 1}),
             line({-1.5, 1}, {-1.5, -1})},
            {arc({0, 0}, 0.45, std::numbers::pi / 4, std::numbers::pi / 4 - 2 * std::numbers::pi)}};
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

namespace {

/// A circle of four arcs from an angle; clockwise for a hole.
std::vector<Piece> round(const Vec2& centre, double radius, bool hole, double from = 0)
{
    std::vector<Piece> pieces;
    for (int k = 0; k < 4; ++k) {
        const double start = from + (hole ? -k : k) * std::numbers::pi / 2;
        pieces.push_back(
            arc(centre, radius, start, start + (hole ? -std::numbers::pi / 2 : std::numbers::pi / 2)));
    }
    return pieces;
}

/// How far the farthest node is from where a mirroring about the origin's axis puts another.
double mirror_error(const quads::PlanarQuads& mesh, double axis)
{
    const Vec2 along(std::cos(axis), std::sin(axis));
    double farthest = 0;
    for (const Vec2& p : mesh.points) {
        const Vec2 image = 2 * along.dot(p) * along - p;
        double nearest = 1;
        for (const Vec2& q : mesh.points) nearest = std::min(nearest, (q - image).norm());
        farthest = std::max(farthest, nearest);
    }
    return farthest;
}

double area_of(const std::vector<std::vector<Piece>>& loops)
{
    double area = 0;
    const Seeded fine = seed(loops, 0.01, nullptr);
    for (const auto& loop : fine.region.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec2 &p = fine.region.points[static_cast<std::size_t>(loop[i])],
                       &q = fine.region.points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
            area += (p.x() * q.y() - p.y() * q.x()) / 2;
        }
    }
    return area;
}

/// Pieces with the numbers of sides that `pattern_counts()` gives them.
Seeded seed_with_counts(const std::vector<std::vector<Piece>>& loops, double size)
{
    const Seeded plain = seed(loops, size, nullptr);
    const auto counts = quads::pattern_counts(plain.region, plain.segment, plain.segments);
    REQUIRE(counts.has_value());
    return seed(loops, size, &*counts);
}

} // namespace

TEST_CASE("plates with rows of holes, slots and flanges are mirrored about both axes, whatever their sizes")
{
    test::Dice dice(11);
    int as_asked = 0, good = 0, all = 0;
    for (int n = 0; n < 36; ++n) {
        CAPTURE(n);
        const double a = dice.between(1.5, 2.5), b = dice.between(0.8, 1.2), r = dice.between(0.2, 0.25);
        std::vector<std::vector<Piece>> loops;
        if (n % 3 == 0) {
            loops = {{line({-a, -b}, {a, -b}), line({a, -b}, {a, b}), line({a, b}, {-a, b}),
                      line({-a, b}, {-a, -b})}};
            for (const double x : {-a / 2, a / 2}) {
                for (const double y : {-b / 2, b / 2}) loops.push_back(round({x, y}, r, true));
            }
            if (n % 2 == 0) loops.push_back(round({0, 0}, r, true));
        } else if (n % 3 == 1) {
            loops = {{line({-a, -b}, {a, -b}), arc({a, 0}, b, -std::numbers::pi / 2, 0),
                      arc({a, 0}, b, 0, std::numbers::pi / 2), line({a, b}, {-a, b}),
                      arc({-a, 0}, b, std::numbers::pi / 2, std::numbers::pi),
                      arc({-a, 0}, b, std::numbers::pi, 3 * std::numbers::pi / 2)}};
            if (n % 2 == 0) loops.push_back(round({0, 0}, 2 * r, true));
        } else {
            loops = {round({0, 0}, a, false)};
            for (const double x : {-0.6 * a, 0.6 * a}) loops.push_back(round({x, 0}, r, true));
            loops.push_back(round({0, 0}, r, true));
        }
        const double asked = dice.between(300, 1500), size = std::sqrt(area_of(loops) / asked);
        const Seeded made = seed_with_counts(loops, size);
        const quads::PlanarQuads mesh = quads::pave(made.region).mesh;
        CHECK(quads::find_fault(mesh, made.region) == "");
        CAPTURE(mesh.how);
        CAPTURE(asked);
        for (const double axis : {0.0, std::numbers::pi / 2}) CHECK(mirror_error(mesh, axis) < 1e-9);
        const quads::PlaneQuality quality = quads::measure_plane(mesh, made.region);
        ++all;
        as_asked += std::abs(static_cast<double>(quality.quads) - asked) <= asked / 4 ? 1 : 0;
        good += quality.min_scaled_jacobian > 0.7 && quality.mean_scaled_jacobian > 0.95 ? 1 : 0;
    }
    MESSAGE(all << " meshes, " << as_asked << " with as many quads as asked, " << good << " good");
    CHECK(as_asked >= all - 2);
    CHECK(good >= all - 6);
}

TEST_CASE("a given number of sides that no image has is kept, and so are its nodes")
{
    for (const int given : {8, 9, 11, 12}) {
        CAPTURE(given);
        std::vector<std::vector<Piece>> plate{{line({-1.5, -1}, {1.5, -1}), line({1.5, -1}, {1.5, 1}),
                                               line({1.5, 1}, {-1.5, 1}), line({-1.5, 1}, {-1.5, -1})},
                                              round({0, 0}, 0.4, true)};
        plate[0][1].fixed = true;
        plate[0][1].given = given;
        const Seeded plain = seed(plate, 0.2, nullptr);
        const auto counts = quads::pattern_counts(plain.region, plain.segment, plain.segments);
        REQUIRE(counts.has_value());
        CHECK((*counts)[1] == given);
        const Seeded made = seed(plate, 0.2, &*counts);
        const quads::PlanarQuads mesh = quads::pave(made.region).mesh;
        CHECK(quads::find_fault(mesh, made.region) == ""); // boundary nodes bit for bit among others
        CHECK(quads::measure_plane(mesh, made.region).min_scaled_jacobian > 0.5);
    }
}

TEST_CASE(
    "an axis that would halve a corner is not cut along, and one round a hole cuts a ring in alike parts")
{
    // A square's diagonals leave two quads of 45 degrees each; its other axes do not.
    const std::vector<std::vector<Piece>> square{
        {line({-1, -1}, {1, -1}), line({1, -1}, {1, 1}), line({1, 1}, {-1, 1}), line({-1, 1}, {-1, -1})},
        round({0, 0}, 0.45, true)};
    // Eight holes about a bore.
    std::vector<std::vector<Piece>> flange{round({0, 0}, 2, false), round({0, 0}, 0.8, true)};
    for (int k = 0; k < 8; ++k) {
        const double angle = std::numbers::pi * k / 4;
        flange.push_back(round(1.4 * Vec2(std::cos(angle), std::sin(angle)), 0.2, true, angle));
    }
    for (const double size : {0.1, 0.13, 0.17}) {
        for (const auto& loops : {square, flange}) {
            CAPTURE(size);
            CAPTURE(loops.size());
            const Seeded plain = seed(loops, size, nullptr);
            const auto counts = quads::pattern_counts(plain.region, plain.segment, plain.segments);
            REQUIRE(counts.has_value());
            const Seeded made = seed(loops, size, &*counts);
            const quads::PlanarQuads mesh = quads::pave(made.region).mesh;
            CHECK(quads::find_fault(mesh, made.region) == "");
            CHECK(quads::measure_plane(mesh, made.region).min_scaled_jacobian > 0.7);
            for (const double axis : {0.0, std::numbers::pi / 2}) CHECK(mirror_error(mesh, axis) < 1e-9);
        }
    }
}

TEST_CASE("flanges with four holes are mirrored about the axes between their holes too")
{
    test::Dice dice(23);
    for (int n = 0; n < 12; ++n) {
        CAPTURE(n);
        const double a = dice.between(1.5, 2.5), far = a * dice.between(0.5, 0.7),
                     r = a * dice.between(0.08, 0.14);
        std::vector<std::vector<Piece>> loops{round({0, 0}, a, false)};
        for (const Vec2& at : {Vec2(far, 0), Vec2(0, far), Vec2(-far, 0), Vec2(0, -far)})
            loops.push_back(round(at, r, true));
        const double asked = dice.between(800, 3000);
        CAPTURE(asked);
        const Seeded made = seed_with_counts(loops, std::sqrt(area_of(loops) / asked));
        const quads::PlanarQuads mesh = quads::pave(made.region).mesh;
        CAPTURE(mesh.how);
        CHECK(quads::find_fault(mesh, made.region) == "");
        for (const double axis : {0.0, std::numbers::pi / 4, std::numbers::pi / 2, 3 * std::numbers::pi / 4})
            CHECK(mirror_error(mesh, axis) < 1e-9);
        const quads::PlaneQuality quality = quads::measure_plane(mesh, made.region);
        CHECK(quality.min_scaled_jacobian > 0.7);
        CHECK(quality.mean_scaled_jacobian > 0.95);
    }
}

TEST_CASE("few quads of plates and flanges with holes are well shaped and nearly always symmetric")
{
    test::Dice dice(29);
    int good = 0, symmetric = 0, all = 0;
    for (int n = 0; n < 24; ++n) {
        CAPTURE(n);
        const double a = dice.between(1.4, 2), r = dice.between(0.14, 0.2);
        std::vector<std::vector<Piece>> loops;
        if (n % 2 == 0) {
            loops = {{line({-a, -1}, {a, -1}), line({a, -1}, {a, 1}), line({a, 1}, {-a, 1}),
                      line({-a, 1}, {-a, -1})}};
            for (const double x : {-a * 0.65, a * 0.65}) {
                for (const double y : {-0.5, 0.5}) loops.push_back(round({x, y}, r, true));
            }
            if (n % 4 == 0) loops.push_back(round({0, 0}, 2 * r, true));
        } else {
            loops = {round({0, 0}, a, false)};
            for (const double x : {-0.45 * a, 0.45 * a}) {
                for (const double y : {-0.45 * a, 0.45 * a}) loops.push_back(round({x, y}, r, true));
            }
        }
        const double asked = dice.between(60, 200);
        CAPTURE(asked);
        const Seeded made = seed_with_counts(loops, std::sqrt(area_of(loops) / asked));
        const quads::PlanarQuads mesh = quads::pave(made.region).mesh;
        CAPTURE(mesh.how);
        CHECK(quads::find_fault(mesh, made.region) == "");
        // A flange may be so about the axes through its holes alone.
        const auto error = [&](double axis) {
            return std::max(mirror_error(mesh, axis), mirror_error(mesh, axis + std::numbers::pi / 2));
        };
        symmetric += error(0) < 1e-9 || (n % 2 != 0 && error(std::numbers::pi / 4) < 1e-9) ? 1 : 0;
        const quads::PlaneQuality quality = quads::measure_plane(mesh, made.region);
        CHECK(quality.min_scaled_jacobian > 0.5);
        ++all;
        good += quality.min_scaled_jacobian > 0.7 && quality.mean_scaled_jacobian > 0.87 ? 1 : 0;
    }
    MESSAGE(all << " meshes, " << symmetric << " symmetric, " << good << " good");
    CHECK(symmetric >= all - 2);
    CHECK(good >= all - 2);
}

TEST_CASE("few quads about a bore with many teeth outside are mostly rings alone")
{
    test::Dice dice(31);
    int plain = 0, all = 0;
    for (int n = 0; n < 8; ++n) {
        CAPTURE(n);
        const int teeth = 8 + 2 * n;
        const double root = dice.between(0.75, 0.85), bore = dice.between(0.3, 0.4),
                     pitch = 2 * std::numbers::pi / teeth;
        std::vector<Piece> rim;
        for (int k = 0; k < teeth; ++k) {
            const auto at = [&](double r, double part) {
                const double turn = (k + part) * pitch;
                return Vec2(r * std::cos(turn), r * std::sin(turn));
            };
            rim.push_back(arc({0, 0}, root, k * pitch, (k + 0.4) * pitch));
            rim.push_back(line(at(root, 0.4), at(1, 0.5)));
            rim.push_back(arc({0, 0}, 1, (k + 0.5) * pitch, (k + 0.9) * pitch));
            rim.push_back(line(at(1, 0.9), at(root, 1)));
        }
        const std::vector<std::vector<Piece>> loops{rim, round({0, 0}, bore, true)};
        const double asked = dice.between(6, 10) * teeth;
        CAPTURE(asked);
        const Seeded made = seed_with_counts(loops, std::sqrt(area_of(loops) / asked));
        const quads::PlanarQuads mesh = quads::pave(made.region).mesh;
        CAPTURE(mesh.how);
        CHECK(quads::find_fault(mesh, made.region) == "");
        const quads::PlaneQuality quality = quads::measure_plane(mesh, made.region);
        ++all;
        plain += quality.irregular == 0 && quality.min_scaled_jacobian > 0.8 ? 1 : 0;
    }
    MESSAGE(plain << " of " << all << " gears have rings alone");
    CHECK(plain >= all - 3);
}

TEST_CASE("few quads of plates with four cut corners are as many as asked, and in a grid")
{
    test::Dice dice(41);
    int as_asked = 0, grids = 0, all = 0;
    for (int n = 0; n < 16; ++n) {
        CAPTURE(n);
        const double a = dice.between(1.2, 2.4);
        std::array<double, 4> c{};
        for (double& cut : c) cut = dice.between(0.1, 0.3);
        const std::array<Vec2, 8> corners{Vec2(c[0], 0),     Vec2(a - c[1], 0), Vec2(a, c[1]),
                                          Vec2(a, 1 - c[2]), Vec2(a - c[2], 1), Vec2(c[3], 1),
                                          Vec2(0, 1 - c[3]), Vec2(0, c[0])};
        std::vector<std::vector<Piece>> loops(1);
        for (std::size_t i = 0; i < 8; ++i) loops[0].push_back(line(corners[i], corners[(i + 1) % 8]));
        for (const double asked : {60.0, 120.0, 180.0}) {
            CAPTURE(asked);
            ++all;
            const double size = std::sqrt(area_of(loops) / asked);
            const Seeded plain = seed(loops, size, nullptr);
            const auto counts = quads::pattern_counts(plain.region, plain.segment, plain.segments);
            if (!counts) continue;
            const Seeded made = seed(loops, size, &*counts);
            const quads::PlanarQuads mesh = quads::pave(made.region).mesh;
            CAPTURE(mesh.how);
            CHECK(quads::find_fault(mesh, made.region) == "");
            const auto quads = static_cast<double>(mesh.quads.size());
            as_asked += std::abs(quads - asked) <= asked / 4 ? 1 : 0;
            grids += mesh.how.starts_with("grid") ? 1 : 0;
        }
    }
    MESSAGE(all << " meshes, " << as_asked << " with as many quads as asked, " << grids << " grids");
    CHECK(as_asked >= all - 7);
    CHECK(grids >= all - 7);
}

TEST_CASE("a plate with one sharp corner is a grid with a node of three quads at each of the others")
{
    test::Dice dice(43);
    int grids = 0, all = 0;
    for (int n = 0; n < 12; ++n) {
        CAPTURE(n);
        const double a = dice.between(1.2, 2.4), b = dice.between(0.1, 0.3), c = dice.between(0.1, 0.3),
                     d = dice.between(0.1, 0.3);
        std::vector<Piece> rim{line({0, 0}, {a - b, 0})};
        if (n % 2 == 0)
            rim.push_back(line({a - b, 0}, {a, b}));
        else
            rim.push_back(arc({a - b, b}, b, -std::numbers::pi / 2, 0));
        rim.push_back(line({a, b}, {a, 1 - c}));
        rim.push_back(line({a, 1 - c}, {a - c, 1}));
        rim.push_back(line({a - c, 1}, {d, 1}));
        rim.push_back(line({d, 1}, {0, 1 - d}));
        rim.push_back(line({0, 1 - d}, {0, 0}));
        const std::vector<std::vector<Piece>> loops{rim};
        for (const double asked : {120.0, 200.0, 400.0}) {
            CAPTURE(asked);
            ++all;
            const double size = std::sqrt(area_of(loops) / asked);
            const Seeded plain = seed(loops, size, nullptr);
            const auto counts = quads::pattern_counts(plain.region, plain.segment, plain.segments);
            if (!counts) continue;
            const Seeded made = seed(loops, size, &*counts);
            const quads::PlanarQuads mesh = quads::pave(made.region).mesh;
            CHECK(quads::find_fault(mesh, made.region) == "");
            const std::size_t irregular = quads::measure_plane(mesh, made.region).irregular;
            grids += mesh.how.starts_with("grid") && irregular == 3 ? 1 : 0;
        }
    }
    MESSAGE(grids << " of " << all << " are grids");
    CHECK(grids >= all * 2 / 3);
}

TEST_CASE("a grid goes on behind a notch whose sides begin where its rows end")
{
    // A cut corner takes a row, which ends on the first side of a round or pointed notch beside it.
    int grids = 0, all = 0;
    for (const bool pointed : {false, true}) {
        for (const double half : {0.07, 0.1}) {
            CAPTURE(pointed);
            CAPTURE(half);
            const double a = 2, c = 0.2, x = 1, deep = 0.15;
            std::vector<Piece> rim{line({0, 0}, {a, 0}), line({a, 0}, {a, 1 - c}),
                                   line({a, 1 - c}, {a - c, 1}), line({a - c, 1}, {x + half, 1})};
            if (pointed) {
                rim.push_back(line({x + half, 1}, {x, 1 - deep}));
                rim.push_back(line({x, 1 - deep}, {x - half, 1}));
            } else {
                rim.push_back(arc({x, 1}, half, 0, -std::numbers::pi / 2));
                rim.push_back(arc({x, 1}, half, -std::numbers::pi / 2, -std::numbers::pi));
            }
            rim.push_back(line({x - half, 1}, {0, 1}));
            rim.push_back(line({0, 1}, {0, 0}));
            const std::vector<std::vector<Piece>> loops{rim};
            for (const double asked : {120.0, 200.0, 400.0}) {
                CAPTURE(asked);
                const Seeded made = seed_with_counts(loops, std::sqrt(area_of(loops) / asked));
                const auto meshes = quads::fill_patterns(made.region);
                ++all;
                if (meshes.empty()) continue;
                ++grids;
                const quads::PlaneQuality quality = quads::measure_plane(meshes[0], made.region);
                CHECK(quality.min_scaled_jacobian > 0.6);
                CHECK(quality.irregular <= 5);
            }
        }
    }
    MESSAGE(grids << " grids of " << all);
    CHECK(grids >= all - 4);
}

TEST_CASE("numbers of sides of an outline with many corners stop within half a second when cancelled")
{
    // A ring of 61 corners within and without, of which every segment wants dozens of sides.
    std::vector<std::vector<Piece>> loops(2);
    const auto corner = [](int i) {
        const double angle = 2 * std::numbers::pi * i / 61;
        return Vec2(std::cos(angle), std::sin(angle));
    };
    for (int i = 0; i < 61; ++i) {
        loops[0].push_back(line(corner(i), corner(i + 1)));
        loops[1].push_back(line(0.6 * corner(-i), 0.6 * corner(-i - 1)));
    }
    const Seeded plain = seed(loops, 2e-3, nullptr);
    CHECK(test::heeds_cancel([&](const RunContext& context) {
        (void)quads::pattern_counts(plain.region, plain.segment, plain.segments, context);
    }));
    for (const double at : {0.05, 0.3}) {
        const auto seconds = test::stops_after(at, test::processor_time, {}, [&](const RunContext& context) {
            for (;;) (void)quads::pattern_counts(plain.region, plain.segment, plain.segments, context);
        });
        REQUIRE(seconds);
        CHECK(*seconds < 0.5);
    }
}
