// SPDX-License-Identifier: MIT
#include "plane_grids.h"
#include "support/outline_family.h"
#include "support/whole_families.h"

#include <lacuna/quads/shared/pave.h>

#include <lacuna/core/error.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <string>

using namespace lacuna;
using quads::PlanarRegion;

namespace {

/// Sides of a polygon cut to a length.
void add_polygon(PlanarRegion& region, const std::vector<Vec2>& corners, double size)
{
    std::vector<Index>& loop = region.loops.emplace_back();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
        const int n = std::max(1, static_cast<int>(std::lround((b - a).norm() / size)));
        for (int k = 0; k < n; ++k) {
            loop.push_back(static_cast<Index>(region.points.size()));
            region.points.push_back(a + (b - a) * k / n);
        }
    }
}

/// A circle of an even number of nodes; clockwise where it is a hole.
void add_circle(PlanarRegion& region, const Vec2& centre, double radius, double size)
{
    const int n = 2 * std::max(3, static_cast<int>(std::lround(std::numbers::pi * radius / size)));
    const double way = region.loops.empty() ? 1 : -1;
    std::vector<Index>& loop = region.loops.emplace_back();
    for (int i = 0; i < n; ++i) {
        const double angle = way * 2 * std::numbers::pi * i / n;
        loop.push_back(static_cast<Index>(region.points.size()));
        region.points.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
}

/// One node more where the sides are odd in number.
void make_even(PlanarRegion& region)
{
    std::size_t sides = 0;
    for (const auto& loop : region.loops) sides += loop.size();
    if (sides % 2 == 0) return;
    auto& loop = region.loops.front();
    std::size_t longest = 0;
    double most = 0;
    const auto at = [&](std::size_t i) {
        return region.points[static_cast<std::size_t>(loop[i % loop.size()])];
    };
    for (std::size_t i = 0; i < loop.size(); ++i) {
        if ((at(i + 1) - at(i)).norm() <= most) continue;
        most = (at(i + 1) - at(i)).norm();
        longest = i;
    }
    region.points.push_back((at(longest) + at(longest + 1)) / 2);
    loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(longest) + 1,
                static_cast<Index>(region.points.size()) - 1);
}

PlanarRegion polygon(const std::vector<Vec2>& corners, double size)
{
    PlanarRegion region;
    region.size = [size](const Vec2&) { return size; };
    add_polygon(region, corners, size);
    make_even(region);
    return region;
}

PlanarRegion disc(double size)
{
    PlanarRegion region;
    region.size = [size](const Vec2&) { return size; };
    add_circle(region, {0, 0}, 1, size);
    return region;
}

PlanarRegion plate(double size)
{
    PlanarRegion region = polygon({{0, 0}, {3, 0}, {3, 2}, {0, 2}}, size);
    for (const Vec2& c : {Vec2(0.6, 0.6), Vec2(2.4, 0.6), Vec2(0.6, 1.4), Vec2(2.4, 1.4), Vec2(1.5, 1)})
        add_circle(region, c, 0.25, size);
    return region;
}

PlanarRegion gear(int teeth, double size)
{
    PlanarRegion region;
    region.size = [size](const Vec2&) { return size; };
    std::vector<Vec2> outline;
    for (int i = 0; i < 4 * teeth; ++i) {
        const double angle = 2 * std::numbers::pi *
                             (i / 4 + std::array{0.0, 0.06, 0.44, 0.5}[static_cast<std::size_t>(i % 4)]) /
                             teeth;
        const double radius = i % 4 == 1 || i % 4 == 2 ? 1.15 : 0.9;
        outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    add_polygon(region, outline, size);
    add_circle(region, {0, 0}, 0.3, size);
    make_even(region);
    return region;
}

PlanarRegion comb(double size)
{
    std::vector<Vec2> outline{{0, 0}, {6, 0}};
    for (int i = 5; i >= 0; --i) {
        outline.insert(outline.end(), {{i + 0.75, 1}, {i + 0.75, 3}, {i + 0.25, 3}, {i + 0.25, 1}});
        if (i == 5) outline.insert(outline.begin() + 2, Vec2(6, 1));
    }
    outline.emplace_back(0, 1);
    return polygon(outline, size);
}

/// Numbers in [0, 1) that are the same everywhere.
class Dice {
public:
    explicit Dice(std::uint32_t seed) : state_(seed * 2654435761U + 1) {}
    double operator()(double low, double high)
    {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return low + (high - low) * static_cast<double>(state_ >> 40) / 16777216.0;
    }

private:
    std::uint64_t state_;
};

/// A star-like outline with a few holes inside, sides of many lengths.
PlanarRegion random_region(std::uint32_t seed)
{
    Dice dice(seed);
    PlanarRegion region;
    const double size = dice(0.08, 0.3);
    region.size = [size](const Vec2&) { return size; };
    const int n = static_cast<int>(dice(4, 40)), holes = static_cast<int>(dice(0, 5));
    std::vector<double> at{0};
    for (int i = 0; i < n; ++i) at.push_back(at.back() + dice(0.5, 1.5));
    std::vector<Vec2> outline;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * at[static_cast<std::size_t>(i)] / at.back(),
                     radius = dice(0.8, 1.2);
        outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    add_polygon(region, outline, size * dice(0.5, 1.5));
    // The outline comes no nearer than the chord over its widest step.
    for (int k = 0; n >= 8 && k < holes; ++k) {
        const double angle = 2 * std::numbers::pi * k / holes, far = holes == 1 ? 0 : 0.3;
        add_circle(region, far * Vec2(std::cos(angle), std::sin(angle)), dice(0.03, 0.12),
                   size * dice(0.3, 1));
    }
    make_even(region);
    return region;
}

quads::PlaneQuality check_paved(const PlanarRegion& region)
{
    const quads::PlanarQuads mesh = quads::pave(region).mesh;
    CHECK(quads::find_fault(mesh, region) == "");
    return quads::measure_plane(mesh, region);
}

std::string code_of(const PlanarRegion& region)
{
    try {
        quads::pave(region);
    } catch (const Error& error) {
        return error.code();
    }
    return "paved";
}

} // namespace

TEST_CASE("common shapes are paved with good quads, few irregular nodes and rows along the boundary")
{
    struct Shape {
        std::string name;
        PlanarRegion region;
        double least, mean, irregular;
    };
    for (const double size : {0.06, 0.03}) {
        for (const Shape& shape :
             {Shape{"disc", disc(size), 0.6, 0.97, 0.03}, Shape{"plate", plate(size), 0.55, 0.96, 0.06},
              Shape{"gear", gear(9, size), 0.45, 0.93, 0.1}, Shape{"comb", comb(size), 0.6, 0.98, 0.02},
              Shape{"L", polygon({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, size), 0.6, 0.99, 0.01}}) {
            CAPTURE(shape.name);
            CAPTURE(size);
            const quads::PlaneQuality quality = check_paved(shape.region);
            CHECK(quality.min_scaled_jacobian > shape.least);
            CHECK(quality.mean_scaled_jacobian > shape.mean);
            CHECK(quality.irregular_share() < shape.irregular);
            CHECK(quality.size_share() > 0.9);
        }
    }
    CHECK(check_paved(disc(0.05)).row_share() > 0.95);
    CHECK(check_paved(plate(0.05)).row_share() > 0.85);
}

TEST_CASE("no paved region has fewer irregular nodes than the sum rule allows, and few have many more")
{
    constexpr std::uint32_t kSeed = 5;
    constexpr int kOutlines = 24;
    int least = 0, found = 0;
    for (int number = 0; number < kOutlines; ++number) {
        CAPTURE(number);
        const test::SeededDomain seeded = test::family_region(kSeed, number);
        const quads::PlanarQuads mesh = quads::pave(seeded.region).mesh;
        std::vector<int> valence(mesh.points.size(), 0);
        for (const Quad& quad : mesh.quads) {
            for (const Index p : quad) ++valence[index(p)];
        }
        // How far nodes are from regular, those on the boundary by the right angles that fit in theirs.
        int off = 0;
        for (std::size_t p = seeded.region.points.size(); p < mesh.points.size(); ++p)
            off += std::abs(valence[p] - 4);
        for (const auto& loop : seeded.region.loops) {
            for (std::size_t i = 0, n = loop.size(); i < n; ++i) {
                const Vec2& here = seeded.region.points[index(loop[i])];
                const Vec2 after = seeded.region.points[index(loop[(i + 1) % n])] - here;
                const Vec2 before = seeded.region.points[index(loop[(i + n - 1) % n])] - here;
                double angle = std::atan2(after.x() * before.y() - after.y() * before.x(), after.dot(before));
                if (angle < 0) angle += 2 * std::numbers::pi;
                const double right = std::numbers::pi / 2;
                off += std::abs(valence[index(loop[i])] -
                                std::max(1, static_cast<int>(std::round(angle / right))));
            }
        }
        const int bound = quads::least_irregular(seeded.region);
        CHECK(off >= bound);
        least += bound;
        found += off;
    }
    MESSAGE("irregular nodes: " << found << ", " << least << " at least");
    CHECK(found <= 3 * least + 20 * kOutlines);
}

TEST_CASE("a four-sided region of equal opposite counts is a grid, however it is bent")
{
    for (const double bend : {0.0, 0.3, 0.6}) {
        PlanarRegion region;
        region.size = [](const Vec2&) { return 0.1; };
        std::vector<Vec2> outline;
        const auto side = [&](const Vec2& a, const Vec2& b, int n) {
            for (int k = 0; k < n; ++k) outline.push_back(a + (b - a) * k / n);
        };
        side({0, 0}, {2, 0}, 20);
        side({2, 0}, {2, 1}, 10);
        side({2, 1}, {0, 1}, 20);
        side({0, 1}, {0, 0}, 10);
        for (Vec2& p : outline) p.y() += bend * std::sin(std::numbers::pi * p.x() / 2);
        add_polygon(region, outline, 1);
        CAPTURE(bend);
        const quads::Paved paved = quads::pave(region);
        CHECK(quads::find_fault(paved.mesh, region) == "");
        const quads::PlaneQuality quality = quads::measure_plane(paved.mesh, region);
        if (bend < 0.5) {
            CHECK(quality.irregular == 0);
            CHECK(quality.quads == 200);
        }
        if (bend == 0) CHECK(paved.report.used == "mapped");
    }
}

TEST_CASE("loops of 4, 6 and 8 nodes are filled")
{
    for (const int n : {4, 6, 8}) {
        for (std::uint32_t seed = 0; seed < 60; ++seed) {
            Dice dice(seed);
            PlanarRegion region;
            std::vector<Index>& loop = region.loops.emplace_back();
            for (int i = 0; i < n; ++i) {
                const double angle = 2 * std::numbers::pi * (i + dice(-0.2, 0.2)) / n,
                             radius = dice(0.7, 1.3);
                loop.push_back(i);
                region.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
            }
            CAPTURE(n);
            CAPTURE(seed);
            check_paved(region);
        }
    }
}

TEST_CASE("slits, spikes, narrow gaps and jumps in size are filled with valid quads")
{
    for (const double gap : {0.2, 0.05, 0.01}) {
        CAPTURE(gap);
        // A slit from above, a spike, two holes that nearly touch.
        check_paved(
            polygon({{0, 0}, {2, 0}, {2, 1}, {1 + gap / 2, 1}, {1, 0.3}, {1 - gap / 2, 1}, {0, 1}}, 0.1));
        check_paved(polygon({{0, 0}, {2, 0}, {1 + gap, 0.5}, {1, 2}, {1 - gap, 0.5}}, 0.1));
        PlanarRegion holes = polygon({{-2, -1}, {2, -1}, {2, 1}, {-2, 1}}, 0.1);
        add_circle(holes, {-0.5 - gap / 2, 0}, 0.5, 0.1);
        add_circle(holes, {0.5 + gap / 2, 0}, 0.5, 0.1);
        check_paved(holes);
    }
    for (const double ratio : {10.0, 30.0, 100.0}) {
        CAPTURE(ratio);
        PlanarRegion region;
        std::vector<Index>& loop = region.loops.emplace_back();
        const auto side = [&](const Vec2& a, const Vec2& b, int n) {
            for (int k = 0; k < n; ++k) {
                loop.push_back(static_cast<Index>(region.points.size()));
                region.points.push_back(a + (b - a) * k / n);
            }
        };
        side({0, 0}, {1, 0}, static_cast<int>(ratio));
        side({1, 0}, {1, 1}, 1);
        side({1, 1}, {0, 1}, 2);
        side({0, 1}, {0, 0}, 1);
        region.size = [](const Vec2&) { return 0.5; };
        check_paved(region);
    }
}

TEST_CASE("random regions are filled with valid quads")
{
    for (std::uint32_t seed = 0; seed < (test::whole_families() ? 250 : 60); ++seed) {
        CAPTURE(seed);
        check_paved(random_region(seed));
    }
}

TEST_CASE("boundary nodes come back bit for bit, and the same region gives the same quads")
{
    for (const PlanarRegion& region : {disc(0.1), plate(0.1), gear(7, 0.1)}) {
        const quads::PlanarQuads once = quads::pave(region).mesh, again = quads::pave(region).mesh;
        CHECK(once.points == again.points);
        CHECK(once.quads == again.quads);
        REQUIRE(once.points.size() >= region.points.size());
        for (std::size_t i = 0; i < region.points.size(); ++i) CHECK(once.points[i] == region.points[i]);
    }
}

TEST_CASE("rows are as high as asked")
{
    const double size = 0.1;
    PlanarRegion region = disc(size);
    for (const double height : {0.05, 0.08, 0.12}) {
        CAPTURE(height);
        region.row_height = [height](const Vec2&) { return height; };
        const quads::PlanarQuads mesh = quads::pave(region, {.exact_rows = 2}).mesh;
        CHECK(quads::find_fault(mesh, region) == "");
        const auto on_rim = [&](Index p) { return static_cast<std::size_t>(p) < region.points.size(); };
        std::size_t spokes = 0;
        for (const Quad& q : mesh.quads) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (!on_rim(q[k]) || on_rim(q[(k + 1) % 4])) continue;
                const double spoke = (mesh.points[static_cast<std::size_t>(q[k])] -
                                      mesh.points[static_cast<std::size_t>(q[(k + 1) % 4])])
                                         .norm();
                CHECK(spoke == doctest::Approx(height).epsilon(0.02));
                ++spokes;
            }
        }
        CHECK(spokes == region.points.size());
        // The second row ends at twice the height, and nothing lies between.
        std::size_t second = 0;
        for (const Vec2& p : mesh.points) {
            const double depth = 1 - p.norm();
            CHECK((depth < 0.02 * height || depth > 0.95 * height));
            if (depth > 1.05 * height && depth < 2.05 * height) {
                CHECK(depth > 1.9 * height);
                ++second;
            }
        }
        CHECK(second >= region.points.size());
        CHECK(mesh.how.find("2 rows of their own height") != std::string::npos);
    }
}

TEST_CASE("rows as high as promised cost no quad: the worst of a triangle is that in its corner")
{
    for (const double share : {0.7, 0.76, 0.83, 0.87, 0.9}) {
        CAPTURE(share);
        PlanarRegion region = test::plane_polygon(3, 3).region;
        const double side = (region.points[1] - region.points[0]).norm();
        region.size = [&](const Vec2&) { return share * side; };
        const quads::PlanarQuads mesh = quads::pave(region).mesh;
        CHECK(quads::find_fault(mesh, region) == "");
        CHECK(quads::measure_plane(mesh, region).min_scaled_jacobian >
              std::sin(std::numbers::pi / 3) - 0.005);
    }
}

TEST_CASE("rows of a height of their own go round corners and holes")
{
    for (PlanarRegion region : {plate(0.1), gear(7, 0.05)}) {
        region.row_height = [](const Vec2&) { return 0.02; };
        const quads::PlanarQuads mesh = quads::pave(region, {.exact_rows = 2}).mesh;
        CHECK(quads::find_fault(mesh, region) == "");
        const std::string inside = " inside ";
        REQUIRE(mesh.how.find(inside) != std::string::npos);
        const int rows = std::stoi(mesh.how.substr(mesh.how.find(inside) + inside.size()));
        CHECK(rows >= static_cast<int>(region.loops.size()));
    }
}

TEST_CASE("where rows of a height of their own have no room, that is told")
{
    PlanarRegion region = disc(0.1);
    region.row_height = [](const Vec2&) { return 0.3; };
    const quads::PlanarQuads mesh = quads::pave(region, {.exact_rows = 6}).mesh;
    CHECK(quads::find_fault(mesh, region) == "");
    CHECK(mesh.how.find("no room for row") != std::string::npos);
}

TEST_CASE("what cannot be paved is refused in words")
{
    PlanarRegion odd = disc(0.1);
    odd.loops.front().pop_back();
    CHECK(code_of(odd) == "surface.pave_parity");
    PlanarRegion crossed = disc(0.1);
    std::swap(crossed.loops.front()[3], crossed.loops.front()[20]);
    CHECK(code_of(crossed) == "surface.pave_loops");
    PlanarRegion twice = disc(0.1);
    twice.loops.front()[3] = twice.loops.front()[20];
    CHECK(code_of(twice) == "surface.pave_loops");
    PlanarRegion clockwise = disc(0.1);
    std::reverse(clockwise.loops.front().begin(), clockwise.loops.front().end());
    CHECK(code_of(clockwise) == "surface.pave_loops");
    // A hole beside the outer loop, and one that runs the wrong way.
    for (const Vec2& at : {Vec2(3, 0), Vec2(0.2, 0.1)}) {
        PlanarRegion holed = disc(0.1);
        holed.loops.emplace_back();
        for (const Vec2& corner : {Vec2(0, 0), Vec2(0.1, 0), Vec2(0.1, 0.1), Vec2(0, 0.1)}) {
            holed.loops.back().push_back(static_cast<Index>(holed.points.size()));
            holed.points.push_back(at + corner);
        }
        if (at.x() > 1) std::reverse(holed.loops.back().begin(), holed.loops.back().end());
        CHECK(code_of(holed) == "surface.pave_loops");
    }
    CHECK(code_of({}) == "surface.pave_loops");
    const PlanarRegion flat = disc(0.1);
    CHECK_THROWS_AS(quads::pave(flat, {.exact_rows = 1}), InvalidInput);
    CHECK_THROWS_AS(quads::pave(flat, {.exact_rows = -1}), InvalidInput);
}

TEST_CASE("a very short boundary side leaves no needles inside")
{
    // Sines say nothing about lengths: raised by them alone, nodes near such a side met.
    for (const double tiny : {0.003, 0.012, 0.04}) {
        for (const double size : {0.4, 0.55, 0.7, 0.85, 1.0}) {
            for (const double wide : {1.4, 1.5, 1.6}) {
                CAPTURE(tiny);
                CAPTURE(size);
                CAPTURE(wide);
                const PlanarRegion region = polygon(
                    {{0, 0}, {3, 0}, {3, 1}, {wide + tiny, 1}, {wide, 1 + tiny}, {wide, 2.5}, {0, 2.5}},
                    size);
                check_paved(region);
                const quads::PlanarQuads mesh = quads::pave(region).mesh;
                double shortest = size;
                for (const Quad& quad : mesh.quads) {
                    for (std::size_t k = 0; k < 4; ++k) {
                        const auto at = [&](std::size_t i) {
                            return mesh.points[static_cast<std::size_t>(quad[i % 4])];
                        };
                        shortest = std::min(shortest, (at(k + 1) - at(k)).norm());
                    }
                }
                CHECK(shortest > tiny / 2);
            }
        }
    }
}
