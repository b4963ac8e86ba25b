// SPDX-License-Identifier: GPL-2.0-or-later
#include "made_files.h"

#include <doctest/doctest.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <set>
#include <string>

using namespace lacuna;
namespace occ = gmsh::model::occ;

namespace {

/// Facets lie inside the curves they follow: this much of an area or volume may be missing.
constexpr double kChord = 0.01;

} // namespace

TEST_CASE("a solid of any known shape and file format encloses its volume, outward, every edge used twice")
{
    const test::TempFolder folder;
    for (const test::KnownShape& shape : test::known_shapes()) {
        for (const char* ending : {".step", ".brep"}) {
            CAPTURE(shape.name);
            CAPTURE(ending);
            const topology::Model model = cad::load(
                {folder.gmsh("shape" + std::string(ending), shape.build)});
            test::check_model(model);
            CHECK(int(model.faces.size()) == shape.faces);
            CHECK(test::total_area(model) == doctest::Approx(shape.area).epsilon(kChord));
            CHECK(test::enclosed_volume(model) == doctest::Approx(shape.volume).epsilon(kChord));
            for (const int uses : test::uses_of_edges(model)) CHECK(uses == 2);
        }
    }
}

TEST_CASE("points of lines and ellipses are Gmsh's to rounding, and nobody is asked for them")
{
    const test::TempFolder folder;
    constexpr double kScale = 0.001, kPlaces = 9;
    const auto build = [] {
        occ::addBox(100, 50, -30, 1, 2, 3);
        occ::addCylinder(7, 0, 0, 1, 2, 3, 2);
        occ::addTorus(0, 30, 0, 5, 1, -1, 2); // part of a turn
        occ::addCone(0, -40, 0, 3, 1, 2, 2, 1);
        const int oval = occ::addEllipse(-50, 0, 3, 4, 2);
        occ::addPlaneSurface({occ::addCurveLoop({oval})});
    };
    const std::string path = folder.gmsh("curves.brep", build);
    cad::LoadOptions options;
    options.scale = kScale;
    const topology::Model model = cad::load({path}, options);
    test::kill_worker();
    REQUIRE(std::filesystem::remove(path)); // and it cannot be read again

    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    build();
    occ::synchronize();
    for (const topology::Edge& edge : model.edges) {
        CAPTURE(edge.tag);
        std::vector<double> params, places;
        for (int i = 0; i <= kPlaces; ++i)
            params.push_back(edge.params.front() + i / kPlaces * (edge.params.back() - edge.params.front()));
        std::vector<Vec3> points(params.size());
        edge.curve->evaluate(params, points);
        gmsh::model::getValue(1, edge.tag, params, places);
        for (std::size_t i = 0; i < params.size(); ++i) {
            const Vec3 exact = kScale * Vec3(places[3 * i], places[3 * i + 1], places[3 * i + 2]);
            CHECK((points[i] - exact).norm() <= 1e-13 * exact.norm());
        }
    }
    gmsh::finalize();
}

TEST_CASE("face tags, areas and centres are those of the plain import in Gmsh")
{
    const test::TempFolder folder;
    for (const test::KnownShape& shape : test::known_shapes()) {
        CAPTURE(shape.name);
        const std::string path = folder.gmsh("shape.step", shape.build);
        const topology::Model model = cad::load({path});

        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::vectorpair all, faces;
        occ::importShapes(path, all, false);
        occ::synchronize();
        gmsh::model::getEntities(faces, 2);
        REQUIRE(faces.size() == model.faces.size());
        for (std::size_t f = 0; f < faces.size(); ++f) {
            CHECK(model.faces[f].tag == faces[f].second);
            double area = 0, x = 0, y = 0, z = 0;
            occ::getMass(2, faces[f].second, area);
            occ::getCenterOfMass(2, faces[f].second, x, y, z);
            CHECK(topology::face_area(model, FaceId(f)) == doctest::Approx(area).epsilon(kChord));
            CHECK((topology::face_centroid(model, FaceId(f)) - Vec3(x, y, z)).norm() <
                  kChord * model.diagonal);
        }
        gmsh::finalize();
    }
}

TEST_CASE(
    "machined and freeform solids keep each face's area: seams cut open, fillets, tangent bores, thin rings")
{
    using Shapes = std::vector<std::pair<const char*, std::function<void()>>>;
    const auto cut = [](int body, const std::vector<int>& tools) {
        gmsh::vectorpair of, out;
        for (const int tool : tools) of.emplace_back(3, tool);
        std::vector<gmsh::vectorpair> map;
        occ::cut({{3, body}}, of, out, map);
    };
    const Shapes shapes{
        {"crossing bores",
         [&] { cut(occ::addCylinder(0, 0, -2, 0, 0, 4, 1), {occ::addCylinder(-2, 0, 0, 4, 0, 0, 0.5)}); }},
        {"tangent bore",
         [&] { cut(occ::addCylinder(0, 0, -2, 0, 0, 4, 1), {occ::addCylinder(-2, 0, 0, 4, 0, 0, 1)}); }},
        {"cut torus",
         [&] {
             cut(occ::addTorus(0, 0, 0, 2, 0.7),
                 {occ::addBox(0, 0.3, -2, 4, 4, 4), occ::addCylinder(-2, 0, -2, 0, 0, 4, 0.3)});
         }},
        {"sphere with a corner out",
         [&] { cut(occ::addSphere(0, 0, 0, 1), {occ::addBox(0.2, 0.1, -2, 2, 2, 4)}); }},
        {"thin eccentric ring",
         [&] {
             cut(occ::addCylinder(0, 0, 0, 0, 0, 1, 1), {occ::addCylinder(0.0008, 0, -1, 0, 0, 3, 0.999)});
         }},
        {"filleted box",
         [] {
             gmsh::vectorpair out;
             occ::fillet({occ::addBox(0, 0, 0, 3, 2, 1)}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, {0.2},
                         out);
         }},
        {"ellipsoid",
         [] {
             occ::dilate({{3, occ::addSphere(0, 0, 0, 1)}}, 0, 0, 0, 1, 1.5, 2);
         }},
        {"loft",
         [] {
             std::vector<int> wires;
             for (int k = 0; k < 4; ++k) {
                 wires.push_back(
                     occ::addCurveLoop({occ::addEllipse(0.1 * k, 0, k, 1 + 0.2 * k, 0.8 - 0.1 * k)}));
             }
             gmsh::vectorpair out;
             occ::addThruSections(wires, out);
         }},
    };
    const test::TempFolder folder;
    for (const auto& [name, build] : shapes) {
        for (const char* ending : {".brep", ".step"}) {
            CAPTURE(name);
            CAPTURE(ending);
            const std::string path = folder.gmsh("shape" + std::string(ending), build);
            const topology::Model model = cad::load({path});
            test::check_model(model);
            for (const int uses : test::uses_of_edges(model)) CHECK(uses == 2);
            gmsh::initialize(0, nullptr, false);
            gmsh::option::setNumber("General.Terminal", 0);
            gmsh::vectorpair all, solids;
            occ::importShapes(path, all, false);
            occ::synchronize();
            for (std::size_t f = 0; f < model.faces.size(); ++f) {
                double area = 0;
                occ::getMass(2, model.faces[f].tag, area);
                CHECK(topology::face_area(model, FaceId(f)) == doctest::Approx(area).epsilon(kChord));
            }
            double volume = 0;
            gmsh::model::getEntities(solids, 3);
            for (const auto& solid : solids) {
                double own = 0;
                occ::getMass(3, solid.second, own);
                volume += own;
            }
            CHECK(test::enclosed_volume(model) == doctest::Approx(volume).epsilon(2 * kChord));
            gmsh::finalize();
        }
    }
}

TEST_CASE("the kind of a face is known, also where Gmsh does not say it")
{
    const test::TempFolder folder;
    const auto kinds = [&](const std::function<void()>& build) {
        std::set<std::string> found;
        const topology::Model model = cad::load({folder.gmsh("shape.brep", build)});
        for (const topology::Face& face : model.faces) found.insert(face.kind);
        return found;
    };
    CHECK(kinds([] { occ::addCylinder(0, 0, 0, 0, 0, 2, 1); }) == std::set<std::string>{"cylinder", "plane"});
    CHECK(kinds([] { occ::addSphere(0, 0, 0, 2); }) == std::set<std::string>{"sphere"});
    CHECK(kinds([] { occ::addTorus(0, 0, 0, 3, 1); }) == std::set<std::string>{"torus"});
    CHECK(kinds([] { occ::addCone(0, 0, 0, 0, 0, 2, 1, 0); }) == std::set<std::string>{"cone", "plane"});
    // A line turned around an axis: a surface of revolution by name, a cone or a cylinder by shape.
    const auto turned = [](double x0, double x1) {
        const int line = occ::addLine(occ::addPoint(x0, 0, 0), occ::addPoint(x1, 0, 3));
        gmsh::vectorpair out;
        occ::revolve({{1, line}}, 0, 0, 0, 0, 0, 1, 2, out);
    };
    CHECK(kinds([&] { turned(1, 1); }) == std::set<std::string>{"cylinder"});
    CHECK(kinds([&] { turned(1, 2); }) == std::set<std::string>{"cone"});
    CHECK(kinds([] {
              std::vector<int> points;
              for (int i = 0; i < 5; ++i) points.push_back(occ::addPoint(i, std::sin(2.0 * i), 0));
              gmsh::vectorpair out;
              occ::extrude({{1, occ::addSpline(points)}}, 0, 0, 1, out);
          }).count("plane") == 0);
}

TEST_CASE("every coordinate is multiplied by the scale, the exact geometry included")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("cylinder.step", [] { occ::addCylinder(1, 2, 3, 0, 0, 2, 1); });
    const topology::Model plain = cad::load({path});
    for (const double scale : {0.001, 25.4}) {
        const topology::Model scaled = cad::load({path}, {.scale = scale});
        REQUIRE(scaled.points.size() == plain.points.size());
        for (std::size_t p = 0; p < plain.points.size(); ++p) {
            CHECK((scaled.points[p] - scale * plain.points[p]).norm() < 1e-12 * scaled.diagonal);
        }
        CHECK(scaled.diagonal == doctest::Approx(scale * plain.diagonal));
        CHECK(scaled.tolerance == doctest::Approx(scale * plain.tolerance));
        for (const topology::Face& face : scaled.faces) {
            std::vector<Vec3> points;
            std::vector<Vec2> uv;
            for (std::size_t t = 0; t < face.triangles.size(); ++t) {
                points.push_back(scaled.at(face.triangles[t][0]));
                uv.push_back(face.uv[t][0]);
            }
            const std::vector<Vec3> before = points;
            face.surface->project(points, uv);
            for (std::size_t i = 0; i < points.size(); ++i)
                CHECK((points[i] - before[i]).norm() < 1e-9 * scaled.diagonal);
        }
        for (const topology::Edge& edge : scaled.edges) {
            std::vector<Vec3> points(edge.params.size());
            edge.curve->evaluate(edge.params, points);
            for (std::size_t i = 0; i < points.size(); ++i) {
                CHECK((points[i] - scaled.at(edge.points[i])).norm() < 1e-9 * scaled.diagonal);
            }
        }
    }
}

TEST_CASE("scripts of both of Gmsh's kernels are read, names of physical groups with them")
{
    const test::TempFolder folder;
    const std::string square =
        "Point(1) = {0,0,0}; Point(2) = {2,0,0}; Point(3) = {2,1,0}; Point(4) = {0,1,0};\n"
        "Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1};\n"
        "Curve Loop(1) = {1,2,3,4}; Plane Surface(7) = {1};\n"
        "Physical Surface(\"lid\") = {7};\n";
    for (const std::string kernel : {"", "SetFactory(\"OpenCASCADE\");\n"}) {
        CAPTURE(kernel);
        const topology::Model model = cad::load({folder.write("square.geo", kernel + square)});
        test::check_model(model);
        REQUIRE(model.faces.size() == 1);
        CHECK(model.faces[0].tag == 7);
        CHECK(model.faces[0].name == "lid");
        CHECK(model.faces[0].kind == "plane");
        CHECK(test::total_area(model) == doctest::Approx(2));
        CHECK(model.edges.size() == 4);
    }
    // A quarter of a cylinder, as the built-in kernel makes it.
    const topology::Model swept = cad::load(
        {folder.write("quarter.geo", "Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {0,1,0};\n"
                                     "Circle(1) = {2,1,3}; Extrude {0,0,2} { Curve{1}; }\n")});
    test::check_model(swept);
    CHECK(test::total_area(swept) == doctest::Approx(std::numbers::pi).epsilon(kChord));
}

TEST_CASE("labels that CAD programs write by default are no names of faces, those that somebody gave are")
{
    // A product of each face, which Open CASCADE labels.
    const test::TempFolder folder;
    const std::string path = folder.gmsh("faces.step", [] {
        for (int i = 0; i < 4; ++i) occ::addRectangle(0, 0, i, 2, 1);
    });
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto names = [&](const std::string& label, int number) {
        std::string own = text;
        const std::string before = "Open CASCADE STEP translator ";
        for (std::size_t at = own.find(before); at != std::string::npos; at = own.find(before, at + 1)) {
            const std::size_t end = own.find('\'', at);
            const std::string last = own.substr(end - 2, 2);
            if (last == "." + std::to_string(number)) own.replace(at, end - at, label);
        }
        std::multiset<std::string> found;
        const topology::Model model = cad::load({folder.write("named.step", own)});
        for (const topology::Face& face : model.faces) found.insert(face.name);
        return found;
    };
    const std::multiset<std::string> none{"", "", "", ""};
    CHECK(names("Open CASCADE STEP translator 7.8 9.1", 1) == none);
    for (const char* label : {"NONE", "Solid1", "Face 12", "Boss-Extrude1", "SOLID", "Part 1", "17"})
        for (int number = 1; number <= 4; ++number) CHECK(names(label, number) == none);
    for (const char* label : {"inlet", "hot side", "face_a", "hole", "R12x"})
        for (int number = 1; number <= 4; ++number)
            CHECK(names(label, number) == std::multiset<std::string>{"", "", "", label});
    // Physical groups are the user's, whatever they are called.
    const topology::Model model = cad::load(
        {folder.write("square.geo", "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 2, 1};\n"
                                    "Physical Surface(\"Face 12\") = {1};\n")});
    CHECK(model.faces.at(0).name == "Face 12");
}

TEST_CASE("facets turn little from one to the next, and a small face of a large model keeps its shape")
{
    const test::TempFolder folder;
    const topology::Model model = cad::load({folder.gmsh("pin.step", [] {
        occ::addBox(0, 0, 0, 100, 100, 100);
        occ::addCylinder(50, 50, 100, 0, 0, 1, 0.5);
    })});
    test::check_model(model);
    const auto wall = std::find_if(model.faces.begin(), model.faces.end(),
                                   [](const auto& f) { return f.kind == "cylinder"; });
    REQUIRE(wall != model.faces.end());
    CHECK(topology::face_area(model, FaceId(std::size_t(wall - model.faces.begin()))) ==
          doctest::Approx(std::numbers::pi).epsilon(kChord));
    for (const Triangle& t : wall->triangles) {
        const Vec3 n = (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0])).normalized();
        const Vec3 c = (model.at(t[0]) + model.at(t[1]) + model.at(t[2])) / 3 - Vec3(50, 50, 0);
        CHECK(n.dot(Vec3(c.x(), c.y(), 0).normalized()) > std::cos(0.2));
    }
}

TEST_CASE("several files make one model, the tags of the second counting on")
{
    const test::TempFolder folder;
    const std::string a = folder.gmsh("a.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    const std::string b = folder.gmsh("b.brep", [] { occ::addCylinder(5, 0, 0, 0, 0, 1, 1); });
    const std::string c = folder.write("c.obj", "v 9 0 0\nv 10 0 0\nv 9 1 0\nf 1 2 3\n");
    const topology::Model model = cad::load({a, b, c});
    test::check_model(model);
    CHECK(model.faces.size() == 6 + 3 + 1);
    CHECK(test::total_area(model) == doctest::Approx(6 + 4 * std::numbers::pi + 0.5).epsilon(kChord));
    CHECK(model.faces.back().tag == 10);
}

TEST_CASE("loading twice gives the same model to the last bit")
{
    const test::TempFolder folder;
    for (const test::KnownShape& shape : test::known_shapes()) {
        CAPTURE(shape.name);
        const std::string path = folder.gmsh("shape.step", shape.build);
        const topology::Model a = cad::load({path});
        const topology::Model b = cad::load({path});
        CHECK(a.points == b.points);
        REQUIRE(a.faces.size() == b.faces.size());
        for (std::size_t f = 0; f < a.faces.size(); ++f) CHECK(a.faces[f].triangles == b.faces[f].triangles);
    }
}

TEST_CASE("a load that is cancelled stops")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("box.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    const std::atomic<bool> cancel{true};
    RunContext context;
    context.cancel = &cancel;
    CHECK_THROWS_AS(cad::load({path}, {}, context), Cancelled);
}
