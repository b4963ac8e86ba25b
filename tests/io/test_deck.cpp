// SPDX-License-Identifier: MIT
#include "support/folder.h"
#include "support/refusal.h"

#include <lacuna/io/deck.h>
#include <lacuna/io/detail/abaqus.h>
#include <lacuna/io/load_facets.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

using namespace lacuna;

namespace {

const std::string kSharedFiles = std::string(LACUNA_SOURCE_DIR) + "/../shared/data/";

using test::has;

std::string deck_failure(const std::string& name, const std::string& bytes)
{
    try {
        io::read_deck(name, bytes);
    } catch (const InvalidInput& error) {
        return error.code() + ": " + error.what();
    }
    return "";
}

/// One element of a shape with its nodes where they belong: corners on a reference cell that is turned and
/// stretched, others in the middles of sides and faces.
std::vector<Vec3> reference(io::DeckShape shape)
{
    const io::DeckShapeInfo& info = io::shape_info(shape);
    std::vector<Vec3> at;
    const std::vector<Vec3> hex{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    if (info.dimension == 2)
        at.assign(hex.begin(), hex.begin() + info.corners);
    else if (info.corners == 8)
        at = hex;
    else if (info.corners == 6)
        at = {hex[0], hex[1], hex[3], hex[4], hex[5], hex[7]};
    else if (info.corners == 5)
        at = {hex[0], hex[1], hex[2], hex[3], {0.5, 0.5, 1}};
    else
        at = {hex[0], hex[1], hex[3], hex[4]};
    if (info.corners == 3) at[2] = hex[3];
    Eigen::Matrix3d stretch;
    stretch << 2, 0.3, 0.1, -0.2, 3, 0.4, 0.1, 0.2, 5;
    for (Vec3& p : at) p = stretch * p + Vec3(10, 20, 30);
    if (info.nodes > info.corners)
        for (const auto& [a, b] : io::side_corners(shape)) at.push_back((at[index(a)] + at[index(b)]) / 2);
    return at;
}

/// Nastran lines in groups; each group's first line is a card, the others name what they go on from.
std::string dealt(std::vector<std::vector<std::string>> cards, std::mt19937& random)
{
    std::vector<std::string> lines;
    for (const auto& card : cards) lines.insert(lines.end(), card.begin(), card.end());
    std::shuffle(lines.begin(), lines.end(), random);
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

/// The nodes of the one element of a deck, in the order the deck gives them.
std::vector<Vec3> nodes_of(const io::Deck& deck)
{
    std::vector<Vec3> at;
    REQUIRE(deck.element_count() == 1);
    for (const Index node : deck.blocks[0].element(0)) at.push_back(deck.points[index(node)]);
    return at;
}

std::string number(double x)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", x);
    return std::string(text).find_first_of(".e") == std::string::npos ? std::string(text) + "." : text;
}

/// A deck of one element whose node k has the tag 100 + k; `order[i]` is the node that is written as its
/// i-th.
std::string one_element(const std::string& format, io::DeckShape shape, const std::string& word,
                        const std::vector<int>& order)
{
    const std::vector<Vec3> at = reference(shape);
    std::string text;
    const auto tag = [](std::size_t k) { return std::to_string(100 + k); };
    if (format == ".bdf") {
        for (std::size_t k = 0; k < at.size(); ++k)
            text += "GRID," + tag(k) + ",," + number(at[k].x()) + "," + number(at[k].y()) + "," +
                    number(at[k].z()) + "\n";
        text += word + ",7,3";
        for (std::size_t i = 0; i < order.size(); ++i) {
            if ((i + 2) % 8 == 0) text += ",\n";
            text += "," + tag(index(order[i]));
        }
        return text + "\n";
    }
    if (format == ".inp") {
        text = "*node\n";
        for (std::size_t k = 0; k < at.size(); ++k)
            text += tag(k) + ", " + number(at[k].x()) + ", " + number(at[k].y()) + ", " + number(at[k].z()) +
                    "\n";
        text += "*element, type=" + word + ", elset=Part A\n7";
        for (std::size_t i = 0; i < order.size(); ++i)
            text += (i == 14 ? ",\n" : ", ") + tag(index(order[i]));
        return text + "\n";
    }
    if (format == ".msh") {
        text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(at.size()) + "\n";
        for (std::size_t k = 0; k < at.size(); ++k)
            text += tag(k) + " " + number(at[k].x()) + " " + number(at[k].y()) + " " + number(at[k].z()) +
                    "\n";
        text += "$EndNodes\n$Elements\n1\n7 " + word + " 2 3 3";
        for (const int node : order) text += " " + tag(index(node));
        return text + "\n$EndElements\n";
    }
    text = "    -1\n  2411\n";
    for (std::size_t k = 0; k < at.size(); ++k)
        text += tag(k) + " 1 1 11\n " + number(at[k].x()) + " " + number(at[k].y()) + " " +
                number(at[k].z()) + "\n";
    text += "    -1\n    -1\n  2412\n7 " + word + " 1 1 7 " + std::to_string(order.size()) + "\n";
    for (std::size_t i = 0; i < order.size(); ++i)
        text += " " + tag(index(order[i])) + (i % 8 == 7 ? "\n" : "");
    return text + "\n    -1\n";
}

std::vector<int> straight(int count)
{
    std::vector<int> order;
    for (int k = 0; k < count; ++k) order.push_back(k);
    return order;
}

/// Boxes of hexes as a Nastran deck: nx × ny × nz, the property by cell; `joined`: nodes are shared.
std::string box_deck(int nx, int ny, int nz, const std::function<int(int, int, int)>& property)
{
    std::string text = "BEGIN BULK\n";
    const auto node = [&](int i, int j, int k) { return 1 + i + (nx + 1) * (j + (ny + 1) * k); };
    for (int k = 0; k <= nz; ++k)
        for (int j = 0; j <= ny; ++j)
            for (int i = 0; i <= nx; ++i)
                text += "GRID," + std::to_string(node(i, j, k)) + ",," + std::to_string(i) + ".," +
                        std::to_string(j) + ".," + std::to_string(k) + ".\n";
    int tag = 0;
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) {
                const int p = property(i, j, k);
                ++tag;
                if (p == 0) continue;
                const int n[8] = {node(i, j, k),
                                  node(i + 1, j, k),
                                  node(i + 1, j + 1, k),
                                  node(i, j + 1, k),
                                  node(i, j, k + 1),
                                  node(i + 1, j, k + 1),
                                  node(i + 1, j + 1, k + 1),
                                  node(i, j + 1, k + 1)};
                text += "CHEXA," + std::to_string(tag) + "," + std::to_string(p);
                for (int c = 0; c < 8; ++c) text += (c == 6 ? ",\n," : ",") + std::to_string(n[c]);
                text += "\n";
            }
    return text + "ENDDATA\n";
}

topology::Model load(const std::string& name, const std::string& bytes, const io::LoadOptions& options = {})
{
    const test::Folder folder;
    test::put_bytes(folder.file(name), bytes);
    return io::load_facets({folder.file(name)}, options);
}

std::map<std::string, std::size_t> quads_by_name(const topology::Model& model)
{
    std::map<std::string, std::size_t> count;
    for (const topology::Face& face : model.faces) count[face.name] += face.given_quads.size();
    return count;
}

} // namespace

TEST_CASE("middle nodes lie in the middle of their sides whichever order a format writes them in")
{
    using enum io::DeckShape;
    struct Case {
        const char* format;
        io::DeckShape shape;
        const char* word;
        std::vector<int> order;
    };
    const std::vector<int> brick = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15};
    const std::vector<int> prism = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11};
    const std::vector<Case> cases{
        {".bdf", tri3, "CTRIA3", straight(3)},
        {".bdf", tri6, "ctria6", straight(6)},
        {".bdf", quad4, "CQUADR", straight(4)},
        {".bdf", quad8, "CQUAD8", straight(8)},
        {".bdf", tet4, "CTETRA", straight(4)},
        {".bdf", tet10, "CTETRA", straight(10)},
        {".bdf", pyramid5, "CPYRAM", straight(5)},
        {".bdf", pyramid13, "CPYRAM", straight(13)},
        {".bdf", wedge6, "CPENTA", straight(6)},
        {".bdf", wedge15, "CPENTA", prism},
        {".bdf", hex8, "CHEXA", straight(8)},
        {".bdf", hex20, "CHEXA", brick},
        {".inp", tri3, "S3R", straight(3)},
        {".inp", tri6, "STRI65", straight(6)},
        {".inp", quad4, "s4r5", straight(4)},
        {".inp", quad8, "S8R", straight(8)},
        {".inp", tet4, "C3D4", straight(4)},
        {".inp", tet10, "C3D10M", straight(10)},
        {".inp", wedge6, "C3D6", straight(6)},
        {".inp", wedge15, "C3D15", straight(15)},
        {".inp", hex8, "C3D8I", straight(8)},
        {".inp", hex20, "C3D20R", straight(20)},
        {".unv", tri6, "92", {0, 3, 1, 4, 2, 5}},
        {".msh", quad8, "16", straight(8)},
        {".msh", tet10, "11", {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
        {".msh", pyramid13, "19", {0, 1, 2, 3, 4, 5, 8, 9, 6, 10, 7, 11, 12}},
        {".msh", wedge15, "18", {0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10}},
        {".msh", hex20, "17", {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14}},
        {".unv", quad8, "95", {0, 4, 1, 5, 2, 6, 3, 7}},
        {".unv", tet10, "118", {0, 4, 1, 5, 2, 6, 7, 8, 9, 3}},
        {".unv", wedge6, "112", straight(6)},
        {".unv", hex8, "115", straight(8)},
        {".unv", hex20, "116", {0, 8, 1, 9, 2, 10, 3, 11, 16, 17, 18, 19, 4, 12, 5, 13, 6, 14, 7, 15}},
    };
    for (const Case& one : cases) {
        CAPTURE(one.format);
        CAPTURE(one.word);
        const io::Deck deck = io::read_deck(std::string("x") + one.format,
                                            one_element(one.format, one.shape, one.word, one.order));
        REQUIRE(deck.blocks.size() == 1);
        CHECK(deck.blocks[0].shape == one.shape);
        CHECK(deck.blocks[0].tags == std::vector<io::DeckTag>{7});
        const std::vector<Vec3> wanted = reference(one.shape);
        const std::vector<Vec3> found = nodes_of(deck);
        REQUIRE(found.size() == wanted.size());
        for (std::size_t k = 0; k < found.size(); ++k) CHECK((found[k] - wanted[k]).norm() < 1e-6);
        for (std::size_t p = 0; p < deck.points.size(); ++p)
            CHECK(deck.point_tags[p] == static_cast<io::DeckTag>(100 + p));
    }
}

TEST_CASE("the faces of a solid, each once, close it and look out")
{
    for (std::size_t s = 0; s < mesh::kCellShapes; ++s) {
        const auto shape = static_cast<io::DeckShape>(s);
        if (io::shape_info(shape).dimension != 3) continue;
        const std::vector<Vec3> at = reference(shape);
        Vec3 sum = Vec3::Zero();
        Vec3 middle = Vec3::Zero();
        for (int k = 0; k < io::shape_info(shape).corners; ++k) middle += at[index(k)];
        middle /= io::shape_info(shape).corners;
        std::map<std::pair<int, int>, int> sides;
        for (const Quad& face : io::face_corners(shape)) {
            const std::size_t count = face[3] < 0 ? 3 : 4;
            Vec3 area = Vec3::Zero();
            for (std::size_t k = 0; k < count; ++k) {
                const Vec3& p = at[index(face[k])];
                const Vec3& q = at[index(face[(k + 1) % count])];
                area += (p - middle).cross(q - middle) / 2;
                ++sides[{face[k], face[(k + 1) % count]}];
            }
            CHECK(area.dot(at[index(face[0])] - middle) > 0);
            sum += area;
        }
        CHECK(sum.norm() < 1e-12);
        for (const auto& [side, count] : sides) {
            CHECK(count == 1);
            CHECK(sides.contains({side.second, side.first}));
        }
    }
}

TEST_CASE("the skin of regions is their free sides and, each once, the sides between them")
{
    // Two blocks on each other, the upper shorter: the face between them is parted from the free rest.
    const std::string deck = box_deck(4, 3, 4, [](int i, int, int k) { return k < 2 ? 1 : i < 2 ? 2 : 0; });
    const topology::Model model = load("x.bdf", deck);
    std::size_t quads = 0;
    for (const topology::Face& face : model.faces) quads += face.given_quads.size();
    const std::size_t lower = 2 * (4 * 2 + 3 * 2) + 2 * 12;
    const std::size_t upper = 2 * (2 * 2 + 3 * 2) + 2 * 6;
    CHECK(quads == lower + upper - 6);
    const auto names = quads_by_name(model);
    CHECK(names.at("pid:1") == lower - 6);
    CHECK(names.at("pid:2") == upper - 6);
    CHECK(names.at("pid:1|pid:2") == 6);
    CHECK(model.faces.size() == 6 + 5 + 1);
    for (const topology::Face& face : model.faces) {
        CHECK(face.kind == "plane");
        CHECK(face.regions.size() == (face.name == "pid:1|pid:2" ? 2 : 1));
    }
}

TEST_CASE("parts that touch without sharing nodes have one face between them, and all its nodes are found")
{
    std::string deck = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\n";
    int tag = 0;
    std::string cells;
    for (int part = 1; part <= 2; ++part) {
        for (int k = 0; k < 2; ++k)
            for (const char* at : {"0.,0.", "1.,0.", "1.,1.", "0.,1."})
                deck += "GRID," + std::to_string(100 * part + ++tag) + ",," + at + "," +
                        std::to_string(part - 1 + k) + ".\n";
        cells += "CHEXA," + std::to_string(part) + "," + std::to_string(part);
        for (int c = 0; c < 8; ++c)
            cells += (c == 6 ? ",\n," : ",") + std::to_string(100 * part + 8 * (part - 1) + c + 1);
        cells += "\n";
    }
    const test::Folder folder;
    test::put_bytes(folder.file("x.bdf"), deck + cells);
    const io::LoadedFiles loaded = io::load_files({folder.file("x.bdf")}, {.scale = 3});
    CHECK(loaded.model.faces.size() == 11);
    REQUIRE(loaded.decks.size() == 1);
    const io::NodesAt nodes = io::nodes_at(*loaded.decks[0], loaded.model.points, loaded.model.tolerance, 3);
    for (std::size_t p = 0; p < loaded.model.points.size(); ++p) {
        const double z = loaded.model.points[p].z() / 3;
        CHECK(nodes.at(p).size() == (z == 2 ? 1 : 2)); // the lowest lie on the loose nodes 1 to 4
        for (const Index node : nodes.at(p))
            CHECK((loaded.decks[0]->points[index(node)] * 3 - loaded.model.points[p]).norm() <=
                  loaded.model.tolerance);
    }
}

TEST_CASE("a shell deck whose elements have no property, or one each, is not a face an element")
{
    const int n = 8;
    for (const bool blank : {true, false}) {
        std::string deck;
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i)
                deck += "GRID," + std::to_string(1 + i + (n + 1) * j) + ",," + std::to_string(i) + ".," +
                        std::to_string(j) + ".,0.\n";
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const int tag = 1 + i + n * j;
                const int a = 1 + i + (n + 1) * j;
                deck += "CQUAD4," + std::to_string(tag) + "," + (blank ? "" : std::to_string(tag)) + "," +
                        std::to_string(a) + "," + std::to_string(a + 1) + "," + std::to_string(a + n + 2) +
                        "," + std::to_string(a + n + 1) + "\n";
            }
        const topology::Model model = load("x.bdf", deck);
        CHECK(model.faces.size() == 1);
        CHECK(model.faces[0].given_quads.size() == std::size_t(n * n));
    }
}

TEST_CASE("a shell face is cut where a face of another property meets it")
{
    // A plate with a rib across its middle and a rib half way in.
    std::string deck;
    const auto node = [](int i, int j, int k) { return 1 + i + 10 * j + 100 * k; };
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j <= 4; ++j)
            for (int i = 0; i <= 4; ++i)
                deck += "GRID," + std::to_string(node(i, j, k)) + ",," + std::to_string(i) + ".," +
                        std::to_string(j) + "., " + std::to_string(k) + ".\n";
    int tag = 0;
    const auto quad = [&](int property, int a, int b, int c, int d) {
        deck += "CQUAD4," + std::to_string(++tag) + "," + std::to_string(property);
        for (const int n : {a, b, c, d}) deck += "," + std::to_string(n);
        deck += "\n";
    };
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            quad(1, node(i, j, 0), node(i + 1, j, 0), node(i + 1, j + 1, 0), node(i, j + 1, 0));
    for (int j = 0; j < 4; ++j) quad(2, node(2, j, 0), node(2, j + 1, 0), node(2, j + 1, 1), node(2, j, 1));
    const topology::Model model = load("x.bdf", deck);
    CHECK(model.faces.size() == 3);
    CHECK(quads_by_name(model).at("pid:1") == 16);
}

TEST_CASE("sets, ranges, surfaces and sections of an Abaqus deck are understood")
{
    std::string deck = "*Heading\n a plate\n*NODE, NSET=nall\n";
    for (int j = 0; j <= 2; ++j)
        for (int i = 0; i <= 4; ++i)
            for (int k = 0; k <= 1; ++k)
                deck += std::to_string(1 + i + 5 * j + 100 * k) + ", " + std::to_string(i) + ", " +
                        std::to_string(j) + (k ? ", 1.\n" : "\n");
    deck += "*element, type=C3D8R, elset=Eall\n";
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 4; ++i) {
            const int a = 1 + i + 5 * j;
            deck += std::to_string(1 + i + 4 * j);
            for (const int n : {a, a + 1, a + 6, a + 5}) deck += ", " + std::to_string(n);
            for (const int n : {a + 100, a + 101, a + 106, a + 105})
                deck += (n == a + 100 ? ",\n " : ", ") + std::to_string(n);
            deck += "\n";
        }
    deck += "*ELSET, elset=LEFT, generate\n1, 5, 4\n2, 6, 4\n*ElSet, ElSet=right\n 3, 4,\n 7, 8\n"
            "*elset, elset=both\nleft, RIGHT\n*Nset, nset=corner\n1\n"
            "*surface, name=top\nleft, S2\n3, s2\n"
            "*Material, name=steel\n*Elastic\n 210000., 0.3\n"
            "*Solid Section, elset=LEFT, material=steel\n*SOLID SECTION, ELSET=right,\n MATERIAL=foam\n,\n";
    const io::Deck read = io::read_deck("x.inp", deck);
    CHECK(read.points.size() == 30);
    CHECK(read.element_count(3) == 8);
    std::map<std::string, const io::DeckSet*> sets;
    for (const io::DeckSet& set : read.sets) sets[set.name] = &set;
    CHECK(sets.at("LEFT")->members == std::vector<io::DeckTag>{1, 2, 5, 6});
    CHECK(sets.at("both")->members == std::vector<io::DeckTag>{1, 2, 3, 4, 5, 6, 7, 8});
    CHECK(sets.at("nall")->members.size() == 30);
    CHECK(sets.at("top")->sides.size() == 5);
    std::string texts;
    for (const io::DeckText& text : read.texts) texts += text.text;
    CHECK(has(texts, "210000., 0.3"));
    CHECK(has(texts, "*Heading\n a plate\n"));
    CHECK(!has(texts, "C3D8R"));
    const topology::Model model = load("x.inp", deck);
    const auto names = quads_by_name(model);
    CHECK(names.at("LEFT|right") == 2);
    CHECK(names.at("top") == 5);
    for (const topology::Face& face : model.faces)
        if (face.name == "top") CHECK((model.at(face.triangles[0][0]).z() == 1));
}

TEST_CASE("parts are put in place instance by instance, and numbers stay findable")
{
    const std::string part =
        "*Part, name=Block\n*Node\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n"
        "7,1,1,1\n8,0,1,1\n*Element, type=C3D8\n1,1,2,3,4,5,6,7,8\n*Elset, elset=own\n1\n"
        "*End Part\n";
    const std::string deck = part + "*Assembly, name=A\n*Instance, name=One, part=BLOCK\n*End Instance\n"
                                    "*Instance, name=Two, part=Block\n 1., 0., 0.\n"
                                    "1., 0., 0., 1., 0., 1., 90.\n*End Instance\n"
                                    "*Elset, elset=pair, instance=Two\n1\n*Elset, elset=pair\nOne.1\n"
                                    "*End Assembly\n";
    const io::Deck read = io::read_deck("x.inp", deck);
    REQUIRE(read.instances.size() == 2);
    CHECK(read.points.size() == 16);
    CHECK(read.element_count(3) == 2);
    CHECK(std::set<io::DeckTag>(read.point_tags.begin(), read.point_tags.end()).size() == 16);
    for (std::size_t p = 0; p < 8; ++p)
        CHECK(read.point_tags[8 + p] - read.instances[1].offset == static_cast<io::DeckTag>(p) + 1);
    // Translated by (1, 0, 0), then turned by 90° about the upright axis through (1, 0).
    CHECK((read.points[8 + 1] - Vec3(1, 1, 0)).norm() < 1e-12);
    CHECK((read.points[8 + 3] - Vec3(0, 0, 0)).norm() < 1e-12);
    std::map<std::string, std::size_t> sets;
    for (const io::DeckSet& set : read.sets) sets[set.name] = set.members.size();
    CHECK(sets == std::map<std::string, std::size_t>{{"One.own", 1}, {"Two.own", 1}, {"pair", 2}});
    CHECK(io::read_deck("x.inp", part).element_count() == 1);
    for (const auto& [wrong, words] : std::vector<std::pair<std::string, std::string>>{
             {"*Node\n1,0,x,0\n", "line 2"},
             {"*Element, type=C3D8\n1,1,2,3\n*Node\n", "line 2: expected 8 nodes"},
             {"*Node\n1,0,0,0\n*Element, type=S3\n1,1,1,9\n", "names node 9"},
             {"*Elset, elset=a\nb\n", "'b'"},
             {"*Elset, elset=a, generate\n1, 900000000, 1\n", "too many entries"},
             {"*Nset, nset=a, generate\n5, 1, 1\n", "increasing"},
             {"*Ngen\n1,5\n", "*NGEN"},
             {"*System\n1,2,3\n", "*SYSTEM"},
             {"*Include, input=/etc/passwd\n", "deck's folder"},
             {"*Instance, name=a, part=b\n", "'b'"},
             {"*Node\n1,0,0,0\n1,0,0,1\n", "node 1 is defined twice"}}) {
        CAPTURE(wrong);
        CHECK_MESSAGE(has(deck_failure("x.inp", wrong), words), deck_failure("x.inp", wrong));
    }
}

TEST_CASE("what is no mesh in a Nastran deck is kept as it stands, and what nodes and shells carry beside it")
{
    const std::string head = "SOL 101\nCEND\nTITLE = a plate\nBEGIN BULK\n";
    const std::string cards =
        "PSHELL         1       7     0.1\n$ a note\nMAT1,7,2.1+5,,0.3\nFORCE,1,1,0,1.,\n,0.,0.,1.\n"
        "CORD2R,5,0,0.,0.,0.,0.,0.,1.,\n,1.,0.,0.\nCBAR,9,2,1,2\n";
    const std::string deck =
        head + "GRDSET,,,,,,5,456\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.,0\nGRID,3,,0.,1.,0.,,12\n" + cards +
        "CTRIA3,4,1,1,2,3,30.,0.5\nENDDATA\n";
    const io::Deck read = io::read_deck("x.bdf", deck);
    REQUIRE(read.texts.size() == 3);
    CHECK(read.texts[0].text == head);
    CHECK(read.texts[1].text == cards);
    CHECK(read.texts[2].text == "ENDDATA\n");
    using More = std::vector<std::pair<std::size_t, std::string>>;
    CHECK(read.point_more == More{{0, "5,456"}, {1, "0,456"}, {2, "5,12"}});
    CHECK(read.blocks[0].more == More{{0, "30.,0.5"}});
    CHECK(read.regions[0].name == "pid:1");
    CHECK(read.regions[0].material == "7");
}

TEST_CASE("universal nodes in a frame that is turned or moved are refused")
{
    const std::string frame = "    -1\n  2420\n 1\npart\n 1 0 0\nframe\n 1. 0. 0.\n 0. 1. 0.\n 0. 0. 1.\n ";
    const std::string rest =
        "    -1\n  2411\n 1 1 1 11\n 0. 0. 0.\n 2 1 1 11\n 1. 0. 0.\n 3 1 1 11\n 0. 1. 0.\n    -1\n"
        "    -1\n  2412\n 1 91 1 1 7 3\n 1 2 3\n    -1\n";
    CHECK(deck_failure("x.unv", frame + "0. 0. 0.\n    -1\n" + rest).empty());
    CHECK(has(deck_failure("x.unv", frame + "0. 0. 5.\n    -1\n" + rest), "coordinate system 1"));
}

TEST_CASE("a compressed VTU file is read, and damage in it is found")
{
    // Two hexes on each other.
    const std::string head = "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\" "
                             "compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid>"
                             "<Piece NumberOfPoints=\"12\" NumberOfCells=\"2\">";
    const auto array = [](const char* type, const char* name, const char* data) {
        return std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" format=\"binary\">\n" +
               data + "\n</DataArray>";
    };
    const std::string text =
        head + "<Points>" +
        array("Float64", "Points",
              "AQAAAACAAAAgAQAAKAAAAA==eJxjYMAHPtjjlcaQh/GJ1YdLPy51uGgM4IBD3gGHfWjqEeIAtx8T8Q==") +
        "</Points><Cells>" +
        array("Int64", "connectivity",
              "AQAAAACAAACAAAAAKAAAAA==eJyNybcBACAMwLDQ2///MqAD8KLBEa/"
              "EwszKxsH++ScXDzcvEWAAWQ==") +
        array("Int64", "offsets", "AQAAAACAAAAQAAAADgAAAA==eJzjYIAAASgNAAEQABk=") +
        array("Int64", "types", "AQAAAACAAAAQAAAADgAAAA==eJzjYYAAHigNAAEwABk=") +
        "</Cells></Piece></UnstructuredGrid></VTKFile>";
    const io::Deck deck = io::read_deck("x.vtu", text);
    CHECK(deck.element_count(3) == 2);
    CHECK(deck.points.back() == Vec3(1, 1, 2));
    CHECK(load("x.vtu", text).faces.size() == 6);
    for (std::size_t at = text.find("eJx"); at < text.size(); at = text.find("eJ", at + 1)) {
        std::string wrong = text;
        wrong[at + 6] = wrong[at + 6] == 'A' ? 'B' : 'A';
        CHECK(has(deck_failure("x.vtu", wrong), "io.unreadable"));
    }
}

TEST_CASE("every shared deck has its nodes, elements and sets")
{
    struct Shared {
        const char* file;
        std::size_t points, shells, solids, sets, faces;
    };
    for (const Shared& shared : {Shared{"fem/salome_cube.unv", 216, 150, 125, 6, 6},
                                 Shared{"fem/nested_cubes.msh", 138, 240, 520, 14, 12},
                                 Shared{"fem/wingbox.bdf", 2675, 2464, 0, 0, 0},
                                 Shared{"fem/contact_model.bdf", 1080, 0, 675, 0, 18},
                                 Shared{"fem/codim_1-tube.inp", 120, 96, 0, 0, 1}}) {
        CAPTURE(shared.file);
        if (!std::filesystem::exists(kSharedFiles + shared.file)) {
            MESSAGE("skipped: there is no " << kSharedFiles + shared.file);
            continue;
        }
        const io::Deck deck = io::read_deck(kSharedFiles + shared.file);
        CHECK(deck.points.size() == shared.points);
        CHECK(deck.element_count(2) == shared.shells);
        CHECK(deck.element_count(3) == shared.solids);
        CHECK(deck.sets.size() == shared.sets);
        const io::LoadedFiles loaded = io::load_files({kSharedFiles + shared.file});
        if (shared.faces > 0) CHECK(loaded.model.faces.size() == shared.faces);
        const io::NodesAt nodes = io::nodes_at(deck, loaded.model.points, loaded.model.tolerance);
        for (std::size_t p = 0; p < loaded.model.points.size(); ++p) CHECK(!nodes.at(p).empty());
    }
}

TEST_CASE("named continuations of Nastran are found wherever they lie, and kept cards lose no line")
{
    std::mt19937 random(11);
    for (int trial = 0; trial < 60; ++trial) {
        CAPTURE(trial);
        std::vector<std::vector<std::string>> cards;
        std::string plain;
        for (int n = 1; n <= 27; ++n)
            cards.push_back({"GRID," + std::to_string(n) + ",," + std::to_string(n % 3) + ".," +
                             std::to_string(n / 3 % 3) + "." + "," + std::to_string(n / 9) + "."});
        for (int e = 1; e <= 4; ++e) {
            // Large fields in some, three lines and a half; small ones in others.
            char line[200];
            const bool large = (e + trial) % 2 == 0;
            const auto n = [&](int k) { return 1 + (7 * e + 5 * k) % 27; };
            std::vector<std::string> card;
            if (large) {
                std::snprintf(line, sizeof line, "CHEXA*  %16d%16d%16d%16d*A%d", e, 3, n(0), n(1), e);
                card.push_back(line);
                std::snprintf(line, sizeof line, "*A%-6d%16d%16d%16d%16d*B%d", e, n(2), n(3), n(4), n(5), e);
                card.push_back(line);
                std::snprintf(line, sizeof line, "*B%-6d%16d%16d", e, n(6), n(7));
                card.push_back(line);
            } else {
                std::snprintf(line, sizeof line, "CHEXA   %8d%8d%8d%8d%8d%8d%8d%8d+C%d", e, 3, n(0), n(1),
                              n(2), n(3), n(4), n(5), e);
                card.push_back(line);
                std::snprintf(line, sizeof line, "+C%-6d%8d%8d", e, n(6), n(7));
                card.push_back(line);
            }
            cards.push_back(card);
        }
        cards.push_back({"MAT9,5,1.,2.,3.,4.,5.,6.,7.,+M", "+M,8.,9.,10.,11."});
        cards.push_back({"PSOLID,3,5"});
        for (const auto& card : cards)
            for (const std::string& line : card) plain += line + "\n";
        const io::Deck expected = io::read_deck("a.bdf", plain);
        const std::string text = dealt(cards, random);
        CAPTURE(text);
        const io::Deck found = io::read_deck("a.bdf", text);
        const auto elements = [](const io::Deck& deck) {
            std::map<io::DeckTag, std::vector<io::DeckTag>> all;
            for (const io::DeckBlock& block : deck.blocks)
                for (std::size_t e = 0; e < block.count(); ++e)
                    for (const Index node : block.element(e))
                        all[block.tags[e]].push_back(deck.point_tags[index(node)]);
            return all;
        };
        CHECK(elements(found) == elements(expected));
        CHECK(found.points.size() == 27);
        REQUIRE(found.texts.size() == 1);
        for (const char* line : {"MAT9,5,1.", "+M,8.,9.", "PSOLID,3,5"})
            CHECK(has(found.texts[0].text, line));
        CHECK(!has(found.texts[0].text, "C1"));
    }
    // One that goes on nowhere is refused; a mark behind a card alone is none.
    const std::string flat = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\n";
    const std::string astray = flat + "CTRIA3,7,1,1,2,3,,,,+W\n+X,1,2\n";
    CHECK(has(deck_failure("a.bdf", astray),
              "line 4: CTRIA3: its continuation '+W' is missing, and the continuation '+X,1,2'"));
    CHECK(io::read_deck("a.bdf", flat + "CTRIA3,7,1,1,2,3,,,,+Y\nCTRIA3,8,1,1,2,3\n").element_count() == 2);
}

TEST_CASE("a keyword that continues on the next line of an Abaqus text ends there")
{
    const std::string text = "** before\n*SOLID SECTION, ELSET=A,\n MATERIAL=STEEL\n1., 2.,\n*STEP\n1, 2\n";
    const std::vector<io::AbaqusCard> cards = io::abaqus_cards(text);
    REQUIRE(cards.size() == 3);
    CHECK(cards[1].keyword.value("MATERIAL") == "STEEL");
    CHECK(cards[1].data == "1., 2.,\n");
    CHECK(cards[2].keyword.name == "STEP");
}
