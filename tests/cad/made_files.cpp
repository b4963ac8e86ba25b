// SPDX-License-Identifier: GPL-2.0-or-later
#include "made_files.h"

#include <lacuna/cad/detail/worker.h>
#include <lacuna/cad_worker/session.h>

#include <doctest/doctest.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <random>

#include <csignal>
#include <sys/wait.h>

namespace lacuna::test {

namespace {

namespace occ = gmsh::model::occ;
constexpr double pi = std::numbers::pi;

/// Gmsh for the making of a file, finalised again so that what is tested starts from nothing.
void with_gmsh(const std::string& path, const std::function<void()>& build)
{
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::model::add("made");
    build();
    occ::synchronize();
    {
        const cad_worker::CapturedOutput quiet; // Open CASCADE reports every STEP file it writes
        gmsh::write(path);
    }
    gmsh::finalize();
}

} // namespace

std::string shared_data() { return std::string(LACUNA_SOURCE_DIR) + "/../shared/data"; }

void kill_worker()
{
    const pid_t pid = cad::Worker::current()->pid();
    ::kill(pid, SIGKILL);
    siginfo_t info{};
    ::waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOWAIT); // left for its owner to collect
}

TempFolder::TempFolder()
{
    std::random_device dice;
    folder_ = std::filesystem::temp_directory_path() /
              ("lacuna_cad_" + std::to_string(dice()) + std::to_string(dice()));
    std::filesystem::create_directories(folder_);
}

TempFolder::~TempFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

std::string TempFolder::write(const std::string& name, const std::string& text) const
{
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
}

std::string TempFolder::gmsh(const std::string& name, const std::function<void()>& build) const
{
    with_gmsh(path(name), build);
    return path(name);
}

std::string TempFolder::loose(const std::string& name, const std::function<void()>& build) const
{
    with_gmsh(path(name), [&] {
        build();
        occ::synchronize();
        ::gmsh::vectorpair solids, faces;
        occ::getEntities(solids, 3);
        occ::getEntities(faces, 2);
        for (const auto& face : faces) {
            ::gmsh::vectorpair copy;
            occ::copy({face}, copy);
        }
        occ::remove(solids, false);
        occ::remove(faces, true);
    });
    return path(name);
}

std::vector<KnownShape> known_shapes()
{
    const auto tilt = [](int dim, int tag) { occ::rotate({{dim, tag}}, 0.3, 0.1, -0.2, 1, 2, 3, 0.7); };
    return {
        {"box", [] { occ::addBox(1, 2, 3, 1, 2, 3); }, 6, 22, 6},
        {"cylinder", [] { occ::addCylinder(0, 0, 0, 0, 0, 2, 1); }, 3, 2 * pi + 4 * pi, 2 * pi},
        {"half cylinder", [] { occ::addCylinder(0, 0, 0, 0, 0, 2, 1, -1, pi); }, 5, pi + 2 * pi + 4, pi},
        {"frustum", [] { occ::addCone(0, 0, 0, 0, 0, 1, 2, 1); }, 3, 5 * pi + 3 * pi * std::sqrt(2.0),
         7 * pi / 3},
        {"cone to its apex", [] { occ::addCone(0, 0, 0, 0, 0, 2, 1, 0); }, 2, pi + pi * std::sqrt(5.0),
         2 * pi / 3},
        {"sphere", [] { occ::addSphere(1, 1, 1, 2); }, 1, 16 * pi, 32 * pi / 3},
        {"half sphere", [] { occ::addSphere(0, 0, 0, 1, -1, 0); }, 2, 3 * pi, 2 * pi / 3},
        {"torus", [] { occ::addTorus(0, 0, 0, 3, 1); }, 1, 12 * pi * pi, 6 * pi * pi},
        {"quarter torus", [] { occ::addTorus(0, 0, 0, 3, 1, -1, pi / 2); }, 3, 3 * pi * pi + 2 * pi,
         1.5 * pi * pi},
        {"tilted cylinder", [=] { tilt(3, occ::addCylinder(5, 0, 0, 0, 0, 2, 1)); }, 3, 6 * pi, 2 * pi},
        {"tilted sphere", [=] { tilt(3, occ::addSphere(1, 0, 0, 1)); }, 1, 4 * pi, 4 * pi / 3},
        {"plate with a hole",
         [] {
             ::gmsh::vectorpair out;
             std::vector<::gmsh::vectorpair> map;
             occ::cut({{3, occ::addBox(-2, -2, 0, 4, 4, 1)}}, {{3, occ::addCylinder(0, 0, -1, 0, 0, 3, 1)}},
                      out, map);
         },
         7, 2 * (16 - pi) + 16 + 2 * pi, 16 - pi},
    };
}

double total_area(const topology::Model& model)
{
    double sum = 0;
    for (std::size_t f = 0; f < model.faces.size(); ++f) sum += topology::face_area(model, FaceId(f));
    return sum;
}

double enclosed_volume(const topology::Model& model)
{
    double sum = 0;
    for (const topology::Face& face : model.faces) {
        for (const Triangle& t : face.triangles)
            sum += model.at(t[0]).dot(model.at(t[1]).cross(model.at(t[2]))) / 6;
    }
    return sum;
}

std::vector<int> uses_of_edges(const topology::Model& model)
{
    std::vector<int> uses(model.edges.size(), 0);
    for (const topology::Face& face : model.faces) {
        for (const topology::Loop& loop : face.loops) {
            for (const topology::EdgeUse& use : loop.uses) ++uses[use.edge.index()];
        }
    }
    return uses;
}

void check_model(const topology::Model& model)
{
    std::vector<bool> used(model.points.size(), false);
    for (const topology::Edge& edge : model.edges) {
        CAPTURE(edge.tag);
        REQUIRE(edge.points.size() >= 2);
        CHECK(model[edge.from].point == edge.points.front());
        CHECK(model[edge.to].point == edge.points.back());
        if (edge.curve) CHECK(edge.params.size() == edge.points.size());
        for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) CHECK(edge.points[i] != edge.points[i + 1]);
    }
    std::map<int, int> tags;
    for (const topology::Face& face : model.faces) {
        CAPTURE(face.tag);
        ++tags[face.tag];
        CHECK(!face.triangles.empty());
        std::map<std::pair<Index, Index>, int> net;
        for (const Triangle& t : face.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                ++net[{t[k], t[(k + 1) % 3]}];
                --net[{t[(k + 1) % 3], t[k]}];
            }
        }
        const bool bordered = std::any_of(net.begin(), net.end(),
                                          [](const auto& side) { return side.second != 0; });
        if (bordered) CHECK(!face.loops.empty());
        if (face.surface) CHECK(face.uv.size() == face.triangles.size());
        for (const Triangle& t : face.triangles) {
            for (const Index p : t) used[static_cast<std::size_t>(p)] = true;
            const double area =
                (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0])).norm();
            CHECK(area > 0);
        }
        for (const topology::Loop& loop : face.loops) {
            for (std::size_t i = 0; i < loop.uses.size(); ++i) {
                CHECK(topology::use_to(model, loop.uses[i]) ==
                      topology::use_from(model, loop.uses[(i + 1) % loop.uses.size()]));
            }
        }
    }
    for (const auto& [tag, count] : tags) CHECK(count == 1);
    for (const bool u : used) CHECK(u);
    CHECK(model.diagonal > 0);
    CHECK(model.tolerance > 0);
}

} // namespace lacuna::test
