// SPDX-License-Identifier: MIT
#include "support/cancelling.h"
#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/closure/readings.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using test::without;

namespace {

std::vector<FaceId> all_faces(const Model& model)
{
    std::vector<FaceId> faces;
    for (std::size_t f = 0; f < model.faces.size(); ++f) faces.emplace_back(f);
    return faces;
}

/// What a reading encloses once it is closed, by the roles it names.
double closed_volume(closure::Reading reading)
{
    if (!reading.closure) {
        matching::Match match;
        if (!reading.volume.faces(Role::source).empty() && !reading.volume.faces(Role::target).empty())
            match = matching::match(reading.volume);
        closure::close(reading.volume, match);
    }
    CHECK(closure::is_watertight(reading.volume));
    return closure::enclosed_volume(reading.volume);
}

/// A bore of two widths: two square tubes on each other and the ledge between them, both ends missing.
healing::FacetSoup stepped_bore()
{
    healing::FacetSoup soup;
    const auto ring = [&](double half, double z) {
        const auto first = static_cast<Index>(soup.points.size());
        for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
            soup.points.emplace_back(half * x, half * y, z);
        return first;
    };
    int label = 0;
    const auto band = [&](Index a, Index b, bool one_face) {
        for (Index i = 0; i < 4; ++i) {
            const Index j = (i + 1) % 4;
            soup.triangles.push_back({a + i, a + j, b + j});
            soup.triangles.push_back({a + i, b + j, b + i});
            soup.triangle_label.insert(soup.triangle_label.end(), 2, label);
            label += one_face ? 0 : 1;
        }
        label += one_face ? 1 : 0;
    };
    const Index low = ring(1, 0), inner = ring(1, 2), outer = ring(2, 2), high = ring(2, 3);
    band(low, inner, false);
    band(inner, outer, true);
    band(outer, high, false);
    return soup;
}

} // namespace

TEST_CASE("faces of a prism without roles enclose the prism, whatever flat faces are missing")
{
    std::size_t found = 0, several = 0;
    for (const int sides : {3, 4, 5, 6}) {
        for (const int holes : {0, 1}) {
            for (const double taper : {1.0, 0.8}) {
                for (int drop = 0; drop < 6; ++drop) {
                    const auto prism = test::prism(
                        {.sides = sides,
                         .holes = holes,
                         .taper = taper,
                         .drop = without(drop == 1 || drop == 3, drop == 2 || drop == 3, false,
                                         drop == 4   ? std::vector<int>{0}
                                         : drop == 5 ? std::vector<int>{0, 1}
                                                     : std::vector<int>{})});
                    CAPTURE(sides);
                    CAPTURE(holes);
                    CAPTURE(taper);
                    CAPTURE(drop);
                    const auto reading = closure::find_reading(prism.model, all_faces(prism.model));
                    CHECK(reading.enclosed == doctest::Approx(prism.facet_volume).epsilon(1e-3));
                    CHECK(closed_volume(reading) == doctest::Approx(reading.enclosed).epsilon(1e-3));
                    ++found;
                    several += reading.ways > 1 ? 1 : 0;
                }
            }
        }
    }
    MESSAGE(found << " voids, " << several << " of them by several readings");
    CHECK(several > 8);
}

TEST_CASE("of readings that enclose the same the one with fewer irregular nodes is taken, and it says so")
{
    for (const int sides : {4, 6}) {
        const auto prism = test::prism({.sides = sides, .drop = without(true, false, false)});
        const auto reading = closure::find_reading(prism.model, all_faces(prism.model));
        CHECK(reading.classification.value == VolumeClass::IV);
        CHECK(reading.roles.irregular == (sides == 4 ? 0 : 2));
        if (sides != 4) continue; // six sides are no rival to the end
        CHECK(reading.ways > 1);
        const auto& why = reading.roles.reasons;
        CHECK(std::any_of(why.begin(), why.end(), [](const std::string& line) {
            return line.find("enclose the same volume") != std::string::npos;
        }));
    }
}

TEST_CASE("a bore of two widths is read with an end at two heights, and keeps its class")
{
    const Model model = healing::split_facets(stepped_bore(), {.whole_labels = true});
    const auto reading = closure::find_reading(model, all_faces(model));
    REQUIRE(reading.closure);
    CHECK(reading.closure->watertight);
    CHECK(reading.enclosed == doctest::Approx(4.0 * 2 + 16.0 * 1));
    const auto source = reading.volume.faces(Role::source), target = reading.volume.faces(Role::target);
    CHECK(std::max(source.size(), target.size()) == 2);
    CHECK(std::min(source.size(), target.size()) == 1);
}

TEST_CASE("readings that enclose different volumes are counted, listed and taken by number")
{
    // Two squares across each other's corner enclose nothing that is known.
    const auto prism = test::prism({.sides = 4, .drop = without(false, false, false, {0, 1, 2})});
    const auto one = closure::find_reading(prism.model, all_faces(prism.model));
    CHECK(test::refusal([&] { closure::find_reading(prism.model, all_faces(prism.model), 99); }) ==
          "topology.no_such_reading");
    const auto first = closure::find_reading(prism.model, all_faces(prism.model), 1);
    CHECK(first.enclosed == one.enclosed);
    const std::vector<FaceId> corner{prism.face({Role::source}), prism.face({Role::wall, 0, 3})};
    CHECK(test::refusal([&] { closure::find_reading(prism.model, corner); }) == "topology.no_roles");
}

TEST_CASE("finding a reading heeds a cancel")
{
    const auto prism = test::prism({.sides = 6, .drop = without(true, false, false)});
    CHECK(test::heeds_cancel([&](const RunContext& context) {
        closure::find_reading(prism.model, all_faces(prism.model), 0, context);
    }));
}
