// SPDX-License-Identifier: GPL-2.0-or-later
#include "made_files.h"
#include "support/folder.h"
#include "support/refusal.h"
#include "support/volumes.h"
#include "support/whole_families.h"

#include <lacuna/cad/write_cad.h>
#include <lacuna/cad_worker/session.h>
#include <lacuna/closure/close.h>
#include <lacuna/io/facets.h>
#include <lacuna/matching/match.h>

#include <doctest/doctest.h>
#include <gmsh.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <thread>

using namespace lacuna;
using test::refusal;
namespace occ = gmsh::model::occ;

namespace {

const std::string kSharedFiles = std::string(LACUNA_SOURCE_DIR) + "/../shared/data/";

/// Faces by tag, as a recipe names them.
struct Tags {
    std::vector<int> source, target, walls;
};

topology::OpenVolume opened(const topology::Model& model, const Tags& tags)
{
    const auto ids = [&](const std::vector<int>& wanted) {
        std::vector<FaceId> found;
        for (const int tag : wanted) {
            const auto face = std::find_if(model.faces.begin(), model.faces.end(),
                                           [&](const auto& f) { return f.tag == tag; });
            REQUIRE(face != model.faces.end());
            found.emplace_back(std::size_t(face - model.faces.begin()));
        }
        return found;
    };
    return topology::open_volume(model, {ids(tags.source), ids(tags.target), ids(tags.walls)});
}

topology::OpenVolume sealed(const topology::Model& model, const Tags& tags,
                            const closure::CloseOptions& options = {})
{
    const topology::OpenVolume volume = opened(model, tags);
    const bool ends = !volume.faces(topology::Role::source).empty() &&
                      !volume.faces(topology::Role::target).empty();
    return closure::close(volume, ends ? matching::match(volume) : matching::Match{}, options).volume;
}

/// What Gmsh finds in a file.
struct InFile {
    std::size_t solids = 0, faces = 0, edges = 0;
    double volume = 0;
};

InFile read(const std::string& path)
{
    const cad_worker::Gmsh gmsh_of_ours;
    const cad_worker::CapturedOutput silent;
    gmsh::vectorpair all;
    gmsh::model::occ::importShapes(path, all, false);
    gmsh::model::occ::synchronize();
    InFile found;
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, 3);
    found.solids = entities.size();
    for (const auto& [dim, tag] : entities) {
        double mass = 0;
        gmsh::model::occ::getMass(dim, tag, mass);
        found.volume += mass;
    }
    gmsh::model::getEntities(entities, 2);
    found.faces = entities.size();
    gmsh::model::getEntities(entities, 1);
    found.edges = entities.size();
    return found;
}

/// Tag of the face whose centre is nearest.
int face_at(const topology::Model& model, const Vec3& place)
{
    std::size_t best = 0;
    const auto distance = [&](std::size_t f) {
        return (topology::face_centroid(model, FaceId(f)) - place).norm();
    };
    for (std::size_t f = 1; f < model.faces.size(); ++f)
        if (distance(f) < distance(best)) best = f;
    return model.faces[best].tag;
}

std::size_t entries(const std::string& folder)
{
    return std::size_t(
        std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator{}));
}

/// A plate with a round and a square hole and one round corner, along z from 0 to 2.
struct Plate {
    static constexpr double kHeight = 2;
    static constexpr double pi = std::numbers::pi;
    static constexpr double kVolume = kHeight * (4 * 3 - (1 - pi / 4) - pi * 0.25 - 0.25);

    static void build()
    {
        const int box = occ::addBox(0, 0, 0, 4, 3, kHeight);
        gmsh::vectorpair out, bit;
        std::vector<gmsh::vectorpair> map;
        occ::cut({{3, box}},
                 {{3, occ::addCylinder(1.2, 1.2, 0, 0, 0, kHeight, 0.5)},
                  {3, occ::addBox(2.4, 1.7, 0, 0.5, 0.5, kHeight)}},
                 out, map, 9);
        const int corner = occ::addBox(3, 0, 0, 1, 1, kHeight);
        occ::cut({{3, corner}}, {{3, occ::addCylinder(3, 1, 0, 0, 0, kHeight, 1)}}, bit, map);
        occ::cut({{3, 9}}, bit, out, map);
    }
    /// Faces by what they are, in a model scaled.
    static std::map<std::string, int> parts(const topology::Model& model, double scale)
    {
        const auto at = [&](double x, double y, double z) { return face_at(model, scale * Vec3(x, y, z)); };
        std::map<std::string, int> tags{
            {"low", at(1.9, 1.5, 0)},    {"high", at(1.9, 1.5, 2)},  {"left", at(0, 1.5, 1)},
            {"back", at(2, 3, 1)},       {"right", at(4, 2, 1)},     {"front", at(1.5, 0, 1)},
            {"corner", at(3.7, 0.3, 1)}, {"round", at(1.2, 1.2, 1)}, {"s1", at(2.4, 1.95, 1)},
            {"s2", at(2.9, 1.95, 1)},    {"s3", at(2.65, 1.7, 1)},   {"s4", at(2.65, 2.2, 1)}};
        return tags;
    }
};

struct RealCase {
    std::string file;
    std::string name;
    Tags tags;
    double volume; ///< of the original solid, or between planes
    bool flat;     ///< every void face is flat, or ruled as what it stands for: the volume must come back
};

const std::vector<RealCase> kRealCases{
    {"tuyau_bent_pipe.brep", "pipe-V", {{}, {}, {4, 5}}, 2602.440437, true},
    {"tuyau_bent_pipe.brep", "pipewall-V", {{}, {}, {1, 2, 4, 5}}, 1463.902811, true},
    {"tuyau_bent_pipe.brep", "pipewall-I", {{4, 5}, {1, 2}, {}}, 1463.902811, true},
    {"tuyau_bent_pipe.brep", "pipewall-IV", {{3, 6}, {}, {1, 2, 4, 5}}, 1463.902811, true},
    {"tuyau_bent_pipe.brep", "pipewall-II", {{3, 6}, {7, 8}, {4, 5}}, 1463.902811, false},
    {"tuyau_bent_pipe.brep", "pipewall-III", {{3, 6}, {7, 8}, {1, 4, 5}}, 1463.902811, false},
    {"mambo_S24.step", "S24-foot-V", {{}, {}, {12, 13}}, 10602.875206, true},
    {"mambo_S24.step", "S24-hub-V", {{}, {}, {18, 19}}, 91231.85066, true},
    {"mambo_S24.step", "S24-eye-V", {{}, {}, {15, 20}}, 21205.750412, true},
    {"7pin.step", "sleeve-I", {{43}, {44}, {}}, 269171.65856, true},
    {"7pin.step", "sleeve-IV", {{45}, {}, {43, 44}}, 269171.65856, true},
    {"7pin.step", "sleeve-V", {{}, {}, {43, 44}}, 269171.65856, true},
    {"7pin.step", "sleeve-II", {{45}, {46}, {43}}, 269171.65856, true},
    {"7pin.step", "rod-I", {{2}, {3}, {}}, 62831.853072, true},
    {"7pin.step", "rod-IV", {{2}, {}, {1}}, 62831.853072, true},
    {"7pin.step", "rod-V", {{}, {}, {1}}, 62831.853072, true},
    {"holycyl.stp", "disc-I", {{11}, {12}, {}}, 11.780972451, true},
    {"holycyl.stp", "disc-II", {{11}, {12}, {1, 10, 2, 9, 3, 8, 4, 7}}, 11.780972451, true},
    {"holycyl.stp", "disc-III", {{11}, {12}, {1, 2, 3, 4, 5, 6, 7, 8, 9}}, 11.780972451, true},
    {"holycyl.stp", "disc-IIIh", {{11}, {12}, {1, 2, 3, 4, 6, 7, 8, 9, 10}}, 11.780972451, true},
    {"holycyl.stp", "disc-IV", {{11}, {}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}}, 11.780972451, true},
    {"holycyl.stp", "disc-V", {{}, {}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}}, 11.780972451, true},
    {"Welle_stepped_shaft.step", "end-IV", {{10}, {}, {9}}, 6283.185307, true},
    {"Welle_stepped_shaft.step", "journal-V", {{}, {}, {5}}, 14137.166941, true},
    {"Welle_stepped_shaft.step", "disc-V", {{}, {}, {3}}, 50265.482457, true},
};

} // namespace

TEST_CASE("volumes opened in real CAD files come back as one solid of the volume they had")
{
    const test::TempFolder folder;
    test::MembersToRun run(5); // every fifth case in each format
    for (const RealCase& c : kRealCases) {
        const std::string path = kSharedFiles + "cad/" + c.file;
        if (!std::filesystem::exists(path)) {
            MESSAGE("skipped: there is no " << path);
            continue;
        }
        CAPTURE(c.name);
        std::vector<std::string> endings;
        for (const std::string ending : {".step", ".brep"})
            if (run.next()) endings.push_back(ending);
        if (endings.empty()) continue;
        const topology::OpenVolume volume = sealed(cad::load({path}), c.tags);
        for (const std::string& ending : endings) {
            const std::string file = folder.path(c.name + ending);
            const auto start = std::chrono::steady_clock::now();
            try {
                const cad::WrittenCad written = cad::write_cad(volume, file);
                const double seconds =
                    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
                const InFile found = read(file);
                const double off = found.volume / c.volume - 1;
                MESSAGE(c.name << ending << ": " << found.solids << " solid, " << found.faces << " faces ("
                               << written.planes << " planes, " << written.fitted << " fitted), volume "
                               << found.volume << ", off by " << off << ", facets " << written.facet_volume
                               << ", sewn within " << written.tolerance << ", " << seconds << " s, "
                               << std::filesystem::file_size(file) / 1024 << " KiB");
                CHECK(found.solids == 1);
                CHECK(found.faces == written.faces);
                CHECK(found.volume == doctest::Approx(written.volume).epsilon(1e-9));
                if (c.flat) CHECK(std::abs(off) < 1e-6);
                CHECK(found.volume == doctest::Approx(written.facet_volume).epsilon(0.02));
            } catch (const Error& error) {
                FAIL_CHECK(c.name << ending << ": " << std::string(error.what()));
            }
        }
    }
}

TEST_CASE("a plate opened every way comes back to its volume: whole or in loose faces, at any scale")
{
    const test::TempFolder folder;
    const std::vector<std::pair<std::string, std::string>> files{
        {"solid", folder.gmsh("solid.step", Plate::build)},
        {"loose", folder.loose("loose.step", Plate::build)}};
    const std::vector<std::set<std::string>> ways{
        {"right", "corner"},
        {"corner"},
        {"round"},
        {"high"},
        {"s1", "s2", "s3", "s4"},
        {"low", "high"},
        {"s2"},
        {"left", "s1", "round"},
        {"left", "back", "right", "front", "corner", "round", "s1", "s2", "s3", "s4"}};
    test::MembersToRun run(4);
    for (const auto& [kind, path] : files) {
        for (const double scale : {1.0, 25.4}) {
            const topology::Model model = cad::load({path}, {.scale = scale});
            const std::map<std::string, int> parts = Plate::parts(model, scale);
            REQUIRE(model.faces.size() == parts.size());
            for (const std::set<std::string>& missing : ways) {
                if (!run.next()) continue;
                Tags tags;
                for (const auto& [name, tag] : parts)
                    if (!missing.contains(name))
                        (name == "low"    ? tags.source
                         : name == "high" ? tags.target
                                          : tags.walls)
                            .push_back(tag);
                if (tags.source.empty()) tags.source.swap(tags.target);
                CAPTURE(kind);
                CAPTURE(scale);
                CAPTURE(*missing.begin());
                const topology::OpenVolume volume = sealed(model, tags);
                const std::string file = folder.path(kind + *missing.begin() +
                                                     (scale > 1 ? ".brep" : ".stp"));
                const cad::WrittenCad written = cad::write_cad(volume, file);
                const InFile found = read(file);
                CHECK(found.solids == 1);
                CHECK(found.faces == parts.size());
                CHECK(found.edges == 30);
                CHECK(written.planes + written.fitted == missing.size());
                CHECK(found.volume == doctest::Approx(Plate::kVolume * std::pow(scale, 3)).epsilon(1e-6));
            }
        }
    }
}

TEST_CASE("a void face with part of a given edge, at a T-junction, is sewn to it")
{
    const test::TempFolder folder;
    // The long wall at y = 0 comes in two, and one of them is missing.
    const std::string path = folder.gmsh("tee.step", [] {
        const auto wall = [](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
            std::vector<int> points, lines;
            for (const Vec3& p : {a, b, c, d}) points.push_back(occ::addPoint(p.x(), p.y(), p.z()));
            for (std::size_t i = 0; i < 4; ++i) lines.push_back(occ::addLine(points[i], points[(i + 1) % 4]));
            occ::addPlaneSurface({occ::addCurveLoop(lines)});
        };
        wall({0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0});
        wall({0, 0, 2}, {4, 0, 2}, {4, 3, 2}, {0, 3, 2});
        wall({0, 0, 0}, {1.5, 0, 0}, {1.5, 0, 2}, {0, 0, 2});
        wall({4, 0, 0}, {4, 3, 0}, {4, 3, 2}, {4, 0, 2});
        wall({4, 3, 0}, {0, 3, 0}, {0, 3, 2}, {4, 3, 2});
        wall({0, 3, 0}, {0, 0, 0}, {0, 0, 2}, {0, 3, 2});
    });
    const topology::OpenVolume volume = sealed(cad::load({path}), {{1}, {2}, {3, 4, 5, 6}});
    cad::write_cad(volume, folder.path("out.step"));
    const InFile found = read(folder.path("out.step"));
    CHECK(found.solids == 1);
    CHECK(found.faces == 7);
    CHECK(found.volume == doctest::Approx(24).epsilon(1e-9));
}

TEST_CASE("a cap over a bent rim is filled close to its facets")
{
    const test::TempFolder folder;
    for (const double bore : {0.0, 0.4}) {
        CAPTURE(bore);
        // A pipe, or a rod, cut off by a sphere; the cut is missing.
        const std::string path = folder.gmsh("cut" + std::to_string(bore > 0) + ".step", [&] {
            gmsh::vectorpair out, cutters{{3, occ::addSphere(1.0, 0, 5, 2.5)}};
            std::vector<gmsh::vectorpair> map;
            if (bore > 0) cutters.emplace_back(3, occ::addCylinder(0, 0, 0, 0, 0, 5, bore));
            occ::cut({{3, occ::addCylinder(0, 0, 0, 0, 0, 5, 1)}}, cutters, out, map);
        });
        const topology::Model model = cad::load({path});
        Tags tags{{face_at(model, {0, 0, 0})}, {}, {}};
        for (const auto& face : model.faces)
            if (face.kind == "cylinder") tags.walls.push_back(face.tag);
        REQUIRE(tags.walls.size() == (bore > 0 ? 2 : 1));
        // The rim lies on a round cone as well as on the ball, so that closing asks.
        const topology::OpenVolume volume = sealed(model, tags, {.roles_by = closure::RolesBy::finding});
        const cad::WrittenCad written = cad::write_cad(volume, folder.path("out.step"));
        CHECK(written.fitted == 1);
        CHECK(read(folder.path("out.step")).solids == 1);
        CHECK(written.volume == doctest::Approx(written.facet_volume).epsilon(0.01));
    }
}

TEST_CASE("a bent duct with missing walls comes back close to what its void faces follow")
{
    const test::TempFolder folder;
    // A square turned a third of a circle about an axis beside it; as large as its centre's way is long.
    const double angle = 2 * std::numbers::pi / 3;
    const std::string path = folder.gmsh("duct.brep", [&] {
        gmsh::vectorpair out;
        occ::revolve({{2, occ::addRectangle(3, 0, 0, 1, 1)}}, 0, 0, 0, 0, 1, 0, angle, out);
    });
    const topology::Model model = cad::load({path});
    const auto turned = [&](double x, double y) {
        return Vec3(x * std::cos(angle), y, -x * std::sin(angle));
    };
    const int source = face_at(model, {3.5, 0.5, 0}), target = face_at(model, turned(3.5, 0.5));
    for (const int missing : {1, 2, 3}) {
        CAPTURE(missing);
        Tags tags{{source}, {target}, {}};
        int dropped = 0;
        for (const auto& face : model.faces) {
            if (face.tag == source || face.tag == target) continue;
            if (dropped++ >= missing) tags.walls.push_back(face.tag);
        }
        const topology::OpenVolume volume = sealed(model, tags, {closure::EdgeShape::follow});
        const cad::WrittenCad written = cad::write_cad(volume, folder.path("out.step"));
        CHECK(read(folder.path("out.step")).solids == 1);
        CHECK(written.planes + written.fitted == std::size_t(missing));
        CHECK(written.volume == doctest::Approx(3.5 * angle).epsilon(0.01));
    }
}

TEST_CASE("faces of several files, the loose before the solid, are told apart")
{
    const test::TempFolder folder;
    const std::string loose = folder.loose("loose.step", [] { occ::addBox(10, 0, 0, 1, 2, 3); });
    const std::string solid = folder.gmsh("solid.step", Plate::build);
    const topology::Model model = cad::load({loose, solid});
    const std::map<std::string, int> parts = Plate::parts(model, 1);
    Tags tags;
    for (const auto& [name, tag] : parts)
        if (name != "high" && name != "low") tags.walls.push_back(tag);
    cad::write_cad(sealed(model, tags), folder.path("plate.brep"));
    CHECK(read(folder.path("plate.brep")).volume == doctest::Approx(Plate::kVolume).epsilon(1e-9));
    const Tags box{{face_at(model, {10.5, 1, 0})},
                   {},
                   {face_at(model, {10, 1, 1.5}), face_at(model, {11, 1, 1.5}),
                    face_at(model, {10.5, 0, 1.5}), face_at(model, {10.5, 2, 1.5})}};
    cad::write_cad(sealed(model, box), folder.path("box.brep"));
    CHECK(read(folder.path("box.brep")).volume == doctest::Approx(6).epsilon(1e-9));
}

TEST_CASE("flat faces of facets become planes; bent ones are refused with what to do instead")
{
    const test::TempFolder folder;
    for (const int holes : {0, 1, 2}) {
        for (const auto& drop :
             {test::without(false, false, false), test::without(false, false, false, {0, 1}),
              test::without(false, true, false), test::without(true, true, false),
              test::without(false, false, true)}) {
            const test::Prism prism = test::prism({.sides = 5, .holes = holes, .drop = drop});
            topology::OpenVolume volume = prism.open();
            const bool ends = !volume.faces(topology::Role::source).empty() &&
                              !volume.faces(topology::Role::target).empty();
            volume = closure::close(volume, ends ? matching::match(volume) : matching::Match{}).volume;
            cad::write_cad(volume, folder.path("prism.step"));
            const InFile found = read(folder.path("prism.step"));
            CHECK(found.solids == 1);
            CHECK(found.faces == volume.model.faces.size());
            CHECK(found.volume == doctest::Approx(prism.volume).epsilon(1e-9));
        }
    }
    const topology::OpenVolume round = test::prism({.sides = 0}).open();
    const std::size_t before = entries(folder.path(""));
    CHECK(refusal([&] { cad::write_cad(round, folder.path("round.step")); },
                  {"only facets", "write_facets"}) == "cad.facets_alone");
    CHECK(entries(folder.path("")) == before);
}

TEST_CASE("two writings are alike to the byte, and a STEP file says mm whatever unit the host works in")
{
    const test::TempFolder folder;
    const topology::Model model = cad::load({folder.gmsh("plate.step", Plate::build)});
    Tags tags;
    for (const auto& [name, tag] : Plate::parts(model, 1))
        if (name != "round")
            (name == "low" ? tags.source : name == "high" ? tags.target : tags.walls).push_back(tag);
    const topology::OpenVolume volume = sealed(model, tags);
    for (const std::string ending : {".step", ".brep"}) {
        cad::write_cad(volume, folder.path("one" + ending));
        if (ending == ".step") // the time in its head would be another
            std::this_thread::sleep_for(std::chrono::milliseconds(1100));
        {
            const cad_worker::Gmsh host;
            gmsh::option::setString("Geometry.OCCTargetUnit", "M");
            gmsh::option::setNumber("Geometry.OCCScaling", 3);
            occ::addBox(0, 0, 0, 7, 7, 7);
            occ::synchronize();
            cad::write_cad(volume, folder.path("two" + ending));
            gmsh::vectorpair solids;
            gmsh::model::getEntities(solids, 3);
            CHECK(solids.size() == 1);
            gmsh::option::setString("Geometry.OCCTargetUnit", "");
            gmsh::option::setNumber("Geometry.OCCScaling", 1);
        }
        const std::string one = test::bytes_of(folder.path("one" + ending));
        const bool alike = one == test::bytes_of(folder.path("two" + ending));
        CHECK(alike);
        if (ending == ".step") CHECK(one.find("SI_UNIT(.MILLI.,.METRE.)") != std::string::npos);
    }
}

TEST_CASE("what cannot be written is refused, and what was there before stays")
{
    const test::TempFolder folder;
    const topology::Model model = cad::load({folder.gmsh("plate.step", Plate::build)});
    Tags tags;
    for (const auto& [name, tag] : Plate::parts(model, 1))
        if (name != "round")
            (name == "low" ? tags.source : name == "high" ? tags.target : tags.walls).push_back(tag);
    const topology::OpenVolume open = opened(model, tags);
    const topology::OpenVolume volume = sealed(model, tags);
    const std::string kept = folder.write("kept.step", "kept");
    const std::size_t before = entries(folder.path(""));
    CHECK(refusal([&] { cad::write_cad(open, kept); }, {"free", "close()"}) == "cad.not_sealed");
    CHECK(refusal([&] { cad::write_cad(volume, folder.path("a.iges")); }, {".step"}) == "cad.unknown_ending");
    CHECK(refusal([&] { cad::write_cad(volume, folder.path("no/a.step")); }, {"folder"}) == "io.no_folder");
    CHECK(refusal([&] { cad::write_cad(volume, folder.path("a.step"), {.deviation = 0}); }, {"deviation"}) ==
          "cad.deviation");
    CHECK(refusal([&] { cad::write_cad(volume, kept, {.deviation = 1e-14}); }, {"facets"}) ==
          "cad.volume_differs");
    std::atomic<bool> cancel = true;
    RunContext context;
    context.cancel = &cancel;
    CHECK(refusal([&] { cad::write_cad(volume, kept, {}, context); }) == "core.cancelled");
    CHECK(test::bytes_of(kept) == "kept");
    CHECK(entries(folder.path("")) == before);
}

TEST_CASE("facets written are read again with their faces and names")
{
    const test::TempFolder folder;
    const topology::Model model = cad::load({folder.gmsh("plate.step", Plate::build)});
    Tags tags;
    for (const auto& [name, tag] : Plate::parts(model, 1))
        if (name != "round")
            (name == "low" ? tags.source : name == "high" ? tags.target : tags.walls).push_back(tag);
    const topology::OpenVolume volume = sealed(model, tags);
    const auto names_of = [](const topology::Model& read) {
        std::set<std::string> names;
        for (const auto& face : read.faces) names.insert(face.name);
        return names;
    };
    for (const bool binary : {true, false}) {
        io::write_facets(volume, folder.path("a.msh"), {binary});
        const topology::Model msh = cad::load({folder.path("a.msh")}, {.feature_angle = 180});
        CHECK(msh.faces.size() == volume.model.faces.size());
        for (std::size_t f = 0; f < volume.model.faces.size(); ++f) {
            const auto& face = volume.model.faces[f];
            if (face.origin != topology::Origin::given) continue;
            const auto same = std::find_if(msh.faces.begin(), msh.faces.end(),
                                           [&](const auto& other) { return other.tag == face.tag; });
            REQUIRE(same != msh.faces.end());
            CHECK(topology::face_area(msh, FaceId(std::size_t(same - msh.faces.begin()))) ==
                  doctest::Approx(topology::face_area(volume.model, FaceId(f))).epsilon(1e-12));
        }
        for (const char* name : {"source", "target", "void:1"}) CHECK(names_of(msh).contains(name));
        CHECK(test::enclosed_volume(msh) == doctest::Approx(closure::enclosed_volume(volume)).epsilon(1e-12));

        io::write_facets(volume, folder.path("a.stl"), {binary});
        const topology::Model stl = cad::load({folder.path("a.stl")});
        CHECK(test::enclosed_volume(stl) == doctest::Approx(closure::enclosed_volume(volume)).epsilon(1e-5));
        for (const int uses : test::uses_of_edges(stl)) CHECK(uses == 2);
    }
    io::write_facets(volume, folder.path("a.obj"));
    const topology::Model obj = cad::load({folder.path("a.obj")}, {.feature_angle = 180});
    CHECK(obj.faces.size() == volume.model.faces.size());
    CHECK(names_of(obj).size() == volume.model.faces.size());
    CHECK(test::enclosed_volume(obj) == doctest::Approx(closure::enclosed_volume(volume)).epsilon(1e-12));
}
