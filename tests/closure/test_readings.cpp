// SPDX-License-Identifier: MIT
#include "closure/sealing_checks.h"
#include "support/cancelling.h"
#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/closure/readings.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using test::closed_volume;
using test::without;

namespace {

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

/// A closed stack of square bands: a floor, walls of each half width in turn with ledges between, and a lid.
/// Labels count from the floor up; those in `drop` are left out.
healing::FacetSoup stack(const std::vector<double>& halves, const std::set<int>& drop)
{
    healing::FacetSoup soup;
    int label = 0;
    const auto add = [&](const std::vector<Triangle>& facets) {
        if (!drop.contains(label)) {
            soup.triangles.insert(soup.triangles.end(), facets.begin(), facets.end());
            soup.triangle_label.insert(soup.triangle_label.end(), facets.size(), label);
        }
        ++label;
    };
    const auto ring = [&](double half, double z) {
        const auto first = static_cast<Index>(soup.points.size());
        for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
            soup.points.emplace_back(half * x, half * y, z);
        return first;
    };
    const auto side = [](Index a, Index b, Index i) {
        const Index j = (i + 1) % 4;
        return std::vector<Triangle>{{a + i, a + j, b + j}, {a + i, b + j, b + i}};
    };
    Index low = ring(halves.front(), 0);
    add({{low, low + 3, low + 2}, {low, low + 2, low + 1}});
    for (std::size_t k = 0; k < halves.size(); ++k) {
        const Index high = ring(halves[k], static_cast<double>(k + 1));
        for (Index i = 0; i < 4; ++i) add(side(low, high, i));
        low = high;
        if (k + 1 == halves.size()) break;
        low = ring(halves[k + 1], static_cast<double>(k + 1));
        std::vector<Triangle> ledge;
        for (Index i = 0; i < 4; ++i) {
            const auto part = side(high, low, i);
            ledge.insert(ledge.end(), part.begin(), part.end());
        }
        add(ledge);
    }
    add({{low, low + 1, low + 2}, {low, low + 2, low + 3}});
    return soup;
}

/// Square rings on each other, closed by a flat floor and a flat lid, and what they enclose.
struct Rings {
    healing::FacetSoup soup;
    double volume = 0;
};

/// A box of half width 1 + r whose floor's rim is rounded by r. The lid may be left out.
/// @param sides  whether floor, rounding and walls are faces of their own, a rounding and a wall each side
Rings rounded_box(double r, double height, bool lid, bool sides)
{
    constexpr int kSteps = 8;
    std::vector<std::array<double, 2>> at; // half width and height
    for (int k = 0; k <= kSteps; ++k) {
        const double t = k * 1.5707963267948966 / kSteps;
        at.push_back({1 + r * std::sin(t), r * (1 - std::cos(t))});
    }
    at.push_back({1 + r, height});
    Rings made;
    for (const auto& [half, z] : at)
        for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
            made.soup.points.emplace_back(half * x, half * y, z);
    const auto add = [&](Triangle t, int label) {
        made.soup.triangles.push_back(t);
        made.soup.triangle_label.push_back(label);
    };
    add({0, 3, 2}, 0);
    add({0, 2, 1}, 0);
    for (Index k = 0; k + 1 < static_cast<Index>(at.size()); ++k) {
        for (Index i = 0; i < 4; ++i) {
            const Index j = (i + 1) % 4, low = 4 * k, high = low + 4;
            const int label = sides ? 1 + i + (k < kSteps ? 0 : 4) : 0;
            add({low + i, low + j, high + j}, label);
            add({low + i, high + j, high + i}, label);
        }
        const auto& [a, za] = at[static_cast<std::size_t>(k)];
        const auto& [b, zb] = at[static_cast<std::size_t>(k) + 1];
        made.volume += (zb - za) * 4 * (a * a + a * b + b * b) / 3;
    }
    const auto top = static_cast<Index>(made.soup.points.size()) - 4;
    if (lid) add({top, top + 1, top + 2}, 9);
    if (lid) add({top, top + 2, top + 3}, 9);
    return made;
}

/// A sphere's part from its south pole up to a polar angle, as one face, and its lid.
Rings ball(double up_to, bool lid)
{
    constexpr int kRings = 24, kRound = 48;
    Rings made;
    made.soup.points.emplace_back(0, 0, -1);
    for (int k = 1; k <= kRings; ++k) {
        const double t = up_to * k / kRings;
        for (int i = 0; i < kRound; ++i) {
            const double p = 2 * 3.141592653589793 * i / kRound;
            made.soup.points.emplace_back(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), -std::cos(t));
        }
    }
    const auto add = [&](Triangle t, int label) {
        made.soup.triangles.push_back(t);
        made.soup.triangle_label.push_back(label);
    };
    const auto at = [&](int k, int i) { return static_cast<Index>(1 + (k - 1) * kRound + i % kRound); };
    for (int i = 0; i < kRound; ++i) add({0, at(1, i + 1), at(1, i)}, 0);
    for (int k = 1; k < kRings; ++k) {
        for (int i = 0; i < kRound; ++i) {
            add({at(k, i), at(k, i + 1), at(k + 1, i + 1)}, 0);
            add({at(k, i), at(k + 1, i + 1), at(k + 1, i)}, 0);
        }
    }
    for (int i = 1; lid && i + 1 < kRound; ++i) add({at(kRings, 0), at(kRings, i), at(kRings, i + 1)}, 1);
    const double h = 1 - std::cos(up_to);
    made.volume = 3.141592653589793 * h * h * (3 - h) / 3;
    return made;
}

double stack_volume(const std::vector<double>& halves)
{
    double volume = 0;
    for (const double half : halves) volume += 4 * half * half;
    return volume;
}

/// A convex section that is carried along by a map from (x, y, share of the way): its two ends, labelled 0
/// and 1, and a wall for each label of its sides.
healing::FacetSoup carried(const std::vector<Vec2>& section, const std::vector<int>& wall, int steps,
                           const std::function<Vec3(const Vec2&, double)>& way, int drop)
{
    healing::FacetSoup soup;
    const auto n = static_cast<Index>(section.size());
    const auto add = [&](const Triangle& t, int label) {
        if (label == drop) return;
        soup.triangles.push_back(t);
        soup.triangle_label.push_back(label);
    };
    for (int k = 0; k <= steps; ++k)
        for (const Vec2& p : section) soup.points.push_back(way(p, static_cast<double>(k) / steps));
    for (Index i = 1; i + 1 < n; ++i) {
        add({0, i + 1, i}, 0);
        add({steps * n, steps * n + i, steps * n + i + 1}, 1);
    }
    for (Index k = 0; k < steps; ++k) {
        for (Index i = 0; i < n; ++i) {
            const Index a = k * n + i, b = k * n + (i + 1) % n;
            add({a, b, b + n}, wall[static_cast<std::size_t>(i)]);
            add({a, b + n, a + n}, wall[static_cast<std::size_t>(i)]);
        }
    }
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

TEST_CASE(
    "a shaft of several widths is read with ends at several heights, both where it narrows to both sides")
{
    for (const std::vector<double>& halves :
         {std::vector<double>{1, 3, 1}, {1, 2, 3, 1.5}, {1, 4, 1.5, 2, 1}, {2, 1}, {1, 2, 3}}) {
        const Model model = healing::split_facets(stack(halves, {}), {.whole_labels = true});
        const auto reading = closure::find_reading(model, all_faces(model));
        CHECK(reading.enclosed == doctest::Approx(stack_volume(halves)));
        std::size_t wider = 0;
        for (std::size_t k = 0; k + 1 < halves.size(); ++k) wider += halves[k + 1] > halves[k] ? 1 : 0;
        std::vector<std::size_t> ends{reading.roles.roles.source.size(), reading.roles.roles.target.size()};
        std::vector<std::size_t> expected{1 + wider, halves.size() - wider};
        std::sort(ends.begin(), ends.end());
        std::sort(expected.begin(), expected.end());
        CHECK(ends == expected);
    }
}

TEST_CASE("a ledge between two widths may be missing, with or without an end")
{
    for (const std::vector<double>& halves : {std::vector<double>{2, 1}, {1, 2}, {1, 3}}) {
        for (const std::set<int>& drop : {std::set<int>{5}, {0, 5}, {5, 10}, {0, 5, 10}}) {
            const Model model = healing::split_facets(stack(halves, drop), {.whole_labels = true});
            const auto reading = closure::find_reading(model, all_faces(model));
            CHECK(reading.enclosed == doctest::Approx(stack_volume(halves)));
            CHECK(closed_volume(reading) == doctest::Approx(stack_volume(halves)));
        }
    }
}

TEST_CASE("an end and a wall beside it may be missing: two flat faces meet in a straight void edge")
{
    for (const int sides : {3, 4, 5, 6, 8}) {
        for (int wall = 0; wall < sides; ++wall) {
            const auto prism = test::prism({.sides = sides, .drop = without(false, true, false, {wall})});
            CAPTURE(sides);
            CAPTURE(wall);
            const auto reading = closure::find_reading(prism.model, all_faces(prism.model));
            CHECK(reading.enclosed == doctest::Approx(prism.facet_volume));
            CHECK(closed_volume(reading) == doctest::Approx(prism.facet_volume));
        }
    }
}

TEST_CASE("a groove without its ends and its mouth is closed by a flat face for each, whatever its section")
{
    // Outlines whose first side is the mouth.
    const std::vector<std::vector<Vec2>> sections{
        {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}},
        {{2, 1}, {-2, 1}, {-1, -1}, {1, -1}},
        {{1, 1}, {-1, 1}, {-2, -1}, {2, -1}},
        {{1, 2}, {-1, 2}, {-1, 1}, {-3, 1}, {-3, -1}, {3, -1}, {3, 1}, {1, 1}},
        {{1, 2}, {-1, 2}, {-1, 1}, {-1, -1}, {3, -1}, {3, 1}, {1, 1}},
        {{2, 1}, {-2, 1}, {-2, 0}, {-1, -1}, {1, -1}, {2, 0}},
    };
    for (const std::vector<Vec2>& corners : sections) {
        const int sides = static_cast<int>(corners.size());
        for (int turn = 0; turn < sides; ++turn) {
            std::vector<Vec2> outline = corners;
            std::rotate(outline.begin(), outline.begin() + turn, outline.end());
            const int mouth = (sides - turn) % sides;
            const auto groove = test::prism(
                {.height = 5, .outline = outline, .drop = without(true, true, false, {mouth})});
            CAPTURE(sides);
            CAPTURE(mouth);
            const auto reading = closure::find_reading(groove.model, all_faces(groove.model));
            CHECK(reading.enclosed == doctest::Approx(groove.facet_volume).epsilon(1e-6));
            CHECK(closed_volume(reading) == doctest::Approx(groove.facet_volume).epsilon(1e-6));
            if (!reading.closure) continue;
            CHECK(reading.closure->void_faces.size() == 3);
        }
    }
}

TEST_CASE("a bent groove of slanted sides keeps its round mouth, with both ends and without one")
{
    // Outlines whose first side is the mouth, outside the bend or inside it.
    const std::vector<std::vector<Vec2>> sections{
        {{1, -2}, {1, 2}, {-1, 1}, {-1, -1}},
        {{-1, 2}, {-1, -2}, {1, -1}, {1, 1}},
        {{1, -1}, {1, 1}, {-1, 2}, {-1, -2}},
    };
    for (const std::vector<Vec2>& outline : sections) {
        for (const double bend : {120.0, 180.0}) {
            for (const bool target : {false, true}) {
                const auto groove = test::prism({.height = 4 * bend * 3.141592653589793 / 180,
                                                 .outline = outline,
                                                 .levels = 48,
                                                 .bend = bend,
                                                 .drop = without(false, target, false, {0})});
                CAPTURE(outline.front().transpose());
                CAPTURE(bend);
                CAPTURE(target);
                const auto reading = closure::find_reading(groove.model, all_faces(groove.model));
                CHECK(closed_volume(reading) == doctest::Approx(groove.facet_volume).epsilon(0.03));
            }
        }
    }
}

TEST_CASE("faces with rims that bend in space are read as well, and are no grooves")
{
    for (const int sides : {0, 3, 4, 6}) {
        for (const test::End end : {test::End::bowed, test::End::saddle}) {
            for (const bool source : {false, true}) {
                const auto prism = test::prism(
                    {.sides = sides, .target = end, .drop = without(source, true, false)});
                CAPTURE(sides);
                CAPTURE(source);
                const auto readings = closure::find_readings(prism.model, all_faces(prism.model));
                REQUIRE(!readings.empty());
                for (const closure::Reading& reading : readings)
                    CHECK(closed_volume(reading) == doctest::Approx(prism.facet_volume).epsilon(0.2));
            }
        }
    }
}

TEST_CASE("a bent bar is read from end to end where the flat faces beside its bend cannot be cut apart")
{
    // Its flanges are flat faces that all look along the axis of the bend: ends of a stepped sweep, likelier
    // at first sight, but the steps between them are round.
    const std::vector<std::vector<Vec2>> sections{
        {{-0.25, -1}, {0.25, -1}, {0.25, 0.4}, {1, 0.4}, {1, 1}, {-1, 1}, {-1, 0.4}, {-0.25, 0.4}},
        {{-1, -1}, {1, -1}, {1, 1}, {0.5, 1}, {0.5, -0.4}, {-0.5, -0.4}, {-0.5, 1}, {-1, 1}},
        {{0.3, -1},
         {0.3, -0.3},
         {1, -0.3},
         {1, 0.3},
         {0.3, 0.3},
         {0.3, 1},
         {-0.3, 1},
         {-0.3, 0.3},
         {-1, 0.3},
         {-1, -0.3},
         {-0.3, -0.3},
         {-0.3, -1}},
    };
    for (const std::vector<Vec2>& outline : sections) {
        for (const double bend : {60.0, 90.0, 120.0}) {
            const auto bar = test::prism({.height = 2.5 * bend * 3.141592653589793 / 180,
                                          .outline = outline,
                                          .levels = 24,
                                          .bend = bend});
            CAPTURE(outline.size());
            CAPTURE(bend);
            const auto reading = closure::find_reading(bar.model, all_faces(bar.model));
            const Roles& roles = reading.roles.roles;
            REQUIRE(roles.source.size() == 1);
            REQUIRE(roles.target.size() == 1);
            CHECK(std::set<FaceId>{roles.source.front(), roles.target.front()} ==
                  std::set<FaceId>{bar.face({Role::source}), bar.face({Role::target})});
        }
    }
}

TEST_CASE("a floor and a wall beside it alone are no groove: nothing says where their prism ends")
{
    for (const int cuts : {2, 4}) {
        const auto prism = test::prism({.sides = 4, .cuts = cuts});
        const std::vector<FaceId> corner{prism.face({Role::source}), prism.face({Role::wall, 0, 3})};
        CHECK(test::refusal([&] { closure::find_reading(prism.model, corner); }) == "topology.no_roles");
    }
}

TEST_CASE("a missing floor round a pillar that is blind is one face with a hole")
{
    // A pillar of half width 1 stands up into a box of half width 3 from the floor, which is missing.
    for (const bool lid : {true, false}) {
        healing::FacetSoup soup = stack({3}, lid ? std::set<int>{0} : std::set<int>{0, 5});
        healing::FacetSoup pillar = stack({1}, {0});
        for (Vec3& p : pillar.points) p.z() *= 0.5;
        const auto first = static_cast<Index>(soup.points.size());
        soup.points.insert(soup.points.end(), pillar.points.begin(), pillar.points.end());
        for (Triangle& t : pillar.triangles)
            soup.triangles.push_back({t[0] + first, t[2] + first, t[1] + first});
        for (const int label : pillar.triangle_label) soup.triangle_label.push_back(label + 100);
        const Model model = healing::split_facets(soup, {.whole_labels = true});
        const auto reading = closure::find_reading(model, all_faces(model));
        CHECK(reading.enclosed == doctest::Approx(36 - 2));
        CHECK(closed_volume(reading) == doctest::Approx(36 - 2));
    }
}

TEST_CASE("other ways to sweep what a reading encloses enclose the same, and none twice")
{
    std::size_t others = 0;
    for (const int drop : {0, 1, 2}) {
        const auto prism = test::prism(
            {.sides = 4,
             .drop = without(drop == 1, drop == 1, false,
                             drop == 2 ? std::vector<int>{0} : std::vector<int>{})});
        const auto reading = closure::find_reading(prism.model, all_faces(prism.model));
        CAPTURE(drop);
        REQUIRE(reading.others != nullptr);
        std::set<std::vector<FaceId>> ends;
        for (std::size_t k = 0; k < reading.others->ways.size(); ++k) {
            const OpenVolume volume = closure::other_sweep(*reading.others, k);
            CHECK(closure::is_watertight(volume));
            CHECK(closure::enclosed_volume(volume) == doctest::Approx(reading.enclosed));
            CHECK(ends.insert(volume.faces(Role::source)).second);
            ++others;
        }
    }
    CHECK(others >= 6);
}

TEST_CASE("a pocket whose floor has a rounded rim is read from its floor to its mouth")
{
    for (const double r : {0.1, 0.3, 0.6}) {
        for (const bool lid : {true, false}) {
            const Rings box = rounded_box(r, 2, lid, true);
            const Model model = healing::split_facets(box.soup, {.whole_labels = true});
            CAPTURE(r);
            CAPTURE(lid);
            const auto reading = closure::find_reading(model, all_faces(model));
            CHECK(reading.enclosed == doctest::Approx(box.volume));
            CHECK(reading.classification.value == (lid ? VolumeClass::closed : VolumeClass::IV));
            REQUIRE(reading.roles.roles.source.size() == 1);
            const FaceId source = reading.roles.roles.source.front();
            CHECK(std::abs(face_area_vector(model, source).z()) == doctest::Approx(4));
            CHECK(closed_volume(reading) == doctest::Approx(box.volume));
        }
    }
}

TEST_CASE("a hollow that has no edge between bottom and walls is parted where it bends")
{
    for (const bool lid : {true, false}) {
        std::vector<Rings> hollows;
        for (const double up_to : {0.7, 1.2, 1.5707963267948966, 2.2}) hollows.push_back(ball(up_to, lid));
        hollows.push_back(rounded_box(0.4, 1.5, lid, false));
        for (const Rings& hollow : hollows) {
            const Model model = healing::split_facets(hollow.soup, {.whole_labels = true});
            CAPTURE(lid);
            CAPTURE(hollow.volume);
            const auto reading = closure::find_reading(model, all_faces(model));
            REQUIRE(reading.closure);
            CHECK(reading.closure->void_faces.size() == (lid ? 0 : 1));
            CHECK(closure::is_watertight(reading.volume));
            CHECK(reading.enclosed == doctest::Approx(hollow.volume).epsilon(0.01));
            CHECK(reading.volume.faces(Role::source).size() == 1);
            CHECK(reading.volume.faces(Role::wall).size() == 1);
            CHECK(reading.volume.faces(Role::target).size() == 1);
        }
    }
}

TEST_CASE("a tube with a floor round a narrower bore is read from the floor, the bore closed in its plane")
{
    for (const int sides : {0, 4, 6}) {
        for (const double radius : {0.3, 1.0, 3.0}) {
            for (const int hole_sides : {0, 4}) {
                for (const bool upside_down : {false, true}) {
                    CAPTURE(sides);
                    CAPTURE(radius);
                    CAPTURE(hole_sides);
                    CAPTURE(upside_down);
                    test::PrismOptions options{.sides = sides, .radius = radius, .height = 1};
                    const double within = test::prism(options).facet_volume;
                    options.holes = 1;
                    options.hole_sides = hole_sides;
                    const Role open = upside_down ? Role::target : Role::source;
                    options.drop = [&](const test::Part& part) {
                        return part.role == open || (part.role == Role::wall && part.loop > 0);
                    };
                    const auto prism = test::prism(options);
                    const auto readings = closure::find_readings(prism.model, all_faces(prism.model));
                    REQUIRE(readings.size() == 1);
                    const FaceId floor = prism.face({upside_down ? Role::source : Role::target});
                    CHECK(readings.front().roles.roles.source == std::vector{floor});
                    CHECK(readings.front().volume.faces(Role::source).size() == 2);
                    CHECK(readings.front().volume.faces(Role::target).size() == 1);
                    CHECK(closed_volume(readings.front()) == doctest::Approx(within).epsilon(1e-9));
                }
            }
        }
    }
}

TEST_CASE("a ring without its inner wall stays a ring, though both its ends are floors round its bore")
{
    for (const int sides : {0, 4}) {
        for (const double height : {0.4, 2.0}) {
            const auto whole = test::prism({.sides = sides, .height = height, .holes = 1});
            const auto prism = test::prism(
                {.sides = sides, .height = height, .holes = 1, .drop = [](const auto& p) {
                     return p.role == Role::wall && p.loop > 0;
                 }});
            const auto readings = closure::find_readings(prism.model, all_faces(prism.model));
            REQUIRE(!readings.empty());
            CHECK(closed_volume(readings.front()) == doctest::Approx(whole.facet_volume).epsilon(0.02));
        }
    }
}

TEST_CASE("a missing wall between four sides is what its sides lead to, whichever roles are found")
{
    constexpr double kPi = 3.14159265358979323846;
    const auto volume_of = [](const healing::FacetSoup& soup) {
        const Model model = healing::split_facets(soup, {.whole_labels = true});
        return closed_volume(closure::find_reading(model, all_faces(model)));
    };
    // Channels with a round bottom, straight ones.
    std::vector<Vec2> channel{{1, 1}, {-1, 1}, {-1, 0}};
    std::vector<int> wall{2, 3};
    for (int k = 1; k <= 16; ++k) {
        const double t = kPi + k * kPi / 16;
        channel.emplace_back(std::cos(t), std::sin(t));
        wall.push_back(4);
    }
    wall.push_back(5);
    for (const double depth : {0.5, 1.5}) {
        for (const double length : {2.0, 5.0}) {
            const auto way = [&](const Vec2& p, double t) {
                return Vec3(length * t, p.x(), p.y() > 0 ? depth * p.y() : p.y());
            };
            const double whole = volume_of(carried(channel, wall, 8, way, -1));
            for (const int drop : {2, 3, 4, 5}) {
                CAPTURE(depth);
                CAPTURE(length);
                CAPTURE(drop);
                CHECK(volume_of(carried(channel, wall, 8, way, drop)) ==
                      doctest::Approx(whole).epsilon(0.01));
            }
        }
    }
    // Bars of a square section, bent.
    const std::vector<Vec2> square{{2, 0}, {3, 0}, {3, 1}, {2, 1}};
    for (const double angle : {0.8, 1.6, 2.4}) {
        const auto way = [&](const Vec2& p, double t) {
            return Vec3(p.x() * std::cos(angle * t), p.x() * std::sin(angle * t), p.y());
        };
        const double whole = volume_of(carried(square, {2, 3, 4, 5}, 32, way, -1));
        for (const int drop : {2, 3, 4, 5}) {
            CAPTURE(angle);
            CAPTURE(drop);
            CHECK(volume_of(carried(square, {2, 3, 4, 5}, 32, way, drop)) ==
                  doctest::Approx(whole).epsilon(0.01));
        }
    }
}
