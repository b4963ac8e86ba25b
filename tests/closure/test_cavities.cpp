// SPDX-License-Identifier: MIT
#include <lacuna/closure/close.h>
#include <lacuna/closure/shared/cavities.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/topology/shared/hollows.h>

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace lacuna;

namespace {

/// Facets of a solid that is turned round the z axis, of an outline with as many corners as it has sides:
/// rings of points, one above the other, joined by triangles and closed by discs.
struct Turned {
    int sides = 12;
    std::vector<std::pair<double, double>> rings{}; ///< radius (half a side) and height, along the outline
    int squares = 0;                                ///< how many of the rings are squares
};

void add(healing::FacetSoup& soup, const Turned& body, const Vec3& at, bool inward, int label)
{
    const auto first = static_cast<Index>(soup.points.size());
    const auto triangle = [&](Index a, Index b, Index c) {
        soup.triangles.push_back(inward ? Triangle{a, c, b} : Triangle{a, b, c});
        soup.triangle_label.push_back(label);
    };
    for (std::size_t r = 0; r < body.rings.size(); ++r) {
        for (int k = 0; k < body.sides; ++k) {
            const double angle = std::numbers::pi / 4 + 2 * std::numbers::pi * k / body.sides;
            double radius = body.rings[r].first;
            if (static_cast<int>(r) < body.squares)
                radius /= std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
            soup.points.push_back(
                at + Vec3(radius * std::cos(angle), radius * std::sin(angle), body.rings[r].second));
        }
    }
    const auto ring = [&](std::size_t r) { return first + static_cast<Index>(r) * body.sides; };
    for (std::size_t r = 0; r + 1 < body.rings.size(); ++r) {
        for (int k = 0; k < body.sides; ++k) {
            const Index a = ring(r) + k, b = ring(r) + (k + 1) % body.sides;
            triangle(a, b, b + body.sides);
            triangle(a, b + body.sides, a + body.sides);
        }
    }
    for (const bool bottom : {true, false}) {
        const Index begin = ring(bottom ? 0 : body.rings.size() - 1);
        for (int k = 1; k + 1 < body.sides; ++k) {
            if (bottom)
                triangle(begin, begin + k + 1, begin + k);
            else
                triangle(begin, begin + k, begin + k + 1);
        }
    }
}

double polygon(int sides, double radius)
{
    return sides / 2.0 * radius * radius * std::sin(2 * std::numbers::pi / sides);
}

topology::Model model_of(const healing::FacetSoup& soup) { return healing::split_facets(soup, {40, 1e-9}); }

std::vector<closure::Cavity> of_kind(const topology::Model& model, const std::string& kind)
{
    std::vector<closure::Cavity> found = closure::cavities(model);
    std::erase_if(found, [&](const closure::Cavity& cavity) { return cavity.kind != kind; });
    return found;
}

} // namespace

TEST_CASE(
    "shells within a facet solid are inner voids whichever way they are wound, a body in a void is none")
{
    std::mt19937 random(5);
    for (int trial = 0; trial < 32; ++trial) {
        CAPTURE(trial);
        healing::FacetSoup soup;
        soup.label_name = {"a", "b"};
        const int sides = std::array{4, 8, 12, 20}[random() % 4];
        add(soup, {.sides = sides, .rings = {{10, 0}, {10, 20}}}, {0, 0, 0}, trial % 2 == 1, 0);
        double volume = 0;
        const int voids = 1 + static_cast<int>(random() % 3);
        for (int v = 0; v < voids; ++v) {
            // Cylinders, cones, spindles, one beside the other.
            const int corners = std::array{4, 6, 12}[random() % 3];
            const double wide = 1 + v % 2, narrow = trial % 3 == 0 ? wide : wide / 2;
            const Vec3 at(0, 0, 1 + 6 * v);
            Turned shape{.sides = corners, .rings = {{wide, 0}, {narrow, 2}}};
            if (trial % 4 == 3) shape.rings.emplace_back(wide, 4);
            add(soup, shape, at, random() % 2 == 0, trial % 5 == 0 ? 1 : 0);
            const auto frustum = [&](double a, double b) {
                return 2 * polygon(corners, 1) * (a * a + a * b + b * b) / 3;
            };
            volume += frustum(wide, narrow) * (trial % 4 == 3 ? 2 : 1);
            // A body that floats in it, and another beside the solid.
            if (trial % 3 == 1)
                add(soup, {.sides = 4, .rings = {{0.2, 0}, {0.2, 0.5}}}, at + Vec3(0, 0, 0.7), false, 1);
        }
        if (trial % 2 == 0) add(soup, {.sides = 6, .rings = {{2, 0}, {2, 5}}}, {50, 0, 0}, false, 1);
        const topology::Model model = model_of(soup);
        const auto found = of_kind(model, "inner void");
        REQUIRE(found.size() == std::size_t(voids));
        double sum = 0;
        for (const closure::Cavity& cavity : found) {
            sum += cavity.volume;
            CHECK(cavity.value == topology::VolumeClass::closed);
        }
        CHECK(sum == doctest::Approx(volume));
        CHECK(closure::cavities(model).size() == found.size());
    }
}

TEST_CASE("a void of one smooth face is an inner void, though it has no ends; bodies inside it are found")
{
    for (const int sides : {12, 16, 24, 36}) {
        for (const double wide : {1.0, 1.5, 2.0}) { // of the equator, height 2
            for (const bool loose : {false, true}) {
                CAPTURE(sides);
                CAPTURE(wide);
                CAPTURE(loose);
                Turned round{.sides = sides};
                double volume = 0;
                for (int k = 0; k <= 12; ++k) {
                    const double angle = std::numbers::pi * k / 12;
                    round.rings.emplace_back(wide * std::max(std::sin(angle), 0.05), -std::cos(angle));
                    if (k == 0) continue;
                    const auto& [a, low] = round.rings[round.rings.size() - 2];
                    const auto& [b, high] = round.rings.back();
                    volume += (high - low) * polygon(sides, 1) * (a * a + a * b + b * b) / 3;
                }
                healing::FacetSoup soup;
                soup.label_name = {"solid", "void", "body"};
                add(soup, {.sides = 4, .rings = {{10, -5}, {10, 5}}}, {0, 0, 0}, false, 0);
                add(soup, round, {0, 0, 0}, sides % 8 == 0, 1);
                const Vec3 at(loose ? 0.0 : 20.0, 0, 0);
                add(soup, {.sides = 5, .rings = {{0.3, -0.3}, {0.3, 0.3}}}, at, false, 2);
                const topology::Model model = healing::split_facets(soup, {60, 1e-9});
                const auto found = of_kind(model, "inner void");
                REQUIRE(found.size() == 1);
                CHECK(found[0].has_bodies == loose);
                CHECK(found[0].faces.size() == (loose ? 8 : 1));
                CHECK(found[0].volume == doctest::Approx(volume));
                std::vector<FaceId> of_void = found[0].faces;
                std::erase_if(of_void, [&](FaceId face) { return model[face].name == "body"; });
                const auto inside = topology::bodies_inside(model, topology::extract(model, of_void));
                CHECK(inside.size() == (loose ? 1 : 0));
                for (const FaceId face : inside) CHECK(model[face].name == "body");
            }
        }
    }
}

TEST_CASE("an inner void with a post in it is one cavity of all its faces")
{
    for (int sides = 4; sides < 24; ++sides) {
        CAPTURE(sides);
        healing::FacetSoup soup;
        soup.label_name = {""};
        add(soup, {.sides = 4, .rings = {{10, -5}, {10, 15}}}, {0, 0, 0}, false, 0);
        // The outline goes down into the top: a post that hangs from the ceiling.
        add(soup, {.sides = sides, .rings = {{4, 0}, {4, 8}, {1, 8}, {1, 3}}}, {0, 0, 0}, sides % 2 == 0, 0);
        const topology::Model model = model_of(soup);
        const auto found = closure::cavities(model);
        REQUIRE(found.size() == 1);
        CHECK(found[0].kind == "inner void");
        CHECK(found[0].volume == doctest::Approx(8 * polygon(sides, 4) - 5 * polygon(sides, 1)));
    }
}

TEST_CASE("pockets of a facet solid are cavities, and so is a void below one")
{
    for (const int sides : {4, 8, 12, 24, 40}) {
        for (const double depth : {1.5, 4.0, 8.0}) {
            for (const double floor : {3.0, 3.0 - depth / 8}) {
                CAPTURE(sides);
                CAPTURE(depth);
                CAPTURE(floor);
                healing::FacetSoup soup;
                soup.label_name = {""};
                const bool inward = sides % 8 == 0;
                add(soup,
                    {.sides = sides,
                     .rings = {{6, 0}, {6, 20}, {3, 20}, {floor, 20 - depth}},
                     .squares = sides % 8 == 0 ? 2 : 0},
                    {0, 0, 0}, inward, 0);
                add(soup, {.sides = 6, .rings = {{2, 0}, {2, 5}}}, {0, 0, 2}, true, 0);
                const topology::Model model = model_of(soup);
                // Four tapered walls can be swept from side to side as well, as a slot.
                auto pockets = closure::cavities(model);
                std::erase_if(pockets, [](const auto& cavity) { return cavity.kind == "inner void"; });
                REQUIRE(pockets.size() == 1);
                if (sides > 4 || floor == 3) CHECK(pockets[0].kind == "pocket");
                CHECK(pockets[0].volume ==
                      doctest::Approx(depth * polygon(sides, 1) * (9 + 3 * floor + floor * floor) / 3));
                CHECK(of_kind(model, "inner void").size() == 1);
            }
        }
    }
}

TEST_CASE("solids that are nested nowhere, and shells with a hole, have no inner void")
{
    for (int trial = 0; trial < 20; ++trial) {
        healing::FacetSoup soup;
        soup.label_name = {""};
        add(soup, {.sides = 12, .rings = {{5, 0}, {5, 10}}}, {0, 0, 0}, false, 0);
        add(soup, {.sides = 4 + trial, .rings = {{2, 0}, {2, 3}}}, {7.5 + trial, 0, 3}, trial % 2 == 0, 0);
        add(soup, {.sides = 4 + trial, .rings = {{2, 0}, {2, 3}}}, {0, 0, 3}, trial % 2 == 0, 0);
        soup.triangles.pop_back();
        soup.triangle_label.pop_back();
        CHECK(closure::cavities(model_of(soup)).empty());
    }
}
