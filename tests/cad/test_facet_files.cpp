// SPDX-License-Identifier: GPL-2.0-or-later
#include "made_files.h"

#include <doctest/doctest.h>
#include <gmsh.h>

#include <algorithm>
#include <clocale>
#include <map>
#include <sstream>

using namespace lacuna;
namespace occ = gmsh::model::occ;

namespace {

/// A box of 2 × 1 × 1 meshed with quads, each of its six surfaces a group "side <tag>".
void quad_box()
{
    occ::addBox(0, 0, 0, 2, 1, 1);
    occ::synchronize();
    gmsh::vectorpair faces;
    gmsh::model::getEntities(faces, 2);
    for (const auto& face : faces) {
        gmsh::model::addPhysicalGroup(2, {face.second}, 100 + face.second);
        gmsh::model::setPhysicalName(2, 100 + face.second, "side " + std::to_string(face.second));
        gmsh::model::mesh::setTransfiniteSurface(face.second);
        gmsh::model::mesh::setRecombine(2, face.second);
    }
    gmsh::vectorpair curves;
    gmsh::model::getEntities(curves, 1);
    for (const auto& curve : curves) gmsh::model::mesh::setTransfiniteCurve(curve.second, 4);
    gmsh::option::setNumber("Mesh.Algorithm", 6);
    gmsh::model::mesh::generate(2);
}

std::size_t quads_of(const topology::Model& model)
{
    std::size_t count = 0;
    for (const topology::Face& face : model.faces) count += face.given_quads.size();
    return count;
}

/// A cube of two triangles a side, in OBJ words; `corner` writes a corner.
template <class Corner>
std::string obj_cube(Corner&& corner)
{
    std::ostringstream text;
    text << "# a cube\nmtllib none.mtl\n";
    for (int i = 0; i < 8; ++i)
        text << "v " << (i & 1) << ".0 " << ((i >> 1) & 1) << "e0 " << (i >> 2) << "\n";
    text << "vt 0 0\nvn 0 0 1\n";
    for (const Quad& q : {Quad{0, 2, 3, 1}, Quad{4, 5, 7, 6}, Quad{0, 1, 5, 4}, Quad{2, 6, 7, 3},
                          Quad{0, 4, 6, 2}, Quad{1, 3, 7, 5}}) {
        text << "f " << corner(q[0]) << ' ' << corner(q[1]) << ' ' << corner(q[2]) << "\nf " << corner(q[0])
             << ' ' << corner(q[2]) << ' ' << corner(q[3]) << "\n";
    }
    return text.str();
}

} // namespace

TEST_CASE("a mesh made from geometry comes back with its quads, its surface tags and its group names, in "
          "every MSH version")
{
    const test::TempFolder folder;
    for (const double version : {2.2, 4.1}) {
        for (const double binary : {0.0, 1.0}) {
            CAPTURE(version);
            CAPTURE(binary);
            const topology::Model model = cad::load({folder.gmsh("box.msh", [&] {
                quad_box();
                gmsh::option::setNumber("Mesh.MshFileVersion", version);
                gmsh::option::setNumber("Mesh.Binary", binary);
            })});
            test::check_model(model);
            CHECK(model.faces.size() == 6);
            CHECK(quads_of(model) == 6 * 9);
            CHECK(model.edges.size() == 12);
            CHECK(test::total_area(model) == doctest::Approx(10));
            for (const topology::Face& face : model.faces)
                CHECK(face.name == "side " + std::to_string(face.tag));
        }
    }
}

TEST_CASE("without keep_mesh the quads of a mesh are facets only")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("box.msh", quad_box);
    const topology::Model model = cad::load({path}, {.keep_mesh = false});
    test::check_model(model);
    CHECK(quads_of(model) == 0);
    CHECK(model.faces.size() == 6);
    CHECK(test::total_area(model) == doctest::Approx(10));
}

TEST_CASE("a mesh of higher order gives the corners of its elements")
{
    const test::TempFolder folder;
    const topology::Model model = cad::load({folder.gmsh("ball.msh", [] {
        occ::addSphere(0, 0, 0, 1);
        occ::synchronize();
        gmsh::option::setNumber("Mesh.MeshSizeMax", 0.3);
        gmsh::model::mesh::generate(2);
        gmsh::model::mesh::setOrder(2);
    })});
    test::check_model(model);
    CHECK(test::total_area(model) == doctest::Approx(4 * 3.14159).epsilon(0.05));
}

TEST_CASE("other mesh formats give the same faces")
{
    const test::TempFolder folder;
    for (const char* name : {"box.unv", "box.bdf", "box.vtk", "box.mesh"}) {
        CAPTURE(name);
        const topology::Model model = cad::load({folder.gmsh(name, [] {
            quad_box();
            gmsh::option::setNumber("Mesh.SaveAll", 1);
        })});
        test::check_model(model);
        CHECK(model.faces.size() == 6);
        CHECK(quads_of(model) == 6 * 9);
        CHECK(test::total_area(model) == doctest::Approx(10));
    }
}

TEST_CASE("an STL file is cut into faces at its sharp edges, text or binary")
{
    const test::TempFolder folder;
    for (const double binary : {0.0, 1.0}) {
        const topology::Model model = cad::load({folder.gmsh("can.stl", [&] {
            occ::addCylinder(0, 0, 0, 0, 0, 2, 1);
            occ::synchronize();
            gmsh::option::setNumber("Mesh.Binary", binary);
            gmsh::option::setNumber("Mesh.MeshSizeMax", 0.2);
            gmsh::model::mesh::generate(2);
        })});
        test::check_model(model);
        CHECK(model.faces.size() == 3);
        CHECK(model.edges.size() == 2);
        for (const int uses : test::uses_of_edges(model)) CHECK(uses == 2);
    }
}

TEST_CASE("an OBJ file is read whichever way its corners are written")
{
    const test::TempFolder folder;
    const auto check = [&](const std::string& text) {
        const topology::Model model = cad::load({folder.write("cube.obj", text)});
        test::check_model(model);
        CHECK(model.faces.size() == 6);
        CHECK(model.points.size() == 8);
        CHECK(test::total_area(model) == doctest::Approx(6));
    };
    check(obj_cube([](Index i) { return std::to_string(i + 1); }));
    check(obj_cube([](Index i) { return std::to_string(i + 1) + "/1"; }));
    check(obj_cube([](Index i) { return std::to_string(i + 1) + "//1"; }));
    check(obj_cube([](Index i) { return std::to_string(i + 1) + "/1/1"; }));
    check(obj_cube([](Index i) { return std::to_string(i - 8); }));
    std::string dos = obj_cube([](Index i) { return std::to_string(i + 1); });
    for (std::size_t at = 0; (at = dos.find('\n', at)) != std::string::npos; at += 2)
        dos.replace(at, 1, "\r\n");
    check(dos);
}

TEST_CASE("groups and polygons of an OBJ file become names and facets")
{
    const test::TempFolder folder;
    const topology::Model model = cad::load(
        {folder.write("two.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2.5 0.5 0\nv 2 1 0\n"
                                 "g left part\nf 1 2 3 4\ng right\nf 2 5 \\\n6 7 3\n")});
    test::check_model(model);
    REQUIRE(model.faces.size() == 2);
    for (const topology::Face& face : model.faces) {
        CAPTURE(face.name);
        CHECK((face.name == "left part" || face.name == "right"));
        CHECK(face.tag == (face.name == "left part" ? 1 : 2));
        CHECK(face.given_quads.empty());
        CHECK(face.triangles.size() == (face.name == "left part" ? 2 : 3));
    }
    CHECK(test::total_area(model) == doctest::Approx(2.25));
}

TEST_CASE("a bad line of an OBJ file is named by its number")
{
    const test::TempFolder folder;
    for (const char* line : {"f 1 2 9", "f 1 2", "f a b c", "f 0 1 2", "v 1 x 2", "f -9 1 2"}) {
        CAPTURE(line);
        const std::string path = folder.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + std::string(line) +
                                                             "\nf 1 2 3\n");
        try {
            (void)cad::load({path});
            FAIL("accepted");
        } catch (const InvalidInput& error) {
            CHECK(std::string(error.what()).find("line 4") != std::string::npos);
        }
    }
}

TEST_CASE("numbers are read with a point for the decimals, whatever the locale")
{
    const test::TempFolder folder;
    const std::string before = std::setlocale(LC_NUMERIC, nullptr);
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8"}) {
        if (!std::setlocale(LC_NUMERIC, name)) continue;
        const topology::Model model = cad::load(
            {folder.write("t.obj", "v 0 0 0\nv 1.5 0 0\nv 0 1.5 0\nf 1 2 3\n")});
        CHECK(test::total_area(model) == doctest::Approx(1.125));
    }
    std::setlocale(LC_NUMERIC, before.c_str());
    CHECK(test::total_area(cad::load({folder.write("t.obj", "v 0 0 0\nv 1.5 0 0\nv 0 1.5 0\nf 1 2 3\n")})) ==
          doctest::Approx(1.125));
}

TEST_CASE("facets are scaled, and parts with a gap welded, before they are cut")
{
    const test::TempFolder folder;
    const std::string path = folder.write(
        "gap.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1.001 0 0\nv 2 0 0\nv 2 1 0\nv 1.001 1 0\n"
                   "f 1 2 3 4\nf 5 6 7 8\n");
    CHECK(cad::load({path}).faces.size() == 2);
    const topology::Model sewn = cad::load({path}, {.tolerance = 0.02, .scale = 10});
    test::check_model(sewn);
    CHECK(sewn.faces.size() == 1);
    CHECK(test::total_area(sewn) == doctest::Approx(200).epsilon(0.01));
}
