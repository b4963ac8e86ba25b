// SPDX-License-Identifier: GPL-2.0-or-later
#include "made_files.h"

#include <lacuna/cad/session.h>

#include <doctest/doctest.h>
#include <gmsh.h>

#include <clocale>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <thread>

using namespace lacuna;
namespace occ = gmsh::model::occ;

namespace {

bool is_initialized()
{
    std::vector<std::string> names;
    try {
        gmsh::model::list(names);
    } catch (...) {
        return false;
    }
    return !names.empty();
}

std::string value_of(const char* name)
{
    const char* value = std::getenv(name);
    return value ? value : "(unset)";
}

} // namespace

TEST_CASE("Gmsh is finalised when nothing needs it, and only then")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("box.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    CHECK(!is_initialized());
    {
        const topology::Model model = cad::load({path});
        CHECK(is_initialized());
        const topology::Model copy = model;
    }
    CHECK(!is_initialized());
    CHECK(!cad::gmsh_version().empty());
    CHECK(!is_initialized());
}

TEST_CASE("a host's session, models and options are left as they were")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("box.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.Verbosity", 4);
    gmsh::option::setNumber("Mesh.Algorithm", 5);
    gmsh::option::setNumber("Geometry.OCCSewFaces", 1);
    gmsh::model::add("host");
    const int ball = occ::addSphere(0, 0, 0, 1);
    occ::synchronize();
    gmsh::model::add("other");
    gmsh::model::setCurrent("host");
    std::vector<std::string> before;
    gmsh::model::list(before);
    {
        const topology::Model model = cad::load({path});
        quads::PlanarRegion square;
        square.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        square.loops = {{0, 1, 2, 3}};
        CHECK(cad::recombine(square).quads.size() >= 1);
        std::string current;
        gmsh::model::getCurrent(current);
        CHECK(current == "host");
    }
    std::vector<std::string> after;
    gmsh::model::list(after);
    CHECK(after == before);
    std::string current;
    gmsh::model::getCurrent(current);
    CHECK(current == "host");
    for (const auto& [name, expected] :
         {std::pair("General.Verbosity", 4.0), std::pair("Mesh.Algorithm", 5.0),
          std::pair("Geometry.OCCSewFaces", 1.0), std::pair("General.Terminal", 0.0)}) {
        double value = -1;
        gmsh::option::getNumber(name, value);
        CHECK(value == expected);
    }
    std::string type;
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, 3);
    CHECK(entities == gmsh::vectorpair{{3, ball}});
    gmsh::finalize();
}

TEST_CASE("what a script sets does not outlast the load")
{
    const test::TempFolder folder;
    const std::string path = folder.write(
        "loud.geo", "Mesh.MeshSizeMax = 0.125; Mesh.Algorithm = 5; General.Terminal = 1;\n"
                    "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1};\n");
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    const auto values = [] {
        std::vector<double> found;
        for (const char* name : {"Mesh.MeshSizeMax", "Mesh.Algorithm", "General.Terminal"}) {
            gmsh::option::getNumber(name, found.emplace_back());
        }
        return found;
    };
    const std::vector<double> before = values();
    CHECK(cad::load({path}).faces.size() == 6);
    CHECK(values() == before);
    gmsh::finalize();
}

TEST_CASE("a host that finalises Gmsh under the exact geometry gets an error in words, not a crash")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("ball.step", [] { occ::addSphere(0, 0, 0, 1); });
    const topology::Model model = cad::load({path});
    gmsh::finalize();
    std::vector<Vec3> points{{1, 0, 0}};
    std::vector<Vec2> uv{{0, 0}};
    CHECK_THROWS_AS(model.faces[0].surface->project(points, uv), BackendError);
    CHECK(cad::load({path}).faces.size() == 1);
}

TEST_CASE("locale and PYTHONPATH come back as they were, and nothing is printed")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("box.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    const std::string locale = std::setlocale(LC_NUMERIC, nullptr);
    for (const char* python_path : {static_cast<const char*>(nullptr), "/some/where"}) {
        if (python_path)
            ::setenv("PYTHONPATH", python_path, 1);
        else
            ::unsetenv("PYTHONPATH");
        const std::string before = value_of("PYTHONPATH");
        std::ostringstream printed;
        std::streambuf* cout = std::cout.rdbuf(printed.rdbuf());
        (void)cad::load({path});
        std::cout.rdbuf(cout);
        CHECK(printed.str().empty());
        CHECK(value_of("PYTHONPATH") == before);
        CHECK(std::string(std::setlocale(LC_NUMERIC, nullptr)) == locale);
    }
    ::unsetenv("PYTHONPATH");
}

TEST_CASE("loads on several threads do not disturb each other")
{
    const test::TempFolder folder;
    const std::string box = folder.gmsh("box.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    const std::string ball = folder.gmsh("ball.step", [] { occ::addSphere(0, 0, 0, 1); });
    std::vector<std::size_t> faces(6, 0);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        threads.emplace_back([&, i] {
            const topology::Model model = cad::load({i % 2 == 0 ? box : ball});
            faces[i] = model.faces.size();
        });
    }
    for (std::thread& thread : threads) thread.join();
    CHECK(faces == std::vector<std::size_t>{6, 1, 6, 1, 6, 1});
}

TEST_CASE("whatever Gmsh throws becomes a BackendError that names the file")
{
    cad::Session session("part.step");
    const auto message_of = [&](auto&& work) {
        try {
            session.run(work);
        } catch (const BackendError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(message_of([] { throw std::string("of string"); }).find("part.step: Gmsh failed: of string") !=
          std::string::npos);
    CHECK(message_of([] { throw "of chars"; }).find("of chars") != std::string::npos);
    CHECK(message_of([] { throw std::runtime_error("of runtime"); }).find("of runtime") != std::string::npos);
    CHECK(message_of([] { throw 1; }).find("part.step") != std::string::npos);
    CHECK(message_of([] { gmsh::model::setCurrent("no such model"); }).find("no such model") !=
          std::string::npos);
    CHECK_THROWS_AS(session.run([] { throw InvalidInput("a.b", "ours"); }), InvalidInput);
}
