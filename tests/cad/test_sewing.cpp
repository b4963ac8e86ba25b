// SPDX-License-Identifier: GPL-2.0-or-later
#include "made_files.h"

#include <lacuna/topology/shared/left_out.h>

#include <doctest/doctest.h>
#include <gmsh.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <utility>

using namespace lacuna;
namespace occ = gmsh::model::occ;

namespace {

/// The six faces of a box, each by itself: its edges are arcs of its own, up to half of `share` of their
/// length beside the straight line.
void add_bent_faces(const Vec3& size, double share, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(-1, 1);
    const auto corner = [&](int c) { return Vec3(c & 1, c >> 1 & 1, c >> 2 & 1).cwiseProduct(size).eval(); };
    for (const std::array<int, 4>& face :
         {std::array{0, 1, 3, 2}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4}, std::array{2, 3, 7, 6},
          std::array{0, 2, 6, 4}, std::array{1, 3, 7, 5}}) {
        std::vector<int> points, curves;
        for (const int c : face) points.push_back(occ::addPoint(corner(c).x(), corner(c).y(), corner(c).z()));
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3 a = corner(face[k]), b = corner(face[(k + 1) % 4]);
            const Vec3 across = (b - a).unitOrthogonal() * (b - a).norm() * share / 2 * part(random);
            const Vec3 middle = (a + b) / 2 + across;
            curves.push_back(occ::addSpline(
                {points[k], occ::addPoint(middle.x(), middle.y(), middle.z()), points[(k + 1) % 4]}));
        }
        occ::addSurfaceFilling(occ::addWire(curves));
    }
}

} // namespace

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

TEST_CASE(
    "faces whose edges part by less than a hundredth between their ends are sewn where no tolerance is given")
{
    const test::TempFolder folder;
    std::mt19937 random(9);
    for (unsigned trial = 0; trial < 22; ++trial) {
        CAPTURE(trial);
        const auto length = [&] { return 1 + static_cast<double>(random() % 8) / 2; };
        const Vec3 size(length(), length(), length());
        const double share = 0.001 + 0.0085 * trial / 21;
        const std::string path = folder.gmsh("bent.brep", [&] { add_bent_faces(size, share, trial); });
        std::vector<std::string> told;
        RunContext context;
        context.log = [&](std::string_view line) { told.emplace_back(line); };
        const topology::Model model = cad::load({path}, {}, context);
        test::check_model(model);
        CHECK(model.faces.size() == 6);
        CHECK(model.vertices.size() == 8);
        CHECK(model.edges.size() == 12);
        for (const int uses : test::uses_of_edges(model)) CHECK(uses == 2);
        topology::Model skin = model;
        topology::orient_consistently(skin);
        CHECK(test::enclosed_volume(skin) == doctest::Approx(size.prod()).epsilon(4 * share));
        const auto sewn = [](const std::string& line) {
            return line.find("were merged into the first") != line.npos;
        };
        const auto notes = std::ranges::count(model.notes, "healing.edges_sewn", &Message::code);
        CHECK(notes > 6);
        CHECK(std::ranges::count_if(told, sewn) == notes);
        for (const std::string& line : told) CHECK((!sewn(line) || line.starts_with("note: edge ")));
        // Points of an edge that is exact lie on its curve.
        for (const topology::Edge& edge : model.edges) {
            std::vector<Vec3> at(edge.points.size());
            edge.curve->evaluate(edge.params, at, {});
            for (std::size_t i = 0; i < at.size(); ++i)
                CHECK((at[i] - model.at(edge.points[i])).norm() < 1e-6 * model.diagonal);
        }
        // A tolerance is the user's own word.
        const topology::Model apart = cad::load({path}, {.tolerance = 1e-5 * size.norm()});
        CHECK(apart.edges.size() > 18);
    }
    // Further apart they are a gap, which is told.
    const std::string path = folder.gmsh("wide.brep", [&] { add_bent_faces({2, 3, 4}, 0.2, 3); });
    const topology::Model wide = cad::load({path});
    CHECK(wide.edges.size() > 18);
    CHECK(std::ranges::count(wide.notes, "healing.gap", &Message::code) > 0);
}

TEST_CASE("two edges of one thin face, and three edges between the same ends, are not sewn by their vertices")
{
    const test::TempFolder folder;
    const auto arc = [](double x, double height) {
        const int a = occ::addPoint(0, 0, 0), m = occ::addPoint(1, x, height), b = occ::addPoint(2, 0, 0);
        return occ::addSpline({a, m, b});
    };
    // A lens of one hundredth and a half.
    const topology::Model lens = cad::load({folder.gmsh("lens.brep", [&] {
        occ::addPlaneSurface({occ::addCurveLoop({arc(-0.008, 0), arc(0.008, 0)})});
    })});
    CHECK(lens.faces.size() == 1);
    CHECK(lens.edges.size() == 2);
    // Three flaps from nearly the same line: which two meet is ambiguous.
    const topology::Model flaps = cad::load({folder.gmsh("flaps.brep", [&] {
        for (int k = 0; k < 3; ++k) {
            gmsh::vectorpair out;
            occ::extrude({{1, arc(0.004 * (k - 1), 0)}}, 0, k - 1, 1 - std::abs(k - 1), out);
        }
    })});
    CHECK(flaps.faces.size() == 3);
    for (const int uses : test::uses_of_edges(flaps)) CHECK(uses == 1);
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

TEST_CASE("a face no wider than the tolerance is left out, and its neighbours are joined")
{
    const test::TempFolder folder;
    for (const double width : {2e-7, 5e-7, 9e-7}) {
        CAPTURE(width);
        const std::string path = folder.gmsh("sliver.brep", [&] {
            occ::addRectangle(0, 0, 0, 1, 1);
            occ::addRectangle(1, 0, 0, width, 1);
            occ::addRectangle(1 + width, 0, 0, 1, 1);
        });
        const topology::Model model = cad::load({path}, {.tolerance = 1e-6});
        test::check_model(model);
        REQUIRE(model.faces.size() == 2);
        CHECK(model.faces[0].tag == 1);
        CHECK(model.faces[1].tag == 3);
        CHECK(model.edges.size() == 7);
        REQUIRE(model.notes.size() == 1);
        CHECK(model.notes[0].text().starts_with("face 2 is narrower than the tolerance and is left out"));
    }
}

TEST_CASE("a face whose boundary runs over itself is left out by name, and the others are read as they are")
{
    const test::TempFolder folder;
    const auto outline = [](const std::vector<Vec2>& corners) {
        std::vector<int> points, lines;
        for (const Vec2& p : corners) points.push_back(occ::addPoint(p.x(), p.y(), 0));
        for (std::size_t i = 0; i < points.size(); ++i)
            lines.push_back(occ::addLine(points[i], points[(i + 1) % points.size()]));
        occ::addPlaneSurface({occ::addCurveLoop(lines)});
    };
    const auto box = [] { occ::addBox(20, 0, 0, 1, 2, 3); };
    const topology::Model sound = cad::load({folder.gmsh("sound.brep", [&] {
        box();
        outline({{0, 0}, {6, 0}, {6, 12}, {0, 12}});
    })});
    const std::vector<std::vector<Vec2>> outlines{
        {{0, 0}, {6, 0}, {6, 12}, {0, 12}, {0, 10}, {6, 10}, {6, 2}, {0, 2}}, // a bracket without a back
        {{0, 0}, {6, 12}, {6, 0}, {0, 12}}};                                  // a bow tie
    for (const std::vector<Vec2>& corners : outlines) {
        const std::string path = folder.gmsh("crossing.brep", [&] {
            box();
            outline(corners);
        });
        const topology::Model model = cad::load({path});
        test::check_model(model);
        CHECK(model.faces.size() == 6);
        CHECK(model.edges.size() == 12);
        for (std::size_t e = 0; e < model.edges.size(); ++e)
            CHECK(model.edges[e].points.size() == sound.edges[e].points.size());
        CHECK(test::enclosed_volume(model) == doctest::Approx(6));
        REQUIRE(model.notes.size() == 1);
        CHECK(model.notes[0].text().starts_with("face 7 could not be triangulated"));

        const std::string only = folder.gmsh("only.brep", [&] { outline(corners); });
        CHECK_THROWS_AS((void)cad::load({only}), BackendError);
    }
}

TEST_CASE("a face left out is known by the edges it had, in every model taken out of the one that was loaded")
{
    const test::TempFolder folder;
    // A box whose back, y = 2, has a hole that crosses its border.
    const auto box = [](bool crossing) {
        const std::array<Vec3, 8> corners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 2, 0), Vec3(0, 2, 0),
                                          Vec3(0, 0, 3), Vec3(1, 0, 3), Vec3(1, 2, 3), Vec3(0, 2, 3)};
        std::vector<int> points;
        for (const Vec3& p : corners) points.push_back(occ::addPoint(p.x(), p.y(), p.z()));
        std::map<std::pair<int, int>, int> lines;
        const auto loop = [&](const std::vector<int>& at) {
            std::vector<int> around;
            for (std::size_t i = 0; i < at.size(); ++i) {
                const int a = at[i], b = at[(i + 1) % at.size()];
                int& line = lines[std::minmax(a, b)];
                if (line == 0) line = occ::addLine(a, b);
                around.push_back(line);
            }
            return occ::addCurveLoop(around);
        };
        const std::vector<std::array<int, 4>> sides{{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                    {1, 2, 6, 5}, {3, 0, 4, 7}, {2, 3, 7, 6}};
        for (const std::array<int, 4>& side : sides) {
            std::vector<int> at, loops;
            for (const int corner : side) at.push_back(points[static_cast<std::size_t>(corner)]);
            loops.push_back(loop(at));
            if (crossing && side[0] == 2) {
                std::vector<int> hole;
                for (const Vec2& p : {Vec2(0.4, 1), Vec2(0.6, 1), Vec2(0.6, 3.5), Vec2(0.4, 3.5)})
                    hole.push_back(occ::addPoint(p.x(), 2, p.y()));
                loops.push_back(loop(hole));
            }
            occ::addPlaneSurface(loops);
        }
    };
    const auto all_but = [](const topology::Model& model, int tag) {
        std::vector<FaceId> faces;
        for (std::size_t f = 0; f < model.faces.size(); ++f)
            if (model.faces[f].tag != tag) faces.emplace_back(f);
        return faces;
    };
    const topology::Model sound = cad::load({folder.gmsh("sound.brep", [&] { box(false); })});
    CHECK(topology::left_out_beside(sound, all_but(sound, 6)).empty());

    for (const bool loose : {false, true}) {
        CAPTURE(loose);
        const auto build = [&] { box(true); };
        const std::string path = loose ? folder.loose("loose.brep", build) : folder.gmsh("whole.brep", build);
        std::vector<std::string> told;
        RunContext context;
        context.log = [&](std::string_view line) { told.emplace_back(line); };
        const topology::Model model = cad::load({path}, {}, context);
        test::check_model(model);
        REQUIRE(model.faces.size() == 5);
        const auto is_note = [](const std::string& line) { return line.starts_with("note: face 6 could"); };
        CHECK(std::ranges::count_if(told, is_note) == 1);

        const auto missing = topology::left_out_beside(model, all_but(model, 0));
        REQUIRE(missing.size() == 1);
        CHECK(missing[0].face.tag == 6);
        CHECK(missing[0].edges.size() == 4);
        CHECK_THROWS_AS(topology::require_none_left_out(model, all_but(model, 0), "walls"), InvalidInput);
        // The front touches no edge of the back.
        CHECK(topology::left_out_beside(model, {FaceId(2)}).empty());

        const topology::OpenVolume volume = topology::open_volume(
            model, {{FaceId(0)}, {FaceId(1)}, {FaceId(2), FaceId(3), FaceId(4)}});
        const std::vector<std::string> words = topology::left_out_in_words(volume);
        REQUIRE(words.size() == 1);
        CHECK(words[0].starts_with("face 6 of " + path + " was left out"));
    }
}
