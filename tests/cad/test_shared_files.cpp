// SPDX-License-Identifier: GPL-2.0-or-later
//
// Real files, which are kept outside the project: without them these tests say so and pass.
#include "made_files.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <ctime>
#include <filesystem>

using namespace lacuna;

namespace {

const std::string kShared = std::string(LACUNA_SOURCE_DIR) + "/../shared/data/";

bool missing(const std::string& file)
{
    if (std::filesystem::exists(kShared + file)) return false;
    MESSAGE("skipped: there is no " << kShared + file);
    return true;
}

/// A face as Open CASCADE measures it.
struct Measured {
    const char* file;
    int tag;
    const char* kind;
    double area;
    Vec3 centre;
};

const std::vector<Measured> kMeasured{
    {"cad/tuyau_bent_pipe.brep", 4, "bspline", 823.696331, {37.46402, 16.31917, -1.94242}},
    {"cad/tuyau_bent_pipe.brep", 1, "bspline", 1029.782777, {37.45287, 16.34334, -2.42809}},
    {"cad/tuyau_bent_pipe.brep", 3, "plane", 5.654867, {0, 0, -1.15063}},
    {"cad/mambo_S24.step", 12, "cylinder", 706.858347, {-45, 9.5493, 67.5}},
    {"cad/mambo_S24.step", 18, "cylinder", 4146.902303, {14.00563, 0, 0}},
    {"cad/mambo_S24.step", 20, "cylinder", 1413.716694, {-5, 0, 95.4507}},
    {"cad/7pin.step", 45, "plane", 1495.398103, {0, 0, 90}},
    {"cad/7pin.step", 2, "plane", 314.159265, {0, 0, 100}},
    {"cad/holycyl.stp", 11, "plane", 11.780972, {0, 0, -0.5}},
    {"cad/Welle_stepped_shaft.step", 10, "plane", 314.159265, {80, 0, 0}},
};

struct Solid {
    const char* file;
    std::size_t faces, edges;
};

const std::vector<Solid> kSolids{{"cad/tuyau_bent_pipe.brep", 8, 16},
                                 {"cad/mambo_S24.step", 24, 65},
                                 {"cad/7pin.step", 70, 84},
                                 {"cad/holycyl.stp", 12, 30},
                                 {"cad/Welle_stepped_shaft.step", 11, 15}};

} // namespace

TEST_CASE("faces of real CAD files have the tags, kinds, areas and centres Open CASCADE measures")
{
    for (const Measured& m : kMeasured) {
        if (missing(m.file)) continue;
        CAPTURE(m.file);
        CAPTURE(m.tag);
        const topology::Model model = cad::load({kShared + m.file});
        const auto face = std::find_if(model.faces.begin(), model.faces.end(),
                                       [&](const auto& f) { return f.tag == m.tag; });
        REQUIRE(face != model.faces.end());
        const FaceId id(std::size_t(face - model.faces.begin()));
        CHECK(face->kind == m.kind);
        CHECK(topology::face_area(model, id) == doctest::Approx(m.area).epsilon(0.01));
        CHECK((topology::face_centroid(model, id) - m.centre).norm() < 1e-3 * model.diagonal);
    }
}

TEST_CASE("real solids are closed, their edges shared, and load in well under two seconds")
{
    for (const Solid& solid : kSolids) {
        if (missing(solid.file)) continue;
        CAPTURE(solid.file);
        // The processor's own time: what else the machine does is not the loader's.
        const std::clock_t start = std::clock();
        const topology::Model model = cad::load({kShared + solid.file});
        CHECK(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC < 2);
        test::check_model(model);
        CHECK(model.faces.size() == solid.faces);
        CHECK(model.edges.size() == solid.edges);
        for (const int uses : test::uses_of_edges(model)) CHECK(uses == 2);
        CHECK(test::enclosed_volume(model) > 0);
    }
}

TEST_CASE("projection puts facet centres of real faces on the surface, close to where they were")
{
    for (const Solid& solid : kSolids) {
        if (missing(solid.file)) continue;
        CAPTURE(solid.file);
        const topology::Model model = cad::load({kShared + solid.file});
        for (const topology::Face& face : model.faces) {
            CAPTURE(face.tag);
            std::vector<Vec3> points;
            std::vector<Vec2> uv;
            for (std::size_t t = 0; t < face.triangles.size(); ++t) {
                const Triangle& f = face.triangles[t];
                points.push_back((model.at(f[0]) + model.at(f[1]) + model.at(f[2])) / 3);
                uv.push_back((face.uv[t][0] + face.uv[t][1] + face.uv[t][2]) / 3);
            }
            const std::vector<Vec3> before = points;
            face.surface->project(points, uv);
            std::vector<Vec3> again = points;
            face.surface->project(again, uv);
            for (std::size_t i = 0; i < points.size(); ++i) {
                CHECK((again[i] - points[i]).norm() < 1e-9 * model.diagonal);
                CHECK((points[i] - before[i]).norm() < 2e-3 * model.diagonal);
            }
        }
    }
}

TEST_CASE("real facet and FE files are read with their parts")
{
    struct Case {
        std::string file;
        std::size_t faces, quads;
        double area;
    };
    for (const Case& c : {Case{"fem/nested_cubes.msh", 12, 0, 7.5}, Case{"fem/salome_cube.unv", 6, 150, 6}}) {
        if (missing(c.file)) continue;
        CAPTURE(c.file);
        const topology::Model model = cad::load({kShared + c.file});
        test::check_model(model);
        CHECK(model.faces.size() == c.faces);
        CHECK(test::total_area(model) == doctest::Approx(c.area).epsilon(1e-3));
        std::size_t quads = 0;
        for (const topology::Face& face : model.faces) quads += face.given_quads.size();
        CHECK(quads == c.quads);
    }
    for (const char* file : {"stl/bracket_01.stl", "stl/hollow_brick_2x4.stl"}) {
        if (missing(file)) continue;
        const topology::Model model = cad::load({kShared + file});
        test::check_model(model);
        CHECK(model.faces.size() > 6);
        for (const int uses : test::uses_of_edges(model)) CHECK(uses == 2);
        CHECK(test::enclosed_volume(model) > 0);
    }
    if (missing("fem/nested_cubes.msh")) return;
    // The inner top is surface 8 of the file.
    const topology::Model cubes = cad::load({kShared + "fem/nested_cubes.msh"});
    const auto top = std::find_if(cubes.faces.begin(), cubes.faces.end(),
                                  [](const auto& f) { return f.tag == 8; });
    REQUIRE(top != cubes.faces.end());
    CHECK((topology::face_centroid(cubes, FaceId(std::size_t(top - cubes.faces.begin()))) -
           Vec3(0.5, 0.5, 0.75))
              .norm() < 1e-9);
}
