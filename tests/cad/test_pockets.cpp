// SPDX-License-Identifier: GPL-2.0-or-later
#include "made_files.h"
#include "support/check_valid.h"

#include <lacuna/cad/load.h>
#include <lacuna/closure/close.h>
#include <lacuna/closure/shared/cavities.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

#include <numbers>

using namespace lacuna;
using namespace lacuna::topology;

TEST_CASE("a box with a round pocket or boss in its top has the pocket or boss in its mesh")
{
    const test::TempFolder folder;
    const double disc = std::numbers::pi * 0.36;
    for (const bool pocket : {true, false}) {
        const std::string way = pocket ? "BooleanDifference" : "BooleanUnion";
        const std::string script = "SetFactory(\"OpenCASCADE\");\nBox(1)={0,0,0,2,2,2};\n"
                                   "Cylinder(2)={1,1,1.8,0,0,0.4,0.6};\n" +
                                   way + "(3)={ Volume{1}; Delete; }{ Volume{2}; Delete; };\n";
        const Model model = cad::load({folder.write("top.geo", script)});
        Roles roles;
        for (std::size_t f = 0; f < model.faces.size(); ++f) {
            const Vec3 normal = face_area_vector(model, FaceId(f)).stableNormalized();
            const Vec3 centre = face_centroid(model, FaceId(f));
            const bool side = model.faces[f].kind == "plane" && std::abs(normal.z()) < 0.5;
            (side ? roles.walls : centre.z() < 1 ? roles.source : roles.target).emplace_back(f);
        }
        REQUIRE(roles.target.size() == 3);
        OpenVolume volume = open_volume(model, roles);
        volume = closure::close(volume, {}).volume;
        const double exact = 8 + (pocket ? -1 : 1) * disc * 0.2;
        for (const double size : {0.4, 0.25, 0.12}) {
            CAPTURE(pocket);
            CAPTURE(size);
            sweep::SweepOptions options;
            options.layers.count = 8;
            options.size = [size](const Vec3&) { return size; };
            const sweep::Swept swept = sweep::sweep(volume, options);
            test::check_valid(swept.mesh);
            CHECK(swept.min_scaled_jacobian >= 0.2);
            // Chords of the circle lose a share of the disc, less than a tenth at ten sides.
            CHECK(std::abs(quality::measure(swept.mesh).volume - exact) < 0.1 * disc * 0.2);
        }
    }
}

TEST_CASE("voids of one face within a solid are listed as inner voids, with the bodies in them")
{
    const test::TempFolder folder;
    const double pi = std::numbers::pi;
    for (const double radius : {0.5, 1.0, 1.5}) {
        const std::string r = std::to_string(radius);
        const std::vector<std::pair<std::string, double>> shapes{
            {"Sphere(2)={0,0,0," + r + "};\n", 4 * pi * std::pow(radius, 3) / 3},
            {"Torus(2)={0,0,0," + r + ",0.3};\n", 2 * pi * pi * radius * 0.09}};
        for (const auto& [shape, exact] : shapes) {
            for (const bool loose : {false, true}) {
                CAPTURE(shape);
                CAPTURE(loose);
                const std::string script =
                    "SetFactory(\"OpenCASCADE\");\nBox(1)={-3,-3,-3,6,6,6};\n" + shape +
                    "BooleanDifference(3)={ Volume{1}; Delete; }{ Volume{2}; Delete; };\n" +
                    (loose ? "Sphere(4)={" + r + "-0.1,0,0,0.05};\n" : "");
                const Model model = cad::load({folder.write("void.geo", script)});
                const auto found = closure::cavities(model);
                REQUIRE(found.size() == 1);
                CHECK(found[0].kind == "inner void");
                CHECK(found[0].faces.size() == (loose ? 2 : 1));
                CHECK(found[0].has_bodies == loose);
                CHECK(found[0].volume == doctest::Approx(exact).epsilon(0.05));
            }
        }
    }
}

TEST_CASE("a counterbore is meshed from its wall and its floor, which has the narrower bore in it")
{
    const test::TempFolder folder;
    for (const double depth : {0.1, 0.5, 1.5}) {
        for (const double narrow : {0.2, 0.7, 0.95}) {
            CAPTURE(depth);
            CAPTURE(narrow);
            const std::string script =
                "SetFactory(\"OpenCASCADE\");\nBox(1)={-2,-2,0,4,4,2};\nCylinder(2)={0,0,2,0,0,-" +
                std::to_string(depth) + ",1};\nCylinder(3)={0,0,-1,0,0,4," + std::to_string(narrow) +
                "};\nBooleanDifference(4)={ Volume{1}; Delete; }{ Volume{2,3}; Delete; };\n";
            const Model model = cad::load({folder.write("bore.geo", script)});
            Roles roles;
            for (std::size_t f = 0; f < model.faces.size(); ++f) {
                const double z = face_centroid(model, FaceId(f)).z();
                const bool floor = model.faces[f].kind == "plane" && std::abs(z - 2 + depth) < 1e-6 &&
                                   model.faces[f].loops.size() == 2;
                const bool wall = model.faces[f].kind == "cylinder" && std::abs(z - 2 + depth / 2) < 1e-3;
                if (floor || wall) roles.walls.emplace_back(f);
            }
            REQUIRE(roles.walls.size() == 2);
            OpenVolume volume = open_volume(model, roles);
            volume = closure::close(volume, {}).volume;
            sweep::SweepOptions options;
            options.layers.count = 4;
            options.size = [](const Vec3&) { return 0.25; };
            const sweep::Swept swept = sweep::sweep(volume, options);
            test::check_valid(swept.mesh);
            CHECK(swept.min_scaled_jacobian >= 0.2);
            CHECK(quality::measure(swept.mesh).volume ==
                  doctest::Approx(std::numbers::pi * depth).epsilon(0.03));
        }
    }
}

TEST_CASE("a round groove across an end gets the sides that the volume needs, and not many more")
{
    const test::TempFolder folder;
    for (const double radius : {0.5, 1.0, 1.8}) {
        for (const double height : {2.5, 5.0, 10.0}) {
            CAPTURE(radius);
            CAPTURE(height);
            const std::string script =
                "SetFactory(\"OpenCASCADE\");\nBox(1)={-2,0,0,4,4," + std::to_string(height) +
                "};\nCylinder(2)={0,-1,0,0,6,0," + std::to_string(radius) +
                "};\nBooleanDifference(3)={ Volume{1}; Delete; }{ Volume{2}; Delete; };\n";
            const Model model = cad::load({folder.write("groove.geo", script)});
            Roles roles;
            for (std::size_t f = 0; f < model.faces.size(); ++f) {
                const double z = face_centroid(model, FaceId(f)).z();
                const bool source = std::abs(z - height) < 1e-6;
                const bool target = std::abs(z) < 1e-6 || model.faces[f].kind == "cylinder";
                (source ? roles.source : target ? roles.target : roles.walls).emplace_back(f);
            }
            REQUIRE(roles.target.size() >= 3);
            const OpenVolume volume = open_volume(model, roles);
            sweep::SweepOptions options, any;
            options.size = any.size = [](const Vec3&) { return 2; };
            any.volume_share = 0;
            const sweep::Swept swept = sweep::sweep(volume, options), coarse = sweep::sweep(volume, any);
            test::check_valid(swept.mesh);
            const double exact = 4 * (4 * height - std::numbers::pi * radius * radius / 2);
            const double off = quality::measure(swept.mesh).volume / exact - 1;
            CHECK(std::abs(off) <= options.volume_share);
            if (swept.mesh.quads.size() > coarse.mesh.quads.size()) CHECK(off > options.volume_share / 3);
        }
    }
}
