// SPDX-License-Identifier: MIT
#include "support/check_valid.h"
#include "support/volumes.h"

#include <lacuna/closure/close.h>
#include <lacuna/core/error.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/matching/match.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace lacuna;
using namespace lacuna::topology;

namespace {

/// What is left out of a half disc of radius 1.
struct Bore {
    double from = 0, to = 0;          ///< along the straight side
    double along = 0.1, across = 0.1; ///< half axes
};

/// Source and target alone: a half disc with half an ellipse left out, at two heights.
struct HalfRings {
    OpenVolume volume;
    double enclosed = 0; ///< between straight lines from end to end
};

HalfRings half_rings(const Bore& bore, double height)
{
    constexpr int kRound = 32;
    healing::FacetSoup soup;
    soup.label_name = {"source", "target"};
    HalfRings made;
    for (const int end : {0, 1}) {
        const double middle = end == 0 ? bore.from : bore.to, z = end * height;
        const auto first = static_cast<Index>(soup.points.size());
        for (int i = 0; i <= kRound; ++i) {
            const double angle = std::numbers::pi * i / kRound;
            soup.points.emplace_back(std::cos(angle), std::sin(angle), z);
            soup.points.emplace_back(middle + bore.along * std::cos(angle), bore.across * std::sin(angle), z);
        }
        for (Index i = 0; i < kRound; ++i) {
            const Index a = first + 2 * i;
            soup.triangles.push_back({a, a + 2, a + 3});
            soup.triangles.push_back({a, a + 3, a + 1});
            soup.triangle_label.insert(soup.triangle_label.end(), 2, end);
        }
    }
    const double sector = kRound / 2.0 * std::sin(std::numbers::pi / kRound);
    made.enclosed = height * sector * (1 - bore.along * bore.across);
    healing::SplitOptions split;
    split.whole_labels = true;
    const Model model = healing::split_facets(soup, split);
    made.volume = open_volume(model, {{FaceId(0)}, {FaceId(1)}, {}});
    return made;
}

sweep::Swept swept(HalfRings& rings, const matching::MatchOptions& pairs = {})
{
    REQUIRE(classify(rings.volume).value == VolumeClass::I);
    rings.volume = closure::close(rings.volume, matching::match(rings.volume, pairs)).volume;
    sweep::SweepOptions options;
    options.layers.count = 4;
    return sweep::sweep(rings.volume, options);
}

} // namespace

TEST_CASE("straight node lines fill what lies between two ends, however far they lean")
{
    int members = 0;
    for (const double radius : {0.02, 0.1, 0.3}) {
        for (const double lean : {0.0, 45.0, 60.0, 65.0, 70.0, 75.0}) {
            for (const double flat : {1.0, 0.6}) {
                const double height = 0.02 + radius / 5;
                const double half = height * std::tan(lean * std::numbers::pi / 180) / 2;
                if (half + radius > 0.8) continue;
                CAPTURE(radius);
                CAPTURE(lean);
                CAPTURE(flat);
                HalfRings rings = half_rings({-half, half, radius, flat * radius}, height);
                const sweep::Swept mesh = swept(rings);
                test::check_valid(mesh.mesh);
                CHECK(mesh.quality.volume == doctest::Approx(rings.enclosed).epsilon(0.01));
                CHECK(mesh.quality.min_scaled_jacobian >= 0.2);
                ++members;
            }
        }
    }
    CHECK(members >= 20);
    MESSAGE(members << " half rings");
}

TEST_CASE("bores whose node lines would run through each other are refused")
{
    const auto ends = [] {
        return test::prism({.sides = 4, .holes = 2, .drop = test::without(false, false, true)}).open();
    };
    HalfRings beside{ends(), 0}, crossed{ends(), 0};
    test::check_valid(swept(beside).mesh);
    CHECK_THROWS_AS(swept(crossed, {.vertices = {}, .loops = {{1, 2}, {2, 1}}, .flip = {}}), NotClosed);
}
