// SPDX-License-Identifier: GPL-2.0-or-later What a program that hosts Lacuna may rely on: its own Gmsh,
// streams, locale, descriptors and children are its own.
#include "made_files.h"
#include "support/whole_families.h"

#include <lacuna/cad/detail/worker.h>

#include <doctest/doctest.h>
#include <gmsh.h>

#include <clocale>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

using namespace lacuna;
namespace occ = gmsh::model::occ;

namespace {

std::size_t open_descriptors()
{
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) ++count;
    return count;
}

} // namespace

TEST_CASE("a host's own Gmsh is never touched")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("box.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("Mesh.Algorithm", 5);
    gmsh::model::add("host");
    const int ball = occ::addSphere(0, 0, 0, 1);
    occ::synchronize();
    std::vector<std::string> before, after;
    gmsh::model::list(before);
    {
        const topology::Model model = cad::load({path});
        quads::PlanarRegion square;
        square.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        square.loops = {{0, 1, 2, 3}};
        CHECK(cad::recombine(square).quads.size() >= 1);
    }
    gmsh::model::list(after);
    CHECK(after == before);
    double algorithm = 0;
    gmsh::option::getNumber("Mesh.Algorithm", algorithm);
    CHECK(algorithm == 5);
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, 3);
    CHECK(entities == gmsh::vectorpair{{3, ball}});
    {
        const topology::Model model = cad::load({path});
        gmsh::finalize();
        std::vector<Vec3> points{{1, 0, 0}};
        std::vector<Vec2> uv{{0, 0}};
        CHECK_NOTHROW(model.faces[0].surface->project(points, uv));
    }
}

TEST_CASE("streams, locale, environment and descriptors stay as they were")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("box.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    const std::string locale = std::setlocale(LC_ALL, nullptr);
    ::setenv("PYTHONPATH", "/some/where", 1);
    std::ostringstream printed;
    std::streambuf* cout = std::cout.rdbuf(printed.rdbuf());
    struct Restore {
        std::streambuf* before;
        ~Restore() { std::cout.rdbuf(before); }
    } const restore{cout};
    (void)cad::load({path});
    const std::size_t descriptors = open_descriptors();
    for (int i = 0; i < 5; ++i) {
        (void)cad::load({path});
        CHECK_THROWS_AS(cad::load({folder.write("bad.step", "ISO-10303-21;\n")}), Error);
        test::kill_worker();
    }
    (void)cad::load({path});
    CHECK(open_descriptors() == descriptors);
    CHECK(std::cout.rdbuf() == printed.rdbuf());
    std::cout.rdbuf(cout);
    CHECK(printed.str().empty());
    CHECK(std::string(std::setlocale(LC_ALL, nullptr)) == locale);
    CHECK(std::string(std::getenv("PYTHONPATH")) == "/some/where");
    ::unsetenv("PYTHONPATH");
}

TEST_CASE("what a script sets does not outlast the load")
{
    const test::TempFolder folder;
    const std::string box = folder.gmsh("box.brep", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    const std::string path = folder.write(
        "loud.geo",
        "Mesh.MeshSizeMax = 0.125; Mesh.Algorithm = 5; General.Terminal = 1; Geometry.Tolerance = 0.1;\n"
        "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1};\n");
    quads::PlanarRegion square;
    square.points = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}};
    square.loops = {{0, 1, 2, 3, 4, 5}};
    const auto before = cad::recombine(square);
    CHECK(cad::load({path}).faces.size() == 6);
    CHECK(cad::recombine(square).points == before.points);
    CHECK(cad::load({box}).faces.size() == 6);
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

TEST_CASE("a child of fork() starts a CAD process of its own and leaves its parent's alone")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("ball.step", [] { occ::addSphere(0, 0, 0, 1); });
    const topology::Model model = cad::load({path});
    const pid_t worker = cad::Worker::current()->pid();
    const pid_t child = ::fork();
    if (child == 0) {
        int right = 0;
        try {
            std::vector<Vec3> points{{1, 0, 0}};
            std::vector<Vec2> uv{{0, 0}};
            model.faces[0].surface->project(points, uv);
            ++right; // read again, by the child's own
        } catch (const Error&) {
        }
        try {
            right += cad::load({path}).faces.size() == 1 && cad::Worker::current()->pid() != worker ? 1 : 0;
        } catch (const Error&) {
        }
        ::_exit(right);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 2);
    std::vector<Vec3> points{{1.1, 0, 0}};
    std::vector<Vec2> uv{{0, 0}};
    CHECK_NOTHROW(model.faces[0].surface->project(points, uv));
    CHECK(cad::Worker::current()->pid() == worker);
}

TEST_CASE("the memory of the CAD process stays flat over many loads")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("box.brep", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    const auto resident = [] {
        std::ifstream file("/proc/" + std::to_string(cad::Worker::current()->pid()) + "/statm");
        long size = 0, pages = 0;
        file >> size >> pages;
        return pages * ::sysconf(_SC_PAGESIZE) / 1e6;
    };
    for (int i = 0; i < 100; ++i) (void)cad::load({path});
    const double before = resident();
    const pid_t worker = cad::Worker::current()->pid();
    const int loads = test::whole_families() ? 1000 : 250;
    for (int i = 0; i < loads; ++i) (void)cad::load({path});
    CHECK(resident() - before < (test::whole_families() ? 10 : 5)); // MB
    CHECK(cad::Worker::current()->pid() == worker);
}

TEST_CASE("facets need no CAD process")
{
    const test::TempFolder folder;
    const std::string path = folder.write("two.obj",
                                          "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
    const std::string step = folder.gmsh("box.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    test::kill_worker();
    const std::string program = std::getenv("LACUNA_CAD");
    ::setenv("LACUNA_CAD", "/no/such/program", 1);
    CHECK(cad::load({path}).faces.size() == 1);
    try {
        (void)cad::load({step});
        FAIL("a CAD file was read by no one");
    } catch (const BackendError& error) {
        CHECK(error.code() == "cad.no_worker");
        CHECK(std::string(error.what()).find("/no/such/program") != std::string::npos);
    }
    CHECK(cad::gmsh_version() == "none");
    ::setenv("LACUNA_CAD", program.c_str(), 1);
    CHECK(cad::load({step}).faces.size() == 6);
    CHECK(cad::gmsh_version().find('.') != std::string::npos);
}
