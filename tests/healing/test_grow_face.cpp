// SPDX-License-Identifier: MIT
#include <lacuna/healing/shared/grow_face.h>
#include <lacuna/healing/split_facets.h>

#include <lacuna/core/error.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace lacuna;

namespace {

/// A tube of `sides` by `rows` cells about z, closed by fans at its ends; quads, or triangles where that is
/// asked for. Labels: 0 the lower half of the wall, 1 the upper, 2 and 3 the ends.
healing::FacetSoup tube(int sides, int rows, bool quads)
{
    healing::FacetSoup soup;
    for (int r = 0; r <= rows; ++r)
        for (int s = 0; s < sides; ++s) {
            const double angle = 2 * std::numbers::pi * s / sides;
            soup.points.emplace_back(std::cos(angle), std::sin(angle), r);
        }
    const auto at = [&](int s, int r) { return r * sides + s % sides; };
    for (int r = 0; r < rows; ++r)
        for (int s = 0; s < sides; ++s) {
            const Quad q{at(s, r), at(s + 1, r), at(s + 1, r + 1), at(s, r + 1)};
            const int label = 2 * r < rows ? 0 : 1;
            if (quads) {
                soup.quads.push_back(q);
                soup.quad_label.push_back(label);
                continue;
            }
            for (const Triangle& t : {Triangle{q[0], q[1], q[2]}, Triangle{q[0], q[2], q[3]}}) {
                soup.triangles.push_back(t);
                soup.triangle_label.push_back(label);
            }
        }
    for (const int end : {0, 1}) {
        const auto centre = static_cast<Index>(soup.points.size());
        soup.points.emplace_back(0, 0, end * rows);
        for (int s = 0; s < sides; ++s) {
            Triangle t{at(s, end * rows), at(s + 1, end * rows), centre};
            if (end == 0) std::swap(t[0], t[1]);
            soup.triangles.push_back(t);
            soup.triangle_label.push_back(2 + end);
        }
    }
    soup.label_name = {"low", "high", "bottom", "top"};
    return soup;
}

std::vector<FaceId> all_of(const topology::Model& model)
{
    std::vector<FaceId> all;
    for (std::size_t f = 0; f < model.faces.size(); ++f) all.emplace_back(f);
    return all;
}

double area_of(const topology::Model& model)
{
    double area = 0;
    for (const FaceId f : all_of(model)) area += topology::face_area(model, f);
    return area;
}

} // namespace

TEST_CASE("a face grows over every turn up to the angle and over none beyond")
{
    for (const int sides : {6, 12, 36})
        for (const bool quads : {true, false})
            for (const int rows : {2, 5}) {
                CAPTURE(sides);
                CAPTURE(quads);
                CAPTURE(rows);
                const topology::Model model = healing::split_facets(tube(sides, rows, quads), {89});
                REQUIRE(model.faces.size() == 4);
                const double turn = 360.0 / sides;
                const double middle = 2 * std::numbers::pi * (0.5 / sides);
                const Vec3 near(std::cos(middle), std::sin(middle), 0.4);
                const double strip = 2 * std::sin(std::numbers::pi / sides);
                // One column of the wall, over the border of the labels.
                const auto column = healing::grow_face(model, near, all_of(model), {0.9 * turn});
                CHECK(topology::face_area(column.model, column.face) == doctest::Approx(strip * rows));
                CHECK(area_of(column.model) == doctest::Approx(area_of(model)));
                CHECK(column.model[column.face].loops.size() == 1);
                CHECK(column.model[column.face].given_quads.size() ==
                      (quads ? static_cast<std::size_t>(rows) : 0));
                CHECK(column.model[column.face].name == "low");
                // The wall whole: its two faces are no more, the ends are what they were.
                const auto wall = healing::grow_face(model, near, all_of(model), {1.1 * turn});
                CHECK(topology::face_area(wall.model, wall.face) == doctest::Approx(strip * rows * sides));
                CHECK(wall.model.faces.size() == 3);
                CHECK(wall.model[wall.face].loops.size() == 2);
                for (std::size_t f = 0; f < 4; ++f) {
                    const bool end = model.faces[f].name == "bottom" || model.faces[f].name == "top";
                    CHECK(wall.now[f].valid() == end);
                    if (end) CHECK(wall.model[wall.now[f]].tag == model.faces[f].tag);
                }
                // Over the rim too.
                const auto all = healing::grow_face(model, near, all_of(model), {90.5});
                CHECK(all.model.faces.size() == 1);
                CHECK(topology::face_area(all.model, all.face) == doctest::Approx(area_of(model)));
            }
}

TEST_CASE("a face grows only over the faces that it may, and one that is there is told")
{
    const topology::Model model = healing::split_facets(tube(24, 4, true), {89});
    const auto low = std::find_if(model.faces.begin(), model.faces.end(),
                                  [](const topology::Face& face) { return face.name == "low"; });
    const FaceId id(static_cast<std::size_t>(low - model.faces.begin()));
    const auto grown = healing::grow_face(model, Vec3(5, 0, 9), std::vector{id}, {30});
    CHECK(grown.face == id);
    CHECK(grown.model.faces.size() == model.faces.size());
    CHECK(grown.model.edges.size() == model.edges.size());
    CHECK_THROWS_AS(healing::grow_face(model, Vec3::Zero(), {}), InvalidInput);
    CHECK_THROWS_AS(healing::grow_face(model, Vec3::Zero(), all_of(model), {0}), InvalidInput);
    CHECK_THROWS_AS(healing::grow_face(model, Vec3::Zero(), all_of(model), {181}), InvalidInput);
}

TEST_CASE("growing again and again leaves a model of the same facets, tags each once, edges of two faces")
{
    std::mt19937 random(7);
    for (int trial = 0; trial < 20; ++trial) {
        CAPTURE(trial);
        topology::Model model = healing::split_facets(tube(12, 6, trial % 2 == 0), {20});
        const double area = area_of(model);
        for (int again = 0; again < 6; ++again) {
            const std::vector<FaceId> all = all_of(model);
            const auto at = [&] { return std::uniform_real_distribution(-1.5, 1.5)(random); };
            const double angle = std::uniform_real_distribution(5.0, 60.0)(random);
            const Vec3 near(at(), at(), 3 + 3 * at());
            model = healing::grow_face(model, near, all, {angle}).model;
            CHECK(area_of(model) == doctest::Approx(area));
            std::vector<int> tags, uses(model.edges.size(), 0);
            for (const topology::Face& face : model.faces) {
                tags.push_back(face.tag);
                CHECK(!face.triangles.empty());
                for (const topology::Loop& loop : face.loops)
                    for (const topology::EdgeUse& use : loop.uses) ++uses[use.edge.index()];
            }
            std::sort(tags.begin(), tags.end());
            CHECK(std::adjacent_find(tags.begin(), tags.end()) == tags.end());
            for (const int count : uses) CHECK(count == 2);
        }
    }
}
