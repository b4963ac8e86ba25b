// SPDX-License-Identifier: GPL-2.0-or-later
//
// Files whose faces do not fit: loose, shifted, divided differently, listed twice, turned over.
#include "made_files.h"
#include "support/check_valid.h"
#include "support/dirt.h"

#include <lacuna/closure/close.h>
#include <lacuna/healing/shared/stitch.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

using namespace lacuna;
namespace occ = gmsh::model::occ;

namespace {

/// Signed areas of facets in the parameters of their face agree: none is folded over its neighbours.
void check_unfolded(const topology::Model& model)
{
    for (const topology::Face& face : model.faces) {
        CAPTURE(face.tag);
        int up = 0, down = 0;
        for (const auto& uv : face.uv) {
            const Vec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
            const double area = a.x() * b.y() - a.y() * b.x();
            const double size = std::max(a.squaredNorm(), b.squaredNorm());
            up += area > 1e-6 * size;
            down += area < -1e-6 * size;
        }
        CHECK(std::min(up, down) == 0);
    }
}

void check_same_skin(topology::Model model, const topology::Model& whole, const healing::StitchReport& report)
{
    for (const Message& note : report.notes) MESSAGE(note.text());
    CHECK(report.notes.empty());
    test::check_model(model);
    check_unfolded(model);
    for (const int uses : test::uses_of_edges(model)) CHECK(uses == 2);
    CHECK(model.faces.size() == whole.faces.size());
    topology::orient_consistently(model);
    CHECK(test::enclosed_volume(model) == doctest::Approx(test::enclosed_volume(whole)).epsilon(2e-3));
}

/// A whole model in pieces, with other dirt by the bits of `dirt`, is stitched to what it was.
void check_stitched(const topology::Model& whole, unsigned dirt)
{
    topology::Model model = test::exploded(whole);
    if ((dirt & 1U) != 0) test::divide_sides(model, dirt + 7);
    if ((dirt & 2U) != 0) test::divide_edges(model, 3);
    if ((dirt & 4U) != 0) test::shake(model, 0.4 * whole.tolerance, dirt);
    check_same_skin(model, whole, healing::stitch(model, whole.tolerance));
}

} // namespace

TEST_CASE("exact faces in pieces, divided differently and shaken, are stitched to the skin they came from")
{
    const test::TempFolder folder;
    for (const test::KnownShape& shape : test::known_shapes()) {
        const topology::Model whole = cad::load({folder.gmsh("whole.brep", shape.build)});
        for (unsigned dirt = 0; dirt < 8; ++dirt) {
            CAPTURE(shape.name);
            CAPTURE(dirt);
            check_stitched(whole, dirt);
        }
    }
    const std::string shared = std::string(LACUNA_SOURCE_DIR) + "/../shared/data/cad/";
    for (const char* file :
         {"tuyau_bent_pipe.brep", "mambo_S24.step", "7pin.step", "holycyl.stp", "Welle_stepped_shaft.step"}) {
        if (!std::filesystem::exists(shared + file)) {
            MESSAGE("skipped: there is no " << shared + file);
            continue;
        }
        const topology::Model whole = cad::load({shared + file});
        for (unsigned dirt = 0; dirt < 8; ++dirt) {
            CAPTURE(file);
            CAPTURE(dirt);
            check_stitched(whole, dirt);
        }
    }
}

namespace {

constexpr double kTolerance = 1e-3;

/// A flat face of its own with straight sides, shifted as a whole by less than half the tolerance.
void plate(const std::vector<Vec3>& corners, int& seed)
{
    const double turn = 2.4 * ++seed;
    const Vec3 shift = 0.3 * kTolerance * Vec3(std::cos(turn), std::sin(turn), std::cos(3 * turn));
    std::vector<int> points, lines;
    for (const Vec3& c : corners)
        points.push_back(occ::addPoint(c.x() + shift.x(), c.y() + shift.y(), c.z() + shift.z()));
    for (std::size_t i = 0; i < points.size(); ++i)
        lines.push_back(occ::addLine(points[i], points[(i + 1) % points.size()]));
    occ::addPlaneSurface({occ::addCurveLoop(lines)});
}

/// A block of 2 × 1 × 1 as nobody should write one: a bottom in two, a top listed twice and turned over the
/// second time, a wall with a corner cut off by less than the tolerance, everything loose and shifted.
void dirty_block()
{
    int seed = 0;
    plate({{0, 0, 0}, {0, 1, 0}, {1.2, 1, 0}, {1.2, 0, 0}}, seed);
    plate({{1.2, 0, 0}, {1.2, 1, 0}, {2, 1, 0}, {2, 0, 0}}, seed);
    plate({{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {0, 1, 1}}, seed);
    plate({{0, 1, 1}, {2, 1, 1}, {2, 0, 1}, {0, 0, 1}}, seed);
    plate({{0, 0, 0}, {2, 0, 0}, {2, 0, 1 - 0.4 * kTolerance}, {2 - 0.4 * kTolerance, 0, 1}, {0, 0, 1}},
          seed);
    plate({{0, 1, 0}, {2, 1, 0}, {2, 1, 1}, {0, 1, 1}}, seed); // inward
    plate({{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, seed);
    plate({{2, 0, 0}, {2, 1, 0}, {2, 1, 1}, {2, 0, 1}}, seed);
}

FaceId face_near(const topology::Model& model, const Vec3& centre)
{
    FaceId best(0UL);
    for (std::size_t f = 1; f < model.faces.size(); ++f) {
        if ((topology::face_centroid(model, FaceId(f)) - centre).norm() <
            (topology::face_centroid(model, best) - centre).norm()) {
            best = FaceId(f);
        }
    }
    return best;
}

/// From the faces to the hexes; every step proves what it made.
void check_sweeps(const topology::Model& model, const topology::Roles& roles, double volume, double error)
{
    const topology::OpenVolume open = topology::open_volume(model, roles);
    const topology::VolumeClass value = topology::classify(open).value;
    const bool two_ends = value != topology::VolumeClass::IV && value != topology::VolumeClass::V;
    const closure::Closed closed = closure::close(open, two_ends ? matching::match(open) : matching::Match{});
    CHECK(closed.closure.watertight);
    CHECK(closure::enclosed_volume(closed.volume) == doctest::Approx(volume).epsilon(error));
    sweep::SweepOptions options;
    options.layers.count = 4;
    test::check_valid(sweep::sweep(closed.volume, options).mesh);
}

} // namespace

TEST_CASE("a block of loose, shifted, divided, repeated and turned faces is swept, whichever wall is missing")
{
    const test::TempFolder folder;
    for (const char* file : {"block.step", "block.brep"}) {
        CAPTURE(file);
        const topology::Model model = cad::load({folder.gmsh(file, dirty_block)}, {.tolerance = kTolerance});
        test::check_model(model);
        check_unfolded(model);
        CHECK(model.faces.size() == 7);
        CHECK(model.edges.size() == 15);
        CHECK(model.vertices.size() == 10);
        for (const int uses : test::uses_of_edges(model)) CHECK(uses == 2);
        REQUIRE(model.notes.size() == 1);
        CHECK(model.notes[0].text().find("face 3") != std::string::npos);
        CHECK(model.notes[0].text().find("face 4") < model.notes[0].text().find("face 3"));

        const std::vector<Vec3> walls{{1, 0, 0.5}, {1, 1, 0.5}, {0, 0.5, 0.5}, {2, 0.5, 0.5}};
        for (std::size_t missing = 0; missing <= walls.size(); ++missing) {
            CAPTURE(missing);
            topology::Roles roles;
            roles.source = {face_near(model, {0.6, 0.5, 0}), face_near(model, {1.6, 0.5, 0})};
            roles.target = {face_near(model, {1, 0.5, 1})};
            for (std::size_t w = 0; w < walls.size(); ++w)
                if (w != missing) roles.walls.push_back(face_near(model, walls[w]));
            check_sweeps(model, roles, 2, 1e-2);
        }
    }
}

TEST_CASE(
    "a can of loose faces, its rims begun anywhere and a face of it listed twice, is swept without its lid")
{
    const test::TempFolder folder;
    for (const double turn : {0.0, 0.7, 2.0}) {
        CAPTURE(turn);
        const topology::Model model = cad::load(
            {folder.gmsh("can.step",
                         [&] {
                             const int disc = occ::addDisk(0, 0, 0, 1, 1);
                             const int again = occ::addDisk(0, 0, 0, 1, 1);
                             occ::rotate({{2, again}}, 0, 0, 0, 0, 0, 1, 1.1);
                             const int circle = occ::addCircle(0, 0, 0, 1);
                             occ::rotate({{1, circle}}, 0, 0, 0, 0, 0, 1, turn);
                             gmsh::vectorpair out;
                             occ::extrude({{1, circle}}, 0, 0, 2, out);
                             (void)disc;
                         })},
            {.tolerance = kTolerance});
        test::check_model(model);
        CHECK(model.faces.size() == 2);
        CHECK(model.notes.size() == 1);
        const FaceId bottom = face_near(model, {0, 0, 0});
        check_sweeps(model, {{bottom}, {}, {face_near(model, {0, 0, 1})}}, 2 * std::numbers::pi, 1e-2);
    }
}

TEST_CASE("edges that part between their ends are not sewn in silence")
{
    const test::TempFolder folder;
    for (const double bulge : {0.3, 5.0}) {
        CAPTURE(bulge);
        const topology::Model model = cad::load(
            {folder.gmsh(
                "parting.brep",
                [&] {
                    occ::addRectangle(0, 0, 0, 1, 1);
                    std::vector<int> p;
                    for (const auto& [x, y] : {std::pair(1.0, 0.0), {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}})
                        p.push_back(occ::addPoint(x, y, 0));
                    const int middle = occ::addPoint(1 + bulge * kTolerance, 0.5, 0);
                    occ::addPlaneSurface({occ::addCurveLoop(
                        {occ::addLine(p[0], p[1]), occ::addLine(p[1], p[2]), occ::addLine(p[2], p[3]),
                         occ::addSpline({p[3], middle, p[0]})})});
                })},
            {.tolerance = kTolerance});
        test::check_model(model);
        const std::vector<int> uses = test::uses_of_edges(model);
        CHECK(std::count(uses.begin(), uses.end(), 2) == (bulge < 1 ? 1 : 0));
        REQUIRE(model.notes.size() == (bulge < 1 ? 0U : 1U));
        if (bulge > 1) CHECK(model.notes[0].text().find("a gap of 0.005") != std::string::npos);
    }
}

TEST_CASE("faces of a CAD file and of a facet file are joined")
{
    const test::TempFolder folder;
    const std::string cad_file = folder.gmsh("open.step", [] {
        occ::addBox(0, 0, 0, 1, 1, 1);
        occ::synchronize();
        gmsh::vectorpair solids, faces;
        occ::getEntities(solids, 3);
        occ::remove(solids, false);
        occ::getEntities(faces, 2);
        occ::remove({faces.back()}, false);
    });
    // The lid as facets that have a point amid a side.
    const std::string facets = folder.write(
        "lid.obj", "v 0 0 1\nv 1 0 1\nv 1 0.4 1\nv 1 1 1\nv 0 1 1\nf 1 2 3\nf 1 3 4\nf 1 4 5\n");
    const topology::Model model = cad::load({cad_file, facets});
    test::check_model(model);
    CHECK(model.faces.size() == 6);
    for (const int uses : test::uses_of_edges(model)) CHECK(uses == 2);
}
