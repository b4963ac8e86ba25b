// SPDX-License-Identifier: MIT
#include "support/facet_files.h"
#include "support/folder.h"
#include "support/refusal.h"

#include <lacuna/io/load_facets.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sys/stat.h>

using namespace lacuna;

namespace {

/// Text of the error that reading gives, after its code; empty where there is none.
std::string failure(const std::string& name, const std::string& bytes)
{
    try {
        io::read_facets(name, bytes);
    } catch (const InvalidInput& error) {
        return error.code() + ": " + error.what();
    }
    return "";
}

using test::has;

/// Calls `visit(points of a facet, label)` for triangles and quads.
template <class Visit>
void each_facet(const io::FacetFile& file, const Visit& visit)
{
    const auto cells = [&](const auto& all, const std::vector<int>& labels) {
        for (std::size_t c = 0; c < all.size(); ++c) {
            std::vector<Vec3> at;
            for (const Index p : all[c]) at.push_back(file.soup.points[index(p)]);
            visit(at, labels[c]);
        }
    };
    cells(file.soup.triangles, file.soup.triangle_label);
    cells(file.soup.quads, file.soup.quad_label);
}

Vec3 area_of(const std::vector<Vec3>& at)
{
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < at.size(); ++k) sum += (at[k] - at[0]).cross(at[k + 1] - at[0]) / 2;
    return sum;
}

double total_area(const io::FacetFile& file)
{
    double sum = 0;
    each_facet(file, [&](const auto& at, int) { sum += area_of(at).norm(); });
    return sum;
}

std::string numbered_line(const std::string& text, std::size_t at)
{
    return "line " + std::to_string(1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n')) +
           ":";
}

const std::string kShared = std::string(LACUNA_SOURCE_DIR) + "/../shared/data/";

} // namespace

TEST_CASE("a box comes back from every format with its facets turned outward, its labels, tags and names")
{
    const test::FacetBox box = test::facet_box();
    for (const test::FacetSample& sample : test::facet_samples()) {
        CAPTURE(sample.name);
        const io::FacetFile file = io::read_facets(sample.name, sample.bytes);
        CHECK(file.soup.quads.size() == (sample.quads ? box.quads.size() : 0));
        CHECK(file.soup.triangles.size() == (sample.quads ? 0 : 2 * box.quads.size()));
        REQUIRE(file.label_tag.size() == std::size_t(sample.labels));
        for (int label = 0; label < sample.labels; ++label) {
            CHECK(file.label_tag[index(label)] == label + 1);
            CHECK(file.soup.label_name[index(label)] ==
                  (sample.label_name.empty() ? "" : sample.label_name + std::to_string(label + 1)));
        }
        CHECK(total_area(file) == doctest::Approx(2 * (3.75 * 1 + 3.75 * 1 + 1 * 1)));
        each_facet(file, [&](const std::vector<Vec3>& at, int label) {
            const int side = label + 1;
            const int axis = (side - 1) % 3;
            if (sample.labels == 6) {
                CHECK(at[0][axis] == (side <= 3 ? 0.0 : std::array{3.75, 1.0, 1.0}[index(axis)]));
                CHECK(area_of(at)[axis] * (side <= 3 ? -1 : 1) > 0);
            }
            const Vec3 centre(1.875, 0.5, 0.5);
            CHECK((at[0] - centre).dot(area_of(at)) > 0);
        });
    }
}

TEST_CASE("a word that is no number is refused by its line, or was not needed")
{
    for (const test::FacetSample& sample : test::facet_samples()) {
        if (!sample.text || sample.name == "inline.vtu" || sample.name == "big.vtu" ||
            sample.name == "coded.vtu")
            continue;
        CAPTURE(sample.name);
        const std::string whole = sample.bytes;
        const io::FacetFile right = io::read_facets(sample.name, whole);
        int refused = 0;
        for (std::size_t at = 0; at < whole.size();) {
            const std::size_t begin = whole.find_first_of("0123456789", at);
            if (begin == std::string::npos) break;
            const std::size_t end = std::min(whole.find_first_of(" ,\n/\"*", begin), whole.size());
            at = end + 1 + whole.size() / 300;
            std::string wrong = whole;
            wrong[begin] = '?';
            CAPTURE(wrong.substr(whole.rfind('\n', begin) + 1, 60));
            const std::string message = failure(sample.name, wrong);
            if (message.empty()) {
                const io::FacetFile read = io::read_facets(sample.name, wrong);
                CHECK(read.soup.points == right.soup.points);
                CHECK(read.soup.quads == right.soup.quads);
                continue;
            }
            ++refused;
            CHECK(has(message, sample.name));
            // A card or a face is named by the line it begins on, an array of XML by its tag's.
            const std::size_t before = begin == 0 ? 0 : whole.rfind('\n', begin - 1);
            // A card of large fields may take four lines.
            const std::size_t above = before == std::string::npos || before == 0
                                          ? std::string::npos
                                          : whole.rfind('\n', before - 1);
            // Text between datasets is passed over, so a mark astray is noticed at the line behind it.
            const std::size_t behind = whole.find('\n', begin);
            const bool near = has(message, numbered_line(whole, begin)) ||
                              ((sample.name.ends_with(".unv") || sample.name.ends_with(".UNV")) &&
                               has(message, numbered_line(whole, behind + 1))) ||
                              (before != std::string::npos && has(message, numbered_line(whole, before))) ||
                              (above != std::string::npos && has(message, numbered_line(whole, above))) ||
                              sample.name.ends_with(".vtu") ||
                              // One whose lines lie apart is named by the first, or by the line astray.
                              (sample.name == "apart.bdf" && (has(message, "CQUAD8") || has(message, "+CQ")));
            CHECK_MESSAGE(near, message);
        }
        CHECK(refused > 10);
    }
}

TEST_CASE("a file cut off anywhere is refused or read in part, and what is announced is never missing")
{
    for (const test::FacetSample& sample : test::facet_samples()) {
        CAPTURE(sample.name);
        const std::size_t whole = io::read_facets(sample.name, sample.bytes).soup.quads.size();
        // Lines of an OBJ file and cards of a deck stand by themselves, and so do solids of an STL file.
        const std::string ending = io::ending_of(sample.name);
        const bool by_lines = ending == ".obj" || ending == ".bdf" || ending == ".nas" || ending == ".dat" ||
                              ending == ".stl" || ending == ".unv" || ending == ".inp" || ending == ".k";
        for (std::size_t length = 1; length < sample.bytes.size(); length += 1 + length / 50) {
            try {
                const auto part = io::read_facets(sample.name,
                                                  std::string_view(sample.bytes).substr(0, length));
                CHECK(part.soup.quads.size() <= whole);
                CHECK((by_lines || part.soup.quads.size() == whole));
            } catch (const InvalidInput& error) {
                CHECK(error.code().starts_with("io."));
            }
        }
    }
}

TEST_CASE(
    "a binary STL file whose count of facets is wrong is refused by that count, whatever its header says")
{
    const std::vector<test::FacetSample> samples = test::facet_samples();
    const auto binary = std::ranges::find(samples, "binary.Stl", &test::FacetSample::name);
    REQUIRE(binary != samples.end());
    for (const std::string header : {"solid made elsewhere", "made elsewhere"}) {
        for (const int wrong : {200, 2'000'000, 2'000'000'000}) {
            std::string bytes = binary->bytes;
            bytes.replace(0, 80, header + std::string(80 - header.size(), '\0'));
            for (std::size_t byte = 0; byte < 4; ++byte)
                bytes[80 + byte] = static_cast<char>(wrong >> (8 * byte) & 255);
            CAPTURE(header);
            CAPTURE(wrong);
            try {
                (void)io::read_facets(binary->name, bytes);
                FAIL("read");
            } catch (const InvalidInput& error) {
                CHECK(has(error.what(), "announces " + std::to_string(wrong) + " facets"));
            }
        }
    }
}

TEST_CASE("content that is another format's is refused, and says which")
{
    for (const test::FacetSample& sample : test::facet_samples()) {
        if (!sample.text) continue;
        for (const char* ending : {".stl", ".obj", ".msh", ".unv", ".bdf", ".inp", ".vtk", ".vtu", ".mesh"}) {
            std::string own = io::ending_of(sample.name);
            if (own == ".nas" || own == ".dat") own = ".bdf";
            if (own == ending) continue;
            CAPTURE(sample.name);
            CAPTURE(ending);
            const std::string message = failure(std::string("x") + ending, sample.bytes);
            CHECK((has(message, "io.unreadable") || has(message, "io.no_faces")));
        }
    }
    CHECK(has(failure("x.Stl", "# vtk DataFile Version 3.0\n"), "a legacy VTK file"));
    CHECK(has(failure("x.stl", "ISO-10303-21;\n"), ".step"));
    CHECK(has(failure("x.Mesh", "MeshVersion = 1;\nSystemCall \"touch x\";\n"), "io.unreadable"));
}

TEST_CASE("folders, pipes, devices, empty and missing files are told apart and nothing waits")
{
    const test::Folder folder;
    const auto code = [](const std::string& path) {
        return test::error_code([&] { io::load_facets({path}); });
    };
    CHECK(code(folder.file("none.stl")) == "io.no_file");
    std::filesystem::create_directory(folder.file("folder.stl"));
    CHECK(code(folder.file("folder.stl")) == "io.not_a_file");
    REQUIRE(::mkfifo(folder.file("pipe.stl").c_str(), 0600) == 0);
    CHECK(code(folder.file("pipe.stl")) == "io.not_a_file");
    std::filesystem::create_symlink("/dev/zero", folder.file("zero.stl"));
    CHECK(code(folder.file("zero.stl")) == "io.not_a_file");
    test::put_bytes(folder.file("empty.stl"), "");
    CHECK(code(folder.file("empty.stl")) == "io.empty_file");
    test::put_bytes(folder.file("x.docx"), "text");
    CHECK(code(folder.file("x.docx")) == "io.unknown_ending");
    CHECK(test::error_code([] { io::load_facets({}); }) == "io.no_file");
}

TEST_CASE("a polygon that is not convex is cut inside its rim, one that crosses itself is refused")
{
    const std::string points = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\n";
    const io::FacetFile file = io::read_facets("x.obj", points + "f 2 3 4 5 1\n");
    CHECK(file.soup.triangles.size() == 3);
    CHECK(total_area(file) == doctest::Approx(2.5));
    CHECK(has(failure("x.obj", points + "f 1 3 2 5 4\n"), "crosses itself"));
}

TEST_CASE("Nastran frames, defaults and continuations are understood")
{
    const auto points = [](const std::string& deck) { return io::read_facets("x.bdf", deck).soup.points; };
    const std::string face = "CTRIA3,7,,1,2,3\n";
    // A cylindrical frame whose axis is x, a spherical one within it, and one by nodes.
    const std::string frames = "CORD2C,5,0,1.,0.,0.,2.,0.,0.,\n,1.,1.,0.\n"
                               "CORD2S         6       5      0.      0.      0.      0.      0.      1.+A\n"
                               "+A            1.      0.      0.\n"
                               "cord1r,8,11,12,13\nGRID,11,,1.,1.,1.\nGRID,12,,1.,1.,2.\nGRID,13,,2.,1.,1.\n";
    auto at = points(frames + "GRID,1,5,2.,90.,3.\nGRID*,2,6,2.,90.\n*,0.\nGRID,3,8,1.,2.,3.\n" + face);
    REQUIRE(at.size() == 3);
    CHECK((at[0] - Vec3(4, 0, 2)).norm() < 1e-12);
    CHECK((at[1] - Vec3(1, 2, 0)).norm() < 1e-12);
    CHECK((at[2] - Vec3(2, 3, 4)).norm() < 1e-12);
    // The default frame holds where the field is blank, not where it is 0.
    at = points(frames + "GRID,1,,2.,90.,3.\nGRID,2,0,2.,9.,3.\nGRID,3\nGRDSET,,5\n" + face);
    CHECK((at[0] - Vec3(4, 0, 2)).norm() < 1e-12);
    CHECK((at[1] - Vec3(2, 9, 3)).norm() < 1e-12);
    // A blank property is the element's own number and shifts nothing.
    const std::string flat = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1-0,0.\n";
    const io::FacetFile own = io::read_facets("x.bdf", flat + face);
    CHECK(own.label_tag == std::vector{7});
    CHECK(own.soup.label_name == std::vector<std::string>{"pid:7"});

    for (const auto& [deck, words] : std::vector<std::pair<std::string, std::string>>{
             {"GRID,1,4,0.,0.,0.\n" + face, "coordinate system 4"},
             {"CORD2R,4,4,0.,0.,0.,0.,0.,1.,\n,1.,0.,0.\nGRID,1,4\nGRID,2\nGRID,3\n" + face, "by itself"},
             {"CORD2R,4,0,0.,0.,0.,0.,0.,1.,\n,0.,0.,2.\nGRID,1,4\nGRID,2\nGRID,3\n" + face, "collinear"},
             {flat + "GRID,3,,5.,1.,0.\n" + face, "line 4"},
             {flat + "CTRIA3,7,1,1,2,9\n", "line 4: element 7 of type CTRIA3 names node 9"},
             {flat + "CTRIA3,7,1,1,2\n", "found none"},
             {flat + "GRID,=,,*(1)\n" + face, "line 4"},
             {"        1.0\n", "to no card"},
             {"GRID    1               0.      0.      0.                              +A\n+B\n",
              "continuation"},
             {"BEGIN SUPER=1\n" + frames + "GRDSET,,5\nGRID,1\nGRID,2\nGRID,3\n" + face,
              "GRDSET of superelements"}}) {
        CAPTURE(deck);
        CHECK_MESSAGE(has(failure("x.bdf", deck), words), failure("x.bdf", deck));
    }
}

TEST_CASE("errors of a reader hold entities and values as data")
{
    const std::string nodes = "GRID,1\nGRID,2,,1.\nGRID,3,,0.,1.\n";
    const auto message = [](const char* name, const std::string& bytes) {
        try {
            io::read_facets(name, bytes);
        } catch (const InvalidInput& error) {
            return error.message();
        }
        return Message("test.read", "it was read");
    };
    const Message missing = message("x.bdf", nodes + "CTRIA3,7,1,1,2,9\n");
    CHECK(missing.code() == "io.unreadable");
    CHECK(missing.entities() == std::vector<NamedEntity>{{"element", 7}, {"node", 9}});
    const Message corners = message("x.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n");
    CHECK(corners.found() == std::vector<MessageValue>{2LL});
    const Message kind = message("x.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET FIELD\n");
    CHECK(kind.found() == std::vector<MessageValue>{std::string("'FIELD'")});
    CHECK(kind.remedy() == "write it as one of them");
}

TEST_CASE("INCLUDE reads files beside the deck or below it, and no others")
{
    const test::Folder folder;
    const std::string face = "CTRIA3,7,1,1,2,3\n";
    std::filesystem::create_directory(folder.file("deck"));
    std::filesystem::create_directory(folder.file("deck/parts"));
    test::put_bytes(folder.file("deck/parts/nodes.inc"), "GRID,1\nGRID,2,,1.\nGRID,3,,,x\n");
    test::put_bytes(folder.file("outside.inc"), "GRID,1\n");
    const auto read = [&](const std::string& line) {
        test::put_bytes(folder.file("deck/x.bdf"), "begin bulk\n" + line + face + "enddata\n");
        try {
            io::read_facets(folder.file("deck/x.bdf"));
        } catch (const InvalidInput& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const std::string wrong = read("include 'parts/nodes.inc'\n");
    CHECK(has(wrong, "nodes.inc, line 3"));
    test::put_bytes(folder.file("deck/parts/nodes.inc"), "GRID,1\nGRID,2,,1.\nGRID,3,,,1.\n");
    CHECK(read("include 'parts/nodes.inc'\n").empty());
    CHECK(read("INCLUDE 'parts/\n   nodes.inc'\n").empty());
    CHECK(has(read("INCLUDE '../outside.inc'\n"), "line 2"));
    CHECK(has(read("INCLUDE '" + folder.file("outside.inc") + "'\n"), "deck's folder"));
    CHECK(has(read("INCLUDE '/etc/passwd'\n"), "deck's folder"));
    CHECK(has(read("INCLUDE 'none.inc'\n"), "there is no file"));
    CHECK(has(read("INCLUDE 'x.bdf'\n"), "includes itself"));
    std::filesystem::create_symlink(folder.file("outside.inc"), folder.file("deck/link.inc"));
    CHECK(has(read("INCLUDE 'link.inc'\n"), "deck's folder"));
}

TEST_CASE("faces of higher order give their corners, beams are counted")
{
    // Six nodes of a universal triangle go round it.
    std::string unv = "    -1\n  2411\n";
    for (const char* at : {"0. 0. 0.", "1. 0. 0.", "2. 0. 0.", "1. 1. 0.", "0. 2. 0.", "0. 1. 0."}) {
        static int tag = 0;
        unv += "  " + std::to_string(++tag) + " 1 1 11\n " + at + "\n";
    }
    unv += "    -1\n    -1\n  2412\n 1 92 1 1 7 6\n 1 2 3 4 5 6\n 3 21 1 1 7 2\n 0 "
           "1 1\n 1 2\n    -1\n";
    const io::FacetFile file = io::read_facets("x.unv", unv);
    CHECK(total_area(file) == doctest::Approx(2));
    REQUIRE(file.notes.size() == 1);
    CHECK(has(file.notes[0], "1 elements 21"));
    CHECK(has(failure("x.bdf", "GRID,1\nGRID,2\nCBAR,1,1,1,2\n"), "1 CBAR"));
}

TEST_CASE("VTU files of a compressor that is not known are refused by its name")
{
    for (const test::FacetSample& sample : test::facet_samples()) {
        if (sample.name != "raw.vtu" && sample.name != "inline.vtu") continue;
        std::string bytes = sample.bytes;
        bytes.replace(bytes.find("header_type"), 0, "compressor=\"vtkLZ4DataCompressor\" ");
        CHECK(has(failure("x.vtu", bytes), "vtkLZ4DataCompressor"));
    }
}

TEST_CASE("counts that lie, numbers that are none and tags that overflow are refused")
{
    const std::string huge = "999999999999999999";
    for (const auto& [name, bytes] : std::vector<std::pair<std::string, std::string>>{
             {"x.vtk", "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS " + huge + " float\n1"},
             {"x.vtk", "# vtk DataFile Version 5.1\n\nBINARY\nDATASET POLYDATA\nPOINTS 0 float\n\nPOLYGONS " +
                           huge + " 3\nOFFSETS vtktypeint64\n1"},
             {"x.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices " + huge + "\n1 2 3 0\n"},
             {"x.stl", std::string(80, 'a') + std::string("\xff\xff\xff\x7f", 4) + std::string(50, '\0')},
             {"x.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\n"},
             {"x.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1e999\n"},
             {"x.obj", "v 0 0 inf\nf 1 1 1\n"},
             {"x.obj", "v 0 0 0\nf 1 1 9223372036854775808\n"},
             {"x.obj", "v 0 0 1e101\nf 1 1 1\n"},
             {"x.unv", "-1\n2411\n4294967297 1 1 1\n0. 0. 0.\n-1\n"}}) {
        CAPTURE(bytes);
        CHECK(has(failure(name, bytes), "io.unreadable"));
    }
}

TEST_CASE("files of several formats load as one model, tags going on from file to file")
{
    const test::Folder folder;
    std::vector<std::string> paths;
    for (const test::FacetSample& sample : test::facet_samples()) {
        if (sample.name != "forward.obj" && sample.name != "free.bdf") continue;
        paths.push_back(folder.file(sample.name));
        test::put_bytes(paths.back(), sample.bytes);
    }
    const topology::Model one = io::load_facets({paths[0]}, {.scale = 2});
    CHECK(one.faces.size() == 6);
    CHECK(one.diagonal == doctest::Approx(2 * std::sqrt(3.75 * 3.75 + 2)));
    const bool facets_first = paths[0].ends_with(".obj"); // its quads are facets; those of the deck are given
    for (const std::size_t i : {0, 1}) {
        CAPTURE(paths[i]);
        const bool kept = (i == 0) != facets_first;
        CHECK(io::load_facets({paths[i]}).faces[0].given_quads.size() == (kept ? 2 : 0));
        CHECK(io::load_facets({paths[i]}, {.keep_mesh = false}).faces[0].given_quads.empty());
    }
    const topology::Model copies = io::load_facets(paths);
    CHECK(copies.faces.size() == 6); // the same box twice: one of each pair is left out, with a note
    CHECK(!copies.notes.empty());
    CHECK(test::error_code([&] { io::load_facets({paths[0]}, {.scale = -1}); }) == "io.scale");
    CHECK(test::error_code([&] { io::load_facets({paths[0]}, {.tolerance = 1}); }) == "io.tolerance");
}

TEST_CASE("every shared file of facets and elements is read")
{
    struct Shared {
        const char* file;
        std::size_t triangles, quads;
    };
    for (const Shared& shared :
         {Shared{"stl/bracket_01.stl", 3284, 0}, Shared{"stl/hollow_brick_2x4.stl", 13294, 0},
          Shared{"fem/salome_cube.unv", 0, 150}, Shared{"fem/nested_cubes.msh", 240, 0},
          Shared{"fem/wingbox.bdf", 0, 2464}, Shared{"fem/codim_1-tube.inp", 0, 96},
          Shared{"fem/contact_model.bdf", 0, 690}}) {
        CAPTURE(shared.file);
        if (!std::filesystem::exists(kShared + shared.file)) {
            MESSAGE("skipped: there is no " << kShared + shared.file);
            continue;
        }
        const io::FacetFile file = io::read_facets(kShared + shared.file);
        CHECK(file.soup.triangles.size() == shared.triangles);
        CHECK(file.soup.quads.size() == shared.quads);
    }
}

TEST_CASE("every hostile file is a sentence or a sound model, soon")
{
    if (!std::filesystem::exists(kShared + "hostile")) {
        MESSAGE("skipped: there is no " << kShared << "hostile");
        return;
    }
    int read = 0;
    int refused = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kShared + "hostile")) {
        const std::string path = entry.path().string();
        const std::string ending = io::ending_of(path);
        if (std::string(".unv.msh.vtk.stl.obj").find(ending) == std::string::npos) continue;
        CAPTURE(path);
        const auto start = std::chrono::steady_clock::now();
        try {
            const topology::Model model = io::load_facets({path});
            ++read;
            for (const topology::Face& face : model.faces) CHECK(!face.triangles.empty());
        } catch (const Error& error) {
            ++refused;
            CHECK(std::string(error.what()).size() > 20);
        }
        CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < 20);
    }
    MESSAGE(read << " read, " << refused << " refused");
}
