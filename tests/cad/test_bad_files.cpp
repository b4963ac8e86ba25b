// SPDX-License-Identifier: GPL-2.0-or-later
#include "made_files.h"
#include "support/refusal.h"

#include <doctest/doctest.h>
#include <gmsh.h>

#include <cmath>
#include <filesystem>

using namespace lacuna;
namespace occ = gmsh::model::occ;

namespace {

const std::vector<std::string> kEndings{".step", ".stp", ".iges", ".igs", ".brep", ".geo", ".stl",
                                        ".obj",  ".msh", ".bdf",  ".nas", ".unv",  ".vtk", ".mesh"};

/// The message of the error that loading gives, after its code.
std::string load_failure(const std::string& path, const cad::LoadOptions& options = {})
{
    try {
        (void)cad::load({path}, options);
    } catch (const InvalidInput& error) {
        return error.code() + ": " + error.what();
    }
    return "no error";
}

using test::has;

} // namespace

TEST_CASE("a missing file, a folder and an empty file are told apart, each named")
{
    const test::TempFolder folder;
    for (const std::string& ending : kEndings) {
        CAPTURE(ending);
        const std::string missing = folder.path("missing" + ending);
        CHECK(has(load_failure(missing), "io.no_file"));
        CHECK(has(load_failure(missing), missing));
        std::filesystem::create_directory(folder.path("folder" + ending));
        CHECK(has(load_failure(folder.path("folder" + ending)), "io.not_a_file"));
        CHECK(has(load_failure(folder.write("empty" + ending, "")), "io.empty_file"));
    }
}

TEST_CASE("an unknown ending is answered with the known ones")
{
    const test::TempFolder folder;
    for (const char* name : {"part.sldprt", "part.docx", "part", "part.step.bak"}) {
        const std::string message = load_failure(folder.write(name, "text"));
        CHECK(has(message, "io.unknown_ending"));
        CHECK(has(message, ".step"));
        CHECK(has(message, ".stl"));
    }
}

TEST_CASE("an ending in capitals is known")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("box.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    for (const char* name : {"BOX.STEP", "Box.Stp"}) {
        std::filesystem::copy_file(path, folder.path(name));
        CHECK(cad::load({folder.path(name)}).faces.size() == 6);
    }
}

TEST_CASE("text that is no file of its kind is refused, whatever the ending")
{
    const test::TempFolder folder;
    for (const std::string& ending : kEndings) {
        for (const std::string& text :
             {std::string("hello world\nfoo bar\n"), std::string(300, '\0'), std::string(5000, 'x')}) {
            CAPTURE(ending);
            const std::string path = folder.write("bad" + ending, text);
            const std::string message = load_failure(path);
            CHECK((has(message, ".unreadable: ") || has(message, ".no_faces: ")));
            CHECK(has(message, path));
        }
    }
}

TEST_CASE("a file cut off in the middle is refused or read without harm")
{
    const test::TempFolder folder;
    for (const char* ending : {".step", ".brep", ".msh", ".stl", ".unv", ".vtk"}) {
        CAPTURE(ending);
        const std::string whole = folder.gmsh("whole" + std::string(ending), [&] {
            occ::addBox(0, 0, 0, 1, 1, 1);
            occ::synchronize();
            gmsh::model::mesh::generate(2);
        });
        std::string text(std::filesystem::file_size(whole), '\0');
        {
            FILE* file = std::fopen(whole.c_str(), "rb");
            REQUIRE(file != nullptr);
            REQUIRE(std::fread(text.data(), 1, text.size(), file) == text.size());
            std::fclose(file);
        }
        for (const double part : {0.2, 0.5, 0.8}) {
            const std::string path = folder.write("cut" + std::string(ending),
                                                  text.substr(0, std::size_t(part * double(text.size()))));
            try {
                test::check_model(cad::load({path}));
            } catch (const Error& error) {
                CHECK(has(error.what(), path));
            }
        }
    }
}

TEST_CASE("a file without faces says so")
{
    const test::TempFolder folder;
    CHECK(has(load_failure(folder.gmsh("line.brep",
                                       [] { occ::addLine(occ::addPoint(0, 0, 0), occ::addPoint(1, 0, 0)); })),
              "cad.no_faces"));
    CHECK(has(load_failure(folder.write("point.geo", "Point(1) = {0, 0, 0};\n")), "cad.no_faces"));
    CHECK(has(load_failure(folder.write("points.obj", "v 0 0 0\nv 1 0 0\n")), "io.no_faces"));
    CHECK(has(load_failure(folder.write(
                  "tetra.bdf",
                  "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n"
                  "CBAR,1,1,1,2\nENDDATA\n")),
              "1 CBAR"));
}

TEST_CASE("a script with an error is refused in Gmsh's own words")
{
    const test::TempFolder folder;
    // Without a last newline no command is lost: the file is read whole, or refused.
    const std::string script = "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\n"
                               "Rectangle(2) = {0, 0, 1, 1, 1}";
    CHECK(cad::load({folder.write("last.geo", script + ";")}).faces.size() == 2);
    CHECK(has(load_failure(folder.write("cut.geo", script)), "cad.unreadable"));
    const std::string message = load_failure(folder.write("bad.geo", "Point(1) = {0,0,0};\nnonsense;\n"));
    CHECK(has(message, "bad.geo"));
    CHECK(has(message, "line 2"));
}

TEST_CASE("options out of range are refused")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("box.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    for (const double scale : {0.0, -1.0, double(NAN), double(INFINITY)})
        CHECK(has(load_failure(path, {.scale = scale}), "io.scale"));
    for (const double tolerance : {-1.0, double(NAN)})
        CHECK(has(load_failure(path, {.tolerance = tolerance}), "io.tolerance"));
    CHECK_THROWS_AS(cad::load({}), InvalidInput);
}
