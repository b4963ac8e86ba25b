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
#include <numbers>

using namespace lacuna;

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
    {"7pin.step", "rod-I", {{2}, {3}, {}}, 44736.279387, false},
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
                CHECK(std::abs(off) < 0.5);
            } catch (const Error& error) {
                FAIL_CHECK(c.name << ending << ": " << std::string(error.what()));
            }
        }
    }
}
