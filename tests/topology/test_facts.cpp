// SPDX-License-Identifier: MIT
#include "support/edit_model.h"
#include "support/volumes.h"

#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/face_facts.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/gaps.h>
#include <lacuna/topology/shared/hollows.h>

#include <doctest/doctest.h>

#include <algorithm>

using namespace lacuna;
using namespace lacuna::topology;
using test::without;

TEST_CASE("neighbours know each other, and free edges are those of faces left out")
{
    for (const int sides : {3, 4, 6}) {
        for (const bool drop : {false, true}) {
            const auto prism = test::prism({.sides = sides, .drop = without(drop, false, false)});
            const auto facts = face_facts(prism.model);
            std::size_t free = 0;
            for (std::size_t f = 0; f < facts.size(); ++f) {
                free += facts[f].free_edges.size();
                for (const FaceId other : facts[f].neighbours) {
                    const auto& back = facts[other.index()].neighbours;
                    CHECK(std::find(back.begin(), back.end(), FaceId(f)) != back.end());
                }
            }
            CHECK(free == (drop ? static_cast<std::size_t>(sides) : 0));
        }
    }
}

TEST_CASE("a round wall has its radius and axis, however the prism lies")
{
    for (const double height : {0.5, 3.0}) {
        const auto prism = test::prism({.sides = 0, .radius = 1.5, .height = height, .cuts = 6});
        const auto shape = round_shape(prism.model, prism.face({Role::wall}));
        REQUIRE(shape);
        CHECK(shape->radius == doctest::Approx(1.5));
        REQUIRE(shape->axis);
        CHECK(std::abs(shape->axis->z()) == doctest::Approx(1));
        CHECK(shape->centre.z() == doctest::Approx(height / 2));
        CHECK(shape->centre.head<2>().norm() < 1e-9);
    }
}

TEST_CASE("a tapered wall has the half angle, axis and tip of its cone, and no round or flat wall has any")
{
    for (const double taper : {0.3, 0.8, 1.5}) {
        for (const double height : {0.7, 3.0}) {
            const auto prism = test::prism(
                {.sides = 0, .radius = 1.5, .height = height, .cuts = 16, .taper = taper});
            const FaceId wall = prism.face({Role::wall});
            CHECK(!round_shape(prism.model, wall));
            const auto cone = cone_shape(prism.model, wall);
            CAPTURE(taper);
            CAPTURE(height);
            REQUIRE(cone);
            const double slope = std::abs(taper - 1) * 1.5 / height;
            CHECK(cone->half_angle == doctest::Approx(std::atan(slope) * 180 / 3.14159265).epsilon(0.02));
            CHECK(cone->axis.z() == doctest::Approx(taper < 1 ? -1 : 1));
            CHECK(cone->apex.head<2>().norm() < 1e-6);
            CHECK(cone->apex.z() == doctest::Approx(height / (1 - taper)).epsilon(0.02));
            CHECK(cone->largest_radius == doctest::Approx(1.5 * std::max(1.0, taper)).epsilon(1e-6));
            CHECK(cone->least_radius == doctest::Approx(1.5 * std::min(1.0, taper)).epsilon(1e-6));
        }
    }
    for (const int sides : {0, 3, 4, 6}) {
        const auto prism = test::prism({.sides = sides, .cuts = 6});
        for (std::size_t f = 0; f < prism.model.faces.size(); ++f) CHECK(!cone_shape(prism.model, FaceId(f)));
    }
}

TEST_CASE("a narrow piece of what a file calls a cone or a torus is no cylinder and no sphere")
{
    int alike = 0; // those that facets alone would call so
    for (const double taper : {0.9, 0.99, 0.999}) {
        for (const int pieces : {4, 12}) {
            auto prism = test::prism({.sides = 0, .height = 3, .pieces = pieces, .taper = taper});
            const FaceId wall = prism.face({Role::wall});
            alike += round_shape(prism.model, wall) ? 1 : 0;
            for (const char* kind : {"cone", "torus"}) {
                test::edit(prism.model, [&](ModelBuilder& model) { model[wall].kind = kind; });
                CHECK(!round_shape(prism.model, wall));
            }
        }
    }
    CHECK(alike > 0);
}

TEST_CASE("the holes of a plate are its hollows, and its outer sides are none")
{
    for (const int holes : {0, 1, 3}) {
        for (const int hole_sides : {0, 4, 6}) {
            const auto prism = test::prism({.holes = holes, .hole_sides = hole_sides});
            const auto found = hollows(prism.model);
            REQUIRE(found.size() == static_cast<std::size_t>(holes));
            for (const Hollow& hollow : found) {
                CHECK(hollow.mouths == 2);
                for (const FaceId face : hollow.faces) CHECK(prism.part[face.index()].loop > 0);
            }
        }
    }
}

TEST_CASE("a gap between faces apart is found with its width, and its tolerance is enough and little more")
{
    for (const double width : {1e-5, 3.3e-4, 2e-3}) {
        const auto prism = test::prism({.sides = 4});
        // The source with points, edges and vertices of its own, moved off.
        const Model source = extract(prism.model, {prism.face({Role::source})});
        std::vector<FaceId> rest;
        for (std::size_t f = 0; f < prism.model.faces.size(); ++f)
            if (FaceId(f) != prism.face({Role::source})) rest.emplace_back(f);
        ModelBuilder apart(extract(prism.model, rest));
        const auto points = static_cast<Index>(apart.points.size());
        const std::size_t vertices = apart.vertices.size(), edges = apart.edges.size();
        for (const Vec3& p : source.points) apart.points.push_back(p - width * Vec3::UnitZ());
        for (Vertex v : source.vertices) {
            v.point += points;
            apart.vertices.push_back(v);
        }
        for (Edge e : source.edges) {
            e.from = VertexId(e.from.index() + vertices);
            e.to = VertexId(e.to.index() + vertices);
            for (Index& p : e.points) p += points;
            apart.edges.push_back(e);
        }
        Face face = source.faces.front();
        for (Triangle& t : face.triangles)
            for (Index& p : t) p += points;
        for (Loop& loop : face.loops)
            for (EdgeUse& use : loop.uses) use.edge = EdgeId(use.edge.index() + edges);
        apart.faces.push_back(face);
        apart.tolerance = 1e-9;
        const Model model = std::move(apart).finish();
        const auto found = gaps(model);
        REQUIRE(found.size() == 4);
        for (const Gap& gap : found) {
            CHECK(gap.width == doctest::Approx(width));
            const double enough = sewing_tolerance(model, gap);
            CHECK(enough > gap.width);
            CHECK(enough < 1.2 * gap.width);
        }
    }
}
