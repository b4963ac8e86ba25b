// SPDX-License-Identifier: MIT
#include "support/blocks.h"
#include "support/check_valid.h"
#include "support/refusal.h"
#include "surface/sealed.h"

#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using sweep::SweepOptions;
using sweep::Swept;

namespace {

/// A quad as a set of places, whatever corner it starts from.
using Places = std::array<std::array<double, 3>, 4>;

Places places(const std::vector<Vec3>& nodes, const Quad& quad)
{
    Places result;
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3& p = nodes[static_cast<std::size_t>(quad[k])];
        result[k] = {p.x(), p.y(), p.z()};
    }
    std::sort(result.begin(), result.end());
    return result;
}

/// What a mesh is taken apart into: quads of its skin, by the part they belong to.
struct GivenSkin {
    std::vector<Vec3> nodes;
    std::vector<Quad> quads;
    std::vector<int> part; ///< 0 source, 1 target, 2 a wall
};

GivenSkin skin_of(const mesh::HexMesh& mesh)
{
    GivenSkin skin{mesh.nodes, {}, {}};
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::SkinQuad quad = mesh::skin_quad(mesh, i);
        skin.quads.push_back(quad.nodes);
        skin.part.push_back(static_cast<int>(quad.patch));
    }
    return skin;
}

/// Which quads are given, and how.
enum class Given { no, quads, triangles };

struct Opened {
    OpenVolume volume;
    std::set<Places> quads;  ///< that are given as quads
    std::vector<Vec3> nodes; ///< of given quads and triangles, all
};

/// The volume whose faces are parts of a skin.
Opened open(const GivenSkin& skin, const std::function<Given(int part, const Vec3& centre)>& given)
{
    healing::FacetSoup soup;
    soup.points = skin.nodes;
    soup.label_name = {"source", "target", "wall"};
    soup.label_keeps_nodes = {1, 1, 1};
    Opened opened;
    for (std::size_t i = 0; i < skin.quads.size(); ++i) {
        const Quad& q = skin.quads[i];
        Vec3 centre = Vec3::Zero();
        for (const Index n : q) centre += skin.nodes[static_cast<std::size_t>(n)] / 4;
        const Given how = given(skin.part[i], centre);
        if (how == Given::no) continue;
        for (const Index n : q) opened.nodes.push_back(skin.nodes[static_cast<std::size_t>(n)]);
        if (how == Given::quads) {
            soup.quads.push_back(q);
            soup.quad_label.push_back(skin.part[i]);
            opened.quads.insert(places(skin.nodes, q));
        } else {
            soup.triangles.push_back({q[0], q[1], q[2]});
            soup.triangles.push_back({q[0], q[2], q[3]});
            soup.triangle_label.insert(soup.triangle_label.end(), 2, skin.part[i]);
        }
    }
    Model model = healing::split_facets(soup);
    build_loops(model);
    orient_consistently(model);
    Roles roles;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const std::string& name = model.faces[f].name;
        (name == "source" ? roles.source : name == "target" ? roles.target : roles.walls).emplace_back(f);
    }
    opened.volume = open_volume(model, roles);
    return opened;
}

Swept filled(OpenVolume& volume, const SweepOptions& options)
{
    const bool ends = !volume.faces(Role::source).empty() && !volume.faces(Role::target).empty();
    closure::close(volume, ends ? matching::match(volume) : matching::Match{});
    return sweep::sweep(volume, options);
}

/// How many of the given quads are quads of the skin.
std::size_t kept(const mesh::HexMesh& mesh, const std::set<Places>& quads)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < mesh.skin_count(); ++i)
        count += quads.count(places(mesh.nodes, mesh::skin_quad(mesh, i).nodes));
    return count;
}

/// How many nodes of given faces that lie on the rim of the whole are none of the mesh.
std::size_t missing(const mesh::HexMesh& mesh, const std::vector<Vec3>& nodes)
{
    std::set<std::array<double, 3>> there;
    for (const Vec3& p : mesh.nodes) there.insert({p.x(), p.y(), p.z()});
    return static_cast<std::size_t>(std::count_if(nodes.begin(), nodes.end(), [&](const Vec3& p) {
        return !there.contains({p.x(), p.y(), p.z()});
    }));
}

/// Uneven in all directions, and not flat.
Vec3 uneven(const Vec3& p)
{
    const double x = p.x() + 0.12 * std::sin(3 * p.x() + 2 * p.y());
    const double y = p.y() * (1 + 0.3 * p.y()) + 0.05 * p.x();
    const double z = p.z() * (1 + 0.4 * p.z() + 0.2 * p.x() - 0.1 * p.y());
    return {x, y, z};
}

Vec3 twisted(const Vec3& p)
{
    const double angle = 0.5 * p.z();
    const double x = p.x() - 0.5, y = p.y() - 0.5;
    return {std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y,
            2 * p.z() * p.z() + p.z()};
}

Vec3 bent(const Vec3& p)
{
    const double angle = 1.2 * p.z(), radius = 2.5 - p.x();
    return {radius * std::cos(angle), p.y() * (1 + 0.2 * p.z()), radius * std::sin(angle)};
}

bool on_side(int part, const Vec3& before, int side)
{
    if (part != 2) return false;
    const double off[4] = {before.y(), 1 - before.x(), 1 - before.y(), before.x()};
    return off[side] < 1e-9;
}

/// Faces of a block that are left out, by class.
struct Missing {
    const char* value;
    std::function<bool(int part, const Vec3& before)> gone;
};

const std::vector<Missing> kMissing{
    {"I", [](int part, const Vec3&) { return part == 2; }},
    {"II", [](int part, const Vec3& p) { return on_side(part, p, 1) || on_side(part, p, 2); }},
    {"III", [](int part, const Vec3& p) { return on_side(part, p, 3); }},
    {"IV", [](int part, const Vec3&) { return part == 1; }},
    {"V", [](int part, const Vec3&) { return part < 2; }},
};

} // namespace

TEST_CASE("given quads of source, target and walls are faces of the mesh, bit for bit, in every class")
{
    struct Map {
        const char* name;
        Vec3 (*map)(const Vec3&);
    };
    const Map maps[] = {{"uneven", uneven}, {"twisted", twisted}, {"bent", bent}};
    int meshed = 0;
    for (const Map& map : maps) {
        for (const Missing& missing_faces : kMissing) {
            for (const int columns : {2, 5}) {
                const test::BlockOptions plain{.columns = columns, .rows = 4, .layers = 6};
                test::BlockOptions moved = plain;
                moved.map = map.map;
                const GivenSkin before = skin_of(test::block(plain)), skin = skin_of(test::block(moved));
                std::size_t next = 0;
                Opened opened = open(skin, [&](int part, const Vec3&) {
                    Vec3 centre = Vec3::Zero();
                    for (const Index n : before.quads[next])
                        centre += before.nodes[static_cast<std::size_t>(n)] / 4;
                    ++next;
                    return missing_faces.gone(part, centre) ? Given::no : Given::quads;
                });
                CAPTURE(map.name);
                CAPTURE(missing_faces.value);
                CAPTURE(columns);
                CHECK(to_string(classify(opened.volume).value) == missing_faces.value);
                SweepOptions options;
                options.layers.count = std::string(missing_faces.value) == "I" ? 6 : 0;
                const Swept result = filled(opened.volume, options);
                test::check_valid(result.mesh);
                CHECK(result.mesh.layers == 6);
                CHECK(kept(result.mesh, opened.quads) == opened.quads.size());
                ++meshed;
            }
        }
    }
    MESSAGE(meshed << " blocks, every given quad kept");
}

TEST_CASE("a void in a ring of given quads keeps the rows on both of its walls")
{
    const GivenSkin skin = skin_of(test::ring(14, 5));
    for (const bool target : {false, true}) {
        Opened opened = open(skin, [&](int part, const Vec3&) {
            return part == 2 || (part == 1 && target) ? Given::quads : Given::no;
        });
        const Swept result = filled(opened.volume, {});
        test::check_valid(result.mesh);
        CHECK(result.mesh.layers == 5);
        CHECK(kept(result.mesh, opened.quads) == opened.quads.size());
    }
}

TEST_CASE("nodes on the rims of given triangles are nodes of the mesh, on walls too")
{
    for (const Missing& missing_faces : kMissing) {
        const test::BlockOptions plain{.columns = 3, .rows = 4, .layers = 5};
        test::BlockOptions moved = plain;
        moved.map = uneven;
        const GivenSkin before = skin_of(test::block(plain)), skin = skin_of(test::block(moved));
        std::size_t next = 0;
        std::vector<Vec3> rim;
        Opened opened = open(skin, [&](int part, const Vec3&) {
            const std::size_t i = next++;
            Vec3 centre = Vec3::Zero();
            for (const Index n : before.quads[i]) centre += before.nodes[static_cast<std::size_t>(n)] / 4;
            if (missing_faces.gone(part, centre)) return Given::no;
            for (const Index n : before.quads[i]) {
                const Vec3& p = before.nodes[static_cast<std::size_t>(n)];
                const auto at_end = [](double x) { return x < 1e-9 || x > 1 - 1e-9; };
                const int ends = int(at_end(p.x())) + int(at_end(p.y())) + int(at_end(p.z()));
                if (ends > 1) rim.push_back(skin.nodes[static_cast<std::size_t>(n)]);
            }
            return Given::triangles;
        });
        CAPTURE(missing_faces.value);
        SweepOptions options;
        options.layers.count = 5;
        options.size = [](const Vec3&) { return 0.6; };
        const Swept result = filled(opened.volume, options);
        test::check_valid(result.mesh);
        CHECK(missing(result.mesh, rim) == 0);
    }
}

TEST_CASE("walls of other rows than the layers asked for are refused with both counts")
{
    const GivenSkin skin = skin_of(test::block({.columns = 3, .rows = 4, .layers = 5}));
    Opened opened = open(skin, [](int part, const Vec3&) { return part == 1 ? Given::no : Given::quads; });
    SweepOptions options;
    options.layers.count = 7;
    CHECK(test::refusal([&] { filled(opened.volume, options); }, {"5 rows", "7 layers"}) ==
          "sweep.given_rows");
}

TEST_CASE("walls that were meshed with different rows are refused by name, with both counts")
{
    const GivenSkin five = skin_of(test::block({.columns = 4, .rows = 4, .layers = 5}));
    const GivenSkin three = skin_of(test::block({.columns = 4, .rows = 4, .layers = 3}));
    GivenSkin both{five.nodes, {}, {}};
    const auto offset = static_cast<Index>(five.nodes.size());
    both.nodes.insert(both.nodes.end(), three.nodes.begin(), three.nodes.end());
    const auto add = [&](const GivenSkin& skin, Index shift,
                         const std::function<bool(int, const Vec3&)>& take) {
        for (std::size_t i = 0; i < skin.quads.size(); ++i) {
            Vec3 centre = Vec3::Zero();
            Quad quad = skin.quads[i];
            for (Index& n : quad) {
                centre += skin.nodes[static_cast<std::size_t>(n)] / 4;
                n += shift;
            }
            if (!take(skin.part[i], centre)) continue;
            both.quads.push_back(quad);
            both.part.push_back(skin.part[i]);
        }
    };
    add(five, 0, [](int part, const Vec3& p) { return part < 2 || on_side(part, p, 0); });
    add(three, offset, [](int part, const Vec3& p) { return on_side(part, p, 2); });
    Opened opened = open(both, [](int, const Vec3&) { return Given::quads; });
    CHECK(test::refusal([&] { filled(opened.volume, {}); }, {" 5", " 3", "rows of quads"}) ==
          "surface.wall_rows");
}

TEST_CASE("given wall quads that are no rows are refused, the first of them named by its place")
{
    // A quad of the wall is cut into five: the four round it are in no row.
    GivenSkin skin = skin_of(test::block({.columns = 3, .rows = 3, .layers = 3}));
    std::size_t cut = 0;
    for (std::size_t i = 0; i < skin.quads.size(); ++i) {
        Vec3 centre = Vec3::Zero();
        for (const Index n : skin.quads[i]) centre += skin.nodes[static_cast<std::size_t>(n)] / 4;
        if (skin.part[i] == 2 && (centre - Vec3(0.5, 0, 0.5)).norm() < 1e-9) cut = i;
    }
    const Quad outer = skin.quads[cut];
    Vec3 middle = Vec3::Zero();
    for (const Index n : outer) middle += skin.nodes[static_cast<std::size_t>(n)] / 4;
    Quad inner{};
    for (std::size_t k = 0; k < 4; ++k) {
        inner[k] = static_cast<Index>(skin.nodes.size());
        skin.nodes.push_back((middle + skin.nodes[static_cast<std::size_t>(outer[k])]) / 2);
    }
    skin.quads[cut] = inner;
    for (std::size_t k = 0; k < 4; ++k) {
        skin.quads.push_back({outer[k], outer[(k + 1) % 4], inner[(k + 1) % 4], inner[k]});
        skin.part.push_back(2);
    }
    Opened opened = open(skin, [](int part, const Vec3&) { return part == 1 ? Given::no : Given::quads; });
    CHECK(test::refusal([&] { filled(opened.volume, {}); }, {"rows", "wall"}) == "surface.wall_not_rows");
}

TEST_CASE("a rim with an odd number of given sides is filled, and the side that is divided is said")
{
    const GivenSkin skin = skin_of(test::ring(9, 4));
    Opened opened = open(skin, [](int part, const Vec3& p) {
        return part == 2 && p.head<2>().norm() > 1.4 ? Given::quads : Given::no;
    });
    const Swept result = filled(opened.volume, {});
    test::check_valid(result.mesh);
    CHECK(kept(result.mesh, opened.quads) + 4 == opened.quads.size());
    CHECK(missing(result.mesh, opened.nodes) == 0);
    CHECK(std::any_of(result.report.begin(), result.report.end(), [](const std::string& line) {
        return line.find("odd number of sides") != std::string::npos;
    }));
}

TEST_CASE("a source of quads and triangles is meshed anew inside its rim, and both are counted")
{
    const GivenSkin skin = skin_of(test::block({.columns = 4, .rows = 4, .layers = 3}));
    Opened opened = open(skin, [](int part, const Vec3& p) {
        if (part != 0) return part == 2 ? Given::quads : Given::no;
        return p.x() < 0.5 ? Given::quads : Given::triangles;
    });
    const Swept result = filled(opened.volume, {});
    test::check_valid(result.mesh);
    CHECK(std::any_of(result.report.begin(), result.report.end(), [](const std::string& line) {
        return line.find("8 quads and 16 triangles") != std::string::npos;
    }));
}
