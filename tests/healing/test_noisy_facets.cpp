// SPDX-License-Identifier: MIT
#include <lacuna/healing/split_facets.h>
#include <lacuna/topology/model.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

using namespace lacuna;
using namespace lacuna::topology;

namespace {

constexpr int kAround = 40, kUp = 80;

/// A tube without ends, round or square, of right triangles with sides of 1 along it.
healing::FacetSoup tube(bool square)
{
    healing::FacetSoup soup;
    for (int j = 0; j <= kUp; ++j)
        for (int i = 0; i < kAround; ++i) {
            const double angle = 2 * std::numbers::pi * i / kAround;
            const double radius = kAround / (2 * std::numbers::pi), half = kAround / 8.0;
            const double along = i % (kAround / 4) - half;
            constexpr std::array<std::array<double, 2>, 4> kWays = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
            const auto& way = kWays[static_cast<std::size_t>(4 * i / kAround)];
            const Vec3 round(radius * std::cos(angle), radius * std::sin(angle), j);
            const Vec3 flat(along * way[0] + half * way[1], along * way[1] - half * way[0], j);
            soup.points.push_back(square ? flat : round);
        }
    for (int j = 0; j < kUp; ++j)
        for (int i = 0; i < kAround; ++i) {
            const int a = j * kAround + i, b = j * kAround + (i + 1) % kAround, c = b + kAround,
                      d = a + kAround;
            soup.triangles.push_back({a, b, c});
            soup.triangles.push_back({a, c, d});
        }
    return soup;
}

/// The same with normal noise in all directions, a share of the sides.
healing::FacetSoup noisy(healing::FacetSoup soup, double noise, unsigned seed)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> off(0, noise);
    for (Vec3& p : soup.points) p += Vec3(off(random), off(random), off(random));
    return soup;
}

bool has_note(const Model& model)
{
    return std::ranges::any_of(model.notes,
                               [](const Message& note) { return note.code() == "healing.noisy_facets"; });
}

} // namespace

TEST_CASE("noise of 5 to 40 % of the sides leaves a round tube one face and a square one four")
{
    for (const double noise : {0.05, 0.1, 0.2, 0.3, 0.4})
        for (const bool square : {false, true})
            for (unsigned seed = 1; seed <= 3; ++seed) {
                CAPTURE(noise);
                CAPTURE(square);
                CAPTURE(seed);
                const Model model = healing::split_facets(noisy(tube(square), noise, seed));
                CHECK(model.faces.size() == (square ? 4 : 1));
                if (noise > 0.3) continue; // edges may have a corner too many
                CHECK(model.edges.size() == (square ? 12 : 2));
                CHECK(model.vertices.size() == (square ? 8 : 2));
                if (noise > 0.05) CHECK(has_note(model));
            }
}

TEST_CASE("clean tubes have the same faces, and no note")
{
    for (const bool square : {false, true}) {
        const Model model = healing::split_facets(tube(square));
        CHECK(model.faces.size() == (square ? 4 : 1));
        CHECK(!has_note(model));
    }
}

TEST_CASE("a noisy sheet keeps its four corners")
{
    healing::FacetSoup soup = tube(false);
    for (int j = 0; j <= kUp; ++j)
        for (int i = 0; i < kAround; ++i)
            soup.points[static_cast<std::size_t>(j * kAround + i)] = Vec3(i, j, 0);
    std::erase_if(soup.triangles, [](const Triangle& t) { // across the seam
        return std::ranges::any_of(t, [](Index p) { return p % kAround == 0; }) &&
               std::ranges::any_of(t, [](Index p) { return p % kAround == kAround - 1; });
    });
    for (const double noise : {0.1, 0.2, 0.3}) {
        CAPTURE(noise);
        const Model model = healing::split_facets(noisy(soup, noise, 1));
        CHECK(model.faces.size() == 1);
        CHECK(model.edges.size() == 4);
    }
}
