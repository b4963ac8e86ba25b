// SPDX-License-Identifier: GPL-2.0-or-later
#include "made_files.h"

#include <doctest/doctest.h>
#include <gmsh.h>

#include <algorithm>

using namespace lacuna;
namespace occ = gmsh::model::occ;

TEST_CASE("loose faces of a solid are sewn into the solid's skin, their tags kept")
{
    const test::TempFolder folder;
    for (const test::KnownShape& shape : test::known_shapes()) {
        for (const char* ending : {".step", ".brep"}) {
            CAPTURE(shape.name);
            CAPTURE(ending);
            const std::string whole = folder.gmsh("whole" + std::string(ending), shape.build);
            const std::string loose = folder.loose("loose" + std::string(ending), shape.build);
            const topology::Model a = cad::load({whole});
            const topology::Model b = cad::load({loose});
            test::check_model(b);
            CHECK(b.faces.size() == a.faces.size());
            CHECK(b.edges.size() == a.edges.size());
            CHECK(b.vertices.size() == a.vertices.size());
            for (const int uses : test::uses_of_edges(b)) CHECK(uses == 2);
            CHECK(test::enclosed_volume(b) == doctest::Approx(shape.volume).epsilon(0.01));

            gmsh::initialize(0, nullptr, false);
            gmsh::option::setNumber("General.Terminal", 0);
            gmsh::vectorpair all, faces;
            occ::importShapes(loose, all, false);
            occ::synchronize();
            gmsh::model::getEntities(faces, 2);
            REQUIRE(faces.size() == b.faces.size());
            for (std::size_t f = 0; f < faces.size(); ++f) CHECK(b.faces[f].tag == faces[f].second);
            gmsh::finalize();
        }
    }
}

TEST_CASE("faces a gap apart are sewn where the tolerance is wider than the gap, and only there")
{
    const test::TempFolder folder;
    for (const double gap : {1e-3, 1e-2}) {
        CAPTURE(gap);
        const std::string path = folder.gmsh("gap.brep", [&] {
            occ::addRectangle(0, 0, 0, 1, 1);
            occ::addRectangle(1 + gap, 0, 0, 1, 1);
        });
        const topology::Model apart = cad::load({path}, {.tolerance = gap / 2});
        const topology::Model sewn = cad::load({path}, {.tolerance = gap * 2});
        test::check_model(apart);
        test::check_model(sewn);
        CHECK(apart.edges.size() == 8);
        CHECK(apart.vertices.size() == 8);
        CHECK(sewn.edges.size() == 7);
        CHECK(sewn.vertices.size() == 6);
        const std::vector<int> uses = test::uses_of_edges(sewn);
        CHECK(std::count(uses.begin(), uses.end(), 2) == 1);
    }
}

TEST_CASE("a vertex of one loose face on the edge of another splits it")
{
    const test::TempFolder folder;
    const topology::Model model = cad::load({folder.gmsh("tee.brep", [] {
        occ::addRectangle(0, 0, 0, 2, 1);
        occ::addRectangle(0, 1, 0, 1, 1);
        occ::addRectangle(1, 1, 0, 1, 1);
        // Apart from each other: each face with edges of its own.
    })});
    test::check_model(model);
    CHECK(model.faces.size() == 3);
    const std::vector<int> uses = test::uses_of_edges(model);
    CHECK(std::count(uses.begin(), uses.end(), 2) == 3);
    CHECK(std::count(uses.begin(), uses.end(), 1) == 7);
    CHECK(model.vertices.size() == 8);
}

TEST_CASE("closed loose edges that start at different places are sewn in pieces")
{
    const test::TempFolder folder;
    for (const double turn : {0.5, 2.0, 3.0}) {
        CAPTURE(turn);
        const topology::Model model = cad::load({folder.gmsh("disc.brep", [&] {
            const int disc = occ::addDisk(0, 0, 0, 1, 1);
            const int circle = occ::addCircle(0, 0, 0, 1);
            occ::rotate({{1, circle}}, 0, 0, 0, 0, 0, 1, turn);
            gmsh::vectorpair out;
            occ::extrude({{1, circle}}, 0, 0, 2, out);
            (void)disc;
        })});
        test::check_model(model);
        REQUIRE(model.faces.size() == 2);
        const std::vector<int> uses = test::uses_of_edges(model);
        CHECK(std::count(uses.begin(), uses.end(), 1) == 1); // the far rim
        CHECK(std::count(uses.begin(), uses.end(), 2) == 3); // the seam and both halves of the shared circle
    }
}

TEST_CASE("faces that come twice stay, on edges they share")
{
    const test::TempFolder folder;
    const topology::Model model = cad::load({folder.gmsh("two.brep", [] {
        occ::addBox(0, 0, 0, 1, 1, 1);
        occ::addBox(1, 0, 0, 1, 1, 1);
    })});
    test::check_model(model);
    CHECK(model.faces.size() == 12);
    CHECK(model.edges.size() == 20);
    const std::vector<int> uses = test::uses_of_edges(model);
    CHECK(std::count(uses.begin(), uses.end(), 4) == 4);
    CHECK(std::count(uses.begin(), uses.end(), 2) == 16);
    // Each solid is turned outward by itself.
    CHECK(test::enclosed_volume(model) == doctest::Approx(2));
}
