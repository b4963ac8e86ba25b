// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <lacuna/closure/readings.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/healing/shared/stitch.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/matching/match.h>

#include <cmath>
#include <ctime>
#include <numbers>

using namespace lacuna;

namespace {

/// A tube between a square of side 2 and a circle of half its width, n cuts a quarter, one of its four outer
/// walls missing: facets as a scan has them, each with points of its own.
healing::FacetSoup scanned_tube(int n)
{
    healing::FacetSoup soup;
    const auto at = [&](int around, double out, double up) {
        const double turn = 2 * std::numbers::pi * around / (4 * n);
        const Vec3 round(0.5 * std::cos(turn), 0.5 * std::sin(turn), 0);
        const double reach = std::max(std::abs(round.x()), std::abs(round.y()));
        return Vec3((1 - out) * round + out * round / reach + Vec3(0, 0, 2 * up));
    };
    const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        const auto first = static_cast<Index>(soup.points.size());
        soup.points.insert(soup.points.end(), {a, b, c});
        soup.triangles.push_back({first, first + 1, first + 2});
    };
    const auto add_quad = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        add(a, b, c);
        add(a, c, d);
    };
    for (int i = 0; i < 4 * n; ++i) {
        for (int k = 0; k < n; ++k) {
            const double low = double(k) / n, high = double(k + 1) / n;
            for (const double end : {0.0, 1.0})
                add_quad(at(i, low, end), at(i + 1, low, end), at(i + 1, high, end), at(i, high, end));
            add_quad(at(i, 0, low), at(i + 1, 0, low), at(i + 1, 0, high), at(i, 0, high));
            // The corners of the square are odd multiples of an eighth of the turn.
            const bool missing = i >= n / 2 && i < n / 2 + n;
            if (!missing) add_quad(at(i, 1, low), at(i + 1, 1, low), at(i + 1, 1, high), at(i, 1, high));
        }
    }
    return soup;
}

/// Seconds of the processor from the facets to the sealed volume, roles found.
double seconds_to_seal(int n)
{
    const healing::FacetSoup soup = scanned_tube(n);
    const std::clock_t start = std::clock();
    topology::Model model = healing::split_facets(soup);
    healing::stitch(model, model.tolerance);
    std::vector<FaceId> faces;
    for (std::size_t f = 0; f < model.faces.size(); ++f) faces.emplace_back(f);
    const closure::Reading reading = closure::find_reading(model, faces);
    const matching::Match match = matching::match(reading.volume);
    const auto [volume, closure] = closure::close(reading.volume, match);
    const double used = double(std::clock() - start) / CLOCKS_PER_SEC;
    CHECK(model.faces.size() == 6);
    CHECK(reading.classification.value == topology::VolumeClass::III);
    CHECK(closure.void_faces.size() == 1);
    CHECK(closure::is_watertight(volume));
    return used;
}

} // namespace

TEST_CASE("from facets to a sealed volume takes time nearly linear in the facets")
{
    // 26,000 facets and sixteen times as many: by the power 1.1 that is 21 times the time, by 1.5 it is 64.
    const double few = seconds_to_seal(30), many = seconds_to_seal(120);
    CAPTURE(few);
    CAPTURE(many);
    CHECK(many < 40 * std::max(few, 0.01));
}

TEST_CASE("a reading that was sealed as it is says what closing it gives")
{
    const healing::FacetSoup soup = scanned_tube(8);
    const topology::Model model = healing::split_facets(soup);
    std::vector<FaceId> faces;
    for (std::size_t f = 0; f < model.faces.size(); ++f) faces.emplace_back(f);
    const closure::Reading reading = closure::find_reading(model, faces);
    REQUIRE(reading.sealed.has_value());
    const matching::Match match = matching::match(reading.volume);
    CHECK(match.vertices == reading.sealed->match.vertices);
    const auto [volume, closure] = closure::close(reading.volume, match);
    const topology::Model &now = volume.model, &then = reading.sealed->volume.model;
    CHECK(closure.algorithms == reading.sealed->closure.algorithms);
    CHECK(now.points == then.points);
    REQUIRE(now.faces.size() == then.faces.size());
    for (std::size_t f = 0; f < now.faces.size(); ++f)
        CHECK(now.faces[f].triangles == then.faces[f].triangles);
    CHECK(volume.role == reading.sealed->volume.role);
}
