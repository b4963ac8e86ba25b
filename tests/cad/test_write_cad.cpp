// SPDX-License-Identifier: GPL-2.0-or-later
#include "made_files.h"

#include <lacuna/cad/session.h>
#include <lacuna/cad/write_cad.h>
#include <lacuna/closure/close.h>
#include <lacuna/io/facets.h>
#include <lacuna/matching/match.h>

#include <doctest/doctest.h>
#include <gmsh.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <set>

using namespace lacuna;
namespace occ = gmsh::model::occ;

namespace {

const std::string kShared = std::string(LACUNA_SOURCE_DIR) + "/../shared/data/";

/// Faces by tag, as a recipe names them.
struct Tags {
    std::vector<int> source, target, walls;
};

topology::OpenVolume opened(const topology::Model& model, const Tags& tags)
{
    const auto ids = [&](const std::vector<int>& wanted) {
        std::vector<FaceId> found;
        for (const int tag : wanted) {
            const auto face = std::find_if(model.faces.begin(), model.faces.end(), [&](const auto& f) { return f.tag == tag; });
            REQUIRE(face != model.faces.end());
            found.emplace_back(std::size_t(face - model.faces.begin()));
        }
        return found;
    };
    return topology::open_volume(model, {ids(tags.source), ids(tags.target), ids(tags.walls)});
}

topology::OpenVolume sealed(const topology::Model& model, const Tags& tags, const closure::CloseOptions& options = {})
{
    topology::OpenVolume volume = opened(model, tags);
    const bool ends = !volume.faces(topology::Role::source).empty() && !volume.faces(topology::Role::target).empty();
    closure::close(volume, ends ? matching::match(volume) : matching::Match{}, options);
    return volume;
}

/// What Gmsh finds in a file.
struct InFile {
    std::size_t solids = 0, faces = 0, edges = 0;
    double volume = 0;
};

InFile read(const std::string& path)
{
    cad::Session session(path);
    const cad::GmshModel scratch(session);
    const cad::CapturedOutput silent;
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
    const auto distance = [&](std::size_t f) { return (topology::face_centroid(model, FaceId(f)) - place).norm(); };
    for (std::size_t f = 1; f < model.faces.size(); ++f)
        if (distance(f) < distance(best)) best = f;
    return model.faces[best].tag;
}

/// The code of the error that work ends with; "done" without one.
std::string refusal(const std::function<void()>& work, const std::vector<std::string>& words = {})
{
    try {
        work();
    } catch (const Error& error) {
        const std::string what = error.what();
        for (const std::string& word : words) {
            CAPTURE(what);
            CHECK(what.find(word) != std::string::npos);
        }
        return error.code();
    }
    return "done";
}

std::string bytes_of(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::size_t entries(const std::string& folder)
{
    return std::size_t(std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator{}));
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
        occ::cut({{3, box}}, {{3, occ::addCylinder(1.2, 1.2, 0, 0, 0, kHeight, 0.5)}, {3, occ::addBox(2.4, 1.7, 0, 0.5, 0.5, kHeight)}},
                 out, map, 9);
        const int corner = occ::addBox(3, 0, 0, 1, 1, kHeight);
        occ::cut({{3, corner}}, {{3, occ::addCylinder(3, 1, 0, 0, 0, kHeight, 1)}}, bit, map);
        occ::cut({{3, 9}}, bit, out, map);
    }
    /// Faces by what they are, in a model scaled.
    static std::map<std::string, int> parts(const topology::Model& model, double scale)
    {
        const auto at = [&](double x, double y, double z) { return face_at(model, scale * Vec3(x, y, z)); };
        std::map<std::string, int> tags{{"low", at(1.9, 1.5, 0)},   {"high", at(1.9, 1.5, 2)}, {"left", at(0, 1.5, 1)},
                                        {"back", at(2, 3, 1)},      {"right", at(4, 2, 1)},    {"front", at(1.5, 0, 1)},
                                        {"corner", at(3.7, 0.3, 1)}, {"round", at(1.2, 1.2, 1)}, {"s1", at(2.4, 1.95, 1)},
                                        {"s2", at(2.9, 1.95, 1)},   {"s3", at(2.65, 1.7, 1)},  {"s4", at(2.65, 2.2, 1)}};
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
    for (const RealCase& c : kRealCases) {
        const std::string path = kShared + "cad/" + c.file;
        if (!std::filesystem::exists(path)) {
            MESSAGE("skipped: there is no " << path);
            continue;
        }
        CAPTURE(c.name);
        const topology::OpenVolume volume = sealed(cad::load({path}), c.tags);
        for (const std::string ending : {".step", ".brep"}) {
            const std::string file = folder.path(c.name + ending);
            const auto start = std::chrono::steady_clock::now();
            try {
                const cad::WrittenCad written = cad::write_cad(volume, file);
                const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
                const InFile found = read(file);
                const double off = found.volume / c.volume - 1;
                MESSAGE(c.name << ending << ": " << found.solids << " solid, " << found.faces << " faces (" << written.planes << " planes, "
                               << written.fitted << " fitted), volume " << found.volume << ", off by " << off << ", facets "
                               << written.facet_volume << ", sewn within " << written.tolerance << ", " << seconds << " s, "
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
    const std::vector<std::pair<std::string, std::string>> files{{"solid", folder.gmsh("solid.step", Plate::build)},
                                                                 {"loose", folder.loose("loose.step", Plate::build)}};
    const std::vector<std::set<std::string>> ways{{"right", "corner"},         {"corner"},       {"round"},     {"high"},
                                                  {"s1", "s2", "s3", "s4"},    {"low", "high"},  {"s2"},        {"left", "s1", "round"},
                                                  {"left", "back", "right", "front", "corner", "round", "s1", "s2", "s3", "s4"}};
    for (const auto& [kind, path] : files) {
        for (const double scale : {1.0, 25.4}) {
            const topology::Model model = cad::load({path}, {.scale = scale});
            const std::map<std::string, int> parts = Plate::parts(model, scale);
            REQUIRE(model.faces.size() == parts.size());
            for (const std::set<std::string>& missing : ways) {
                Tags tags;
                for (const auto& [name, tag] : parts)
                    if (!missing.contains(name)) (name == "low" ? tags.source : name == "high" ? tags.target : tags.walls).push_back(tag);
                if (tags.source.empty()) tags.source.swap(tags.target);
                CAPTURE(kind);
                CAPTURE(scale);
                CAPTURE(*missing.begin());
                const topology::OpenVolume volume = sealed(model, tags);
                const std::string file = folder.path(kind + *missing.begin() + (scale > 1 ? ".brep" : ".stp"));
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
        const topology::OpenVolume volume = sealed(model, tags);
        const cad::WrittenCad written = cad::write_cad(volume, folder.path("out.step"));
        CHECK(written.fitted == 1);
        CHECK(read(folder.path("out.step")).solids == 1);
        CHECK(written.volume == doctest::Approx(written.facet_volume).epsilon(0.01));
    }
}
