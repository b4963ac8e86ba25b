// SPDX-License-Identifier: GPL-2.0-or-later
#include "made_files.h"
#include "support/cancelling.h"
#include "support/refusal.h"
#include "support/whole_families.h"

#include <lacuna/cad/detail/worker.h>
#include <lacuna/cad/load.h>
#include <lacuna/mesh/tet_mesh.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

using namespace lacuna;
using mesh::ClosedSkin;
using mesh::TetMesh;
using test::refusal;

namespace {

using Map = std::function<Vec3(const Vec3&)>;

/// The skin of a grid of n[0] × n[1] × n[2] hexahedra on the unit cube, mapped. Sides 0 to 5 are x = 0,
/// x = 1, y = 0, …; those below `quad_sides` keep their quads, the others are cut into triangles.
ClosedSkin grid_skin(const std::array<int, 3>& n, int quad_sides, const Map& map = {})
{
    ClosedSkin skin;
    std::map<std::array<int, 3>, Index> numbers;
    const auto node = [&](const std::array<int, 3>& at) {
        const auto [place, is_new] = numbers.try_emplace(at, Index(skin.points.size()));
        if (is_new) {
            Vec3 p;
            for (std::size_t k = 0; k < 3; ++k) p[Eigen::Index(k)] = double(at[k]) / double(n[k]);
            skin.points.push_back(map ? map(p) : p);
        }
        return place->second;
    };
    for (int side = 0; side < 6; ++side) {
        const std::size_t axis = std::size_t(side) / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (int i = 0; i < n[u]; ++i) {
            for (int j = 0; j < n[v]; ++j) {
                const auto corner = [&](int di, int dj) {
                    std::array<int, 3> at{};
                    at[axis] = side % 2 == 0 ? 0 : n[axis];
                    at[u] = i + di;
                    at[v] = j + dj;
                    return node(at);
                };
                Quad q{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
                if (side % 2 == 0) std::swap(q[1], q[3]);
                if (side < quad_sides) {
                    skin.quads.push_back(q);
                } else {
                    skin.triangles.push_back({q[0], q[1], q[2]});
                    skin.triangles.push_back({q[0], q[2], q[3]});
                }
            }
        }
    }
    return skin;
}

Map ball(double radius, const Vec3& centre = Vec3::Zero())
{
    return [=](const Vec3& p) -> Vec3 {
        const Vec3 q = 2 * p - Vec3::Ones(), s = q.cwiseAbs2();
        return centre + radius * Vec3(q.x() * std::sqrt(1 - s.y() / 2 - s.z() / 2 + s.y() * s.z() / 3),
                                      q.y() * std::sqrt(1 - s.z() / 2 - s.x() / 2 + s.z() * s.x() / 3),
                                      q.z() * std::sqrt(1 - s.x() / 2 - s.y() / 2 + s.x() * s.y() / 3));
    };
}

ClosedSkin turned_inward(ClosedSkin skin)
{
    for (Triangle& t : skin.triangles) std::swap(t[1], t[2]);
    for (Quad& q : skin.quads) std::swap(q[1], q[3]);
    return skin;
}

ClosedSkin both(ClosedSkin a, const ClosedSkin& b)
{
    const auto first = Index(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (Triangle t : b.triangles) {
        for (Index& p : t) p += first;
        a.triangles.push_back(t);
    }
    for (Quad q : b.quads) {
        for (Index& p : q) p += first;
        a.quads.push_back(q);
    }
    return a;
}

ClosedSkin mapped(ClosedSkin skin, const Map& map)
{
    for (Vec3& p : skin.points) p = map(p);
    return skin;
}

/// With one point at each place.
ClosedSkin welded(const ClosedSkin& skin)
{
    ClosedSkin made{{}, skin.triangles, skin.quads};
    std::map<std::array<double, 3>, Index> places;
    std::vector<Index> number;
    for (const Vec3& p : skin.points) {
        const auto [place, is_new] = places.try_emplace({p.x(), p.y(), p.z()}, Index(made.points.size()));
        if (is_new) made.points.push_back(p);
        number.push_back(place->second);
    }
    for (Triangle& t : made.triangles)
        for (Index& p : t) p = number[index(p)];
    for (Quad& q : made.quads)
        for (Index& p : q) p = number[index(p)];
    return made;
}

double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
    return (b - a).cross(c - a).dot(d - a);
}

/// What a quad and a point enclose, the quad bilinear: the mean of its two ways to be cut, times six.
double six_volumes(const std::array<Vec3, 4>& q, const Vec3& apex)
{
    return (six_volumes(q[0], q[1], q[2], apex) + six_volumes(q[0], q[2], q[3], apex) +
            six_volumes(q[1], q[2], q[3], apex) + six_volumes(q[0], q[1], q[3], apex)) /
           2;
}

struct Shape {
    double worst_tet = 9, worst_pyramid = 9; ///< least scaled Jacobians, 1 if regular
    std::size_t tets = 0;
};

/// The rules of `fill_skin()`, proved without its code.
Shape check_fill(const ClosedSkin& skin, const TetMesh& mesh)
{
    Shape shape;
    REQUIRE(mesh.nodes.size() >= skin.points.size() + skin.quads.size());
    CHECK(std::equal(skin.points.begin(), skin.points.end(), mesh.nodes.begin()));
    const auto at = [&](Index i) -> const Vec3& { return mesh.nodes[index(i)]; };
    const auto jacobian = [&](Index here, Index a, Index b, Index c) {
        const Vec3 u = at(a) - at(here), v = at(b) - at(here), w = at(c) - at(here);
        const double volume = u.cross(v).dot(w);
        return volume > 0 ? std::sqrt(2.0) * volume / (u.norm() * v.norm() * w.norm()) : -1;
    };
    std::map<std::vector<Index>, int> faces;
    std::vector<bool> used(mesh.nodes.size(), false);
    const auto add = [&](std::vector<Index> face) {
        std::ranges::sort(face);
        ++faces[face];
    };
    double volume = 0;
    std::size_t pyramids = 0;
    for (const Hex& c : mesh.cells) {
        for (const Index i : c) used[index(i)] = true;
        if (mesh::is_tet(c)) {
            const std::array<Index, 4> t{c[0], c[1], c[2], c[4]};
            const double own = six_volumes(at(t[0]), at(t[1]), at(t[2]), at(t[3]));
            CHECK(own > 0);
            volume += own;
            shape.worst_tet = std::min({shape.worst_tet, jacobian(t[0], t[1], t[2], t[3]),
                                        jacobian(t[1], t[2], t[0], t[3]), jacobian(t[2], t[0], t[1], t[3]),
                                        jacobian(t[3], t[1], t[0], t[2])});
            ++shape.tets;
            for (std::size_t k = 0; k < 4; ++k) add({t[k], t[(k + 1) % 4], t[(k + 2) % 4]});
        } else {
            REQUIRE(mesh::is_pyramid(c));
            ++pyramids;
            for (std::size_t k = 0; k < 4; ++k) {
                shape.worst_pyramid = std::min(shape.worst_pyramid,
                                               jacobian(c[k], c[(k + 1) % 4], c[(k + 3) % 4], c[4]));
                add({c[k], c[(k + 1) % 4], c[4]});
            }
            add({c[0], c[1], c[2], c[3]});
            volume += six_volumes({at(c[0]), at(c[1]), at(c[2]), at(c[3])}, at(c[4]));
        }
    }
    CHECK(shape.worst_pyramid > 0);
    CHECK(pyramids == skin.quads.size());
    CHECK(std::ranges::count(used, false) == 0);
    double wanted = 0;
    const Vec3 origin = skin.points[0];
    const auto take = [&](std::vector<Index> face) {
        std::ranges::sort(face);
        REQUIRE(faces.count(face) == 1);
        CHECK(faces[face] == 1);
        faces.erase(face);
    };
    for (const Triangle& t : skin.triangles) {
        take({t.begin(), t.end()});
        wanted += six_volumes(origin, at(t[0]), at(t[1]), at(t[2]));
    }
    for (const Quad& q : skin.quads) {
        take({q.begin(), q.end()});
        wanted -= six_volumes({at(q[0]), at(q[1]), at(q[2]), at(q[3])}, origin);
    }
    CHECK(std::ranges::count_if(faces, [](const auto& face) { return face.second != 2; }) == 0);
    CHECK(volume == doctest::Approx(wanted).epsilon(1e-9));
    return shape;
}

/// A block of hexahedra whose nodes are moved at random, stretched, twisted and bent.
ClosedSkin random_block(unsigned seed)
{
    std::mt19937 dice(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * double(dice()) / 4294967296.0;
    };
    const std::array<int, 3> n{2 + int(dice() % 8), 2 + int(dice() % 8), 1 + int(dice() % 6)};
    const Vec3 size(between(0.3, 3), between(0.3, 3), between(0.1, 1));
    const double shake = between(0, 0.25) * std::min({size.x() / n[0], size.y() / n[1], size.z() / n[2]});
    const double twist = between(0, 0.8), bend = between(0.01, 0.8);
    return grid_skin(n, int(dice() % 7), [&](const Vec3& p) -> Vec3 {
        Vec3 q = p;
        for (int k = 0; k < 3; ++k) q[k] = size[k] * q[k] + shake * between(-1, 1);
        const double a = twist * q.x();
        q = Vec3(q.x(), std::cos(a) * q.y() - std::sin(a) * q.z(), std::sin(a) * q.y() + std::cos(a) * q.z());
        const double r = 1 / bend + q.z() + 2;
        return {r * std::sin(bend * q.x()), q.y(), r * std::cos(bend * q.x())};
    });
}

} // namespace

TEST_CASE("a skin is filled with positive cells that conform, a pyramid on each quad")
{
    const std::vector<std::pair<std::string, ClosedSkin>> skins{
        {"cube of triangles", grid_skin({5, 5, 5}, 0)},
        {"cube, quads on one side", grid_skin({5, 5, 5}, 1)},
        {"cube, quads on two sides that face each other", grid_skin({5, 5, 5}, 2)},
        {"cube, quads on five sides", grid_skin({5, 5, 5}, 5)},
        {"cube of quads", grid_skin({5, 5, 5}, 6)},
        {"one cube", grid_skin({1, 1, 1}, 6)},
        {"twelve triangles", grid_skin({1, 1, 1}, 0)},
        {"ball of triangles", grid_skin({8, 8, 8}, 0, ball(1))},
        {"ball of quads", grid_skin({8, 8, 8}, 6, ball(1))},
        {"thin plate", grid_skin({8, 8, 1}, 6, [](const Vec3& p) { return Vec3(p.x(), p.y(), p.z() / 20); })},
        {"long quads", grid_skin({4, 4, 4}, 6, [](const Vec3& p) { return Vec3(9 * p.x(), p.y(), p.z()); })},
        {"box with a cavity of triangles",
         both(grid_skin({6, 6, 6}, 0),
              turned_inward(grid_skin({4, 4, 4}, 0, ball(0.25, Vec3::Constant(0.5)))))},
        {"box with a cavity of quads",
         both(turned_inward(grid_skin({4, 4, 4}, 6, ball(0.25, Vec3::Constant(0.5)))),
              grid_skin({6, 6, 6}, 0))},
        {"box with two cavities",
         both(both(grid_skin({6, 6, 6}, 6),
                   turned_inward(grid_skin({3, 3, 3}, 6, ball(0.1, {0.3, 0.3, 0.3})))),
              turned_inward(grid_skin({3, 3, 3}, 0, ball(0.15, {0.7, 0.6, 0.6}))))}};
    for (const auto& [name, skin] : skins) {
        CAPTURE(name);
        const Shape shape = check_fill(skin, cad::fill_skin(skin));
        MESSAGE(name << ": " << shape.tets << " tetrahedra, least scaled Jacobians " << shape.worst_tet
                     << ", " << shape.worst_pyramid);
        CHECK(shape.worst_tet > 0.01);
        CHECK(shape.worst_pyramid > 0.05);
    }
}

TEST_CASE("parts of a skin may touch along shared sides and in shared points")
{
    for (const int quad_sides : {0, 6}) {
        CAPTURE(quad_sides);
        const ClosedSkin cube = grid_skin({4, 4, 4}, quad_sides);
        const ClosedSkin beside = mapped(cube, [](const Vec3& p) -> Vec3 { return p + Vec3(1, 1, 0); });
        const ClosedSkin along_an_edge = welded(both(cube, beside));
        check_fill(along_an_edge, cad::fill_skin(along_an_edge));
        const auto tip = [](const Vec3& p) -> Vec3 { // a corner of the cavity is a node of the side z = 1
            const Vec3 q = p - Vec3::Ones();
            return Vec3(0.5, 0.5, 1) +
                   0.2 * Vec3(q.x() - q.y(), q.x() + q.y() - q.z(), q.x() + q.y() + q.z());
        };
        const ClosedSkin cavity = turned_inward(grid_skin({2, 2, 2}, quad_sides, tip));
        const ClosedSkin in_a_point = welded(both(cube, cavity));
        REQUIRE(in_a_point.points.size() + 1 == cube.points.size() + cavity.points.size());
        check_fill(in_a_point, cad::fill_skin(in_a_point));
    }
}

TEST_CASE("pyramids on warped, long and flat quads are positive")
{
    test::MembersToRun run(6);
    int filled = 0, tried = 0;
    std::vector<double> tets, pyramids;
    for (unsigned seed = 1; seed <= 120; ++seed) {
        if (!run.next()) continue;
        CAPTURE(seed);
        const ClosedSkin skin = random_block(seed);
        ++tried;
        try {
            const Shape shape = check_fill(skin, cad::fill_skin(skin));
            ++filled;
            tets.push_back(shape.worst_tet);
            pyramids.push_back(shape.worst_pyramid);
        } catch (const NotSweepable& error) {
            MESSAGE(seed << " " << error.code() << ": " << std::string(error.what()));
        }
    }
    std::ranges::sort(tets);
    std::ranges::sort(pyramids);
    MESSAGE(filled << " of " << tried << ", median of the least scaled Jacobian: tetrahedra "
                   << tets[tets.size() / 2] << ", pyramids " << pyramids[pyramids.size() / 2]);
    CHECK(filled == tried);
    CHECK(tets[tets.size() / 2] > 0.01);
}

TEST_CASE("a skin of another scale or place gets the same mesh, scaled or moved")
{
    const ClosedSkin skin = grid_skin({6, 6, 6}, 3, ball(1));
    const TetMesh plain = cad::fill_skin(skin);
    for (const double scale : {std::exp2(-10), std::exp2(17)}) {
        CAPTURE(scale);
        const TetMesh mesh = cad::fill_skin(mapped(skin, [&](const Vec3& p) -> Vec3 { return scale * p; }));
        CHECK(mesh.cells == plain.cells);
        REQUIRE(mesh.nodes.size() == plain.nodes.size());
        for (std::size_t i = 0; i < mesh.nodes.size(); ++i) CHECK(mesh.nodes[i] == scale * plain.nodes[i]);
    }
    for (const double scale : {1e-3, 1e5}) {
        const ClosedSkin other = mapped(skin,
                                        [&](const Vec3& p) -> Vec3 { return scale * (p + Vec3(3, -7, 2)); });
        const TetMesh mesh = cad::fill_skin(other);
        check_fill(other, mesh);
        CHECK(double(mesh.cells.size()) == doctest::Approx(double(plain.cells.size())).epsilon(0.05));
    }
}

TEST_CASE("the same skin gives the same bytes, whatever the CAD process did before")
{
    const std::vector<ClosedSkin> skins{grid_skin({8, 8, 8}, 6, ball(1)), random_block(3),
                                        grid_skin({5, 5, 5}, 0)};
    std::vector<TetMesh> first;
    for (const ClosedSkin& skin : skins) first.push_back(cad::fill_skin(skin));
    for (const bool fresh : {false, true}) {
        if (fresh) test::kill_worker();
        for (std::size_t k = skins.size(); k-- > 0;) {
            RunContext context;
            context.threads = fresh ? 4 : 1;
            const TetMesh again = cad::fill_skin(skins[k], context);
            CHECK(again.nodes == first[k].nodes);
            CHECK(again.cells == first[k].cells);
        }
    }
}

TEST_CASE("a skin that encloses no volume is refused by name")
{
    const auto refused = [](const ClosedSkin& skin, const std::vector<std::string>& words) {
        return refusal([&] { (void)cad::fill_skin(skin); }, words);
    };
    const ClosedSkin cube = grid_skin({3, 3, 3}, 2);
    CHECK(refused({}, {"without faces"}) == "cad.skin_open");
    ClosedSkin open = cube;
    open.triangles.pop_back();
    CHECK(refused(open, {"not closed", "near ("}) == "cad.skin_open");
    ClosedSkin twisted = cube;
    std::swap(twisted.quads[0][1], twisted.quads[0][3]);
    CHECK(refused(twisted, {"oriented"}) == "cad.skin_open");
    ClosedSkin wild = cube;
    wild.triangles[0][0] = 4711;
    CHECK(refused(wild, {}) == "cad.skin_open");
    wild = cube;
    wild.points[0].x() = std::nan("");
    CHECK(refused(wild, {"finite"}) == "cad.skin_open");
    CHECK(refused(turned_inward(grid_skin({3, 3, 3}, 0)), {"0 outer parts"}) == "cad.skin_open");
    const Map away = [](const Vec3& p) -> Vec3 { return p + Vec3(5, 0, 0); };
    CHECK(refused(both(cube, mapped(cube, away)), {"2 outer parts"}) == "cad.skin_open");
    CHECK(cad::fill_skin(cube).cells.size() > 0);
}

TEST_CASE("a skin that crosses or touches itself is refused with the place, and the CAD process goes on")
{
    const auto refused = [](const ClosedSkin& skin, const std::vector<std::string>& words) {
        return refusal([&] { (void)cad::fill_skin(skin); }, words);
    };
    const ClosedSkin cube = grid_skin({3, 3, 3}, 2);
    const ClosedSkin moved = mapped(grid_skin({3, 3, 3}, 0),
                                    [](const Vec3& p) -> Vec3 { return p + Vec3(0.51, 0.13, 0.17); });
    CHECK(refused(both(grid_skin({3, 3, 3}, 0), moved), {"near (", "size"}) == "cad.skin_crosses");
    CHECK(refused(both(cube, turned_inward(moved)), {"near (", "size"}) == "cad.skin_crosses");
    ClosedSkin bent = grid_skin({3, 3, 3}, 0);
    bent.points[0] = Vec3(2, 2, 2); // a corner pulled through the cube
    CHECK(refused(bent, {"near ("}) == "cad.skin_crosses");
    ClosedSkin reflex = cube;
    const Quad& q = cube.quads[0];
    reflex.points[index(q[0])] = cube.points[index(q[2])] * 0.9 +
                                 (cube.points[index(q[1])] + cube.points[index(q[3])]) * 0.05;
    CHECK(refused(reflex, {"not convex", "size"}) == "cad.skin_quad");
    // A cavity that touches the outer skin in one point, with a point of its own.
    const ClosedSkin touching = both(
        grid_skin({2, 2, 2}, 0),
        turned_inward(mapped(grid_skin({1, 1, 1}, 0), [](const Vec3& p) -> Vec3 { return p / 2; })));
    CHECK((refused(touching, {"size"}).starts_with("cad.")));
    check_fill(cube, cad::fill_skin(cube));
}

TEST_CASE("the CAD process survives a failure of Gmsh")
{
    using namespace cad_protocol;
    const ClosedSkin cube = grid_skin({3, 3, 3}, 0);
    const ClosedSkin crossing = both(
        cube, mapped(cube, [](const Vec3& p) -> Vec3 { return p + Vec3(0.51, 0.13, 0.17); }));
    const auto told = [](const FillSkinRequest& request) {
        return refusal([&] {
            (void)cad::Worker::current()->ask<FillSkinReply>(Opcode::fill_skin, request,
                                                             {"a skin", "filling it"});
        });
    };
    CHECK(told({crossing.points, {crossing.triangles}}) == "cad.gmsh");
    check_fill(cube, cad::fill_skin(cube));
    ClosedSkin open = cube;
    open.triangles.pop_back();
    CHECK(told({open.points, {open.triangles}}) == "cad.gmsh");
    CHECK(told({{}, {}}) == "cad.protocol");
    CHECK(told({cube.points, {cube.triangles, {}}}) == "cad.protocol");
    CHECK(told({{}, {cube.triangles}}) == "cad.protocol");
    CHECK(told({{Vec3::Constant(std::nan("")), Vec3::Zero(), Vec3::Ones()}, {{{0, 1, 2}}}}) ==
          "cad.protocol");
    CHECK(told({std::vector<Vec3>(3, Vec3::Zero()), {{{0, 1, 2}}}}) != "done");
    check_fill(cube, cad::fill_skin(cube));
    std::mt19937 dice(11);
    for (int i = 0; i < 20; ++i) { // faces between any points
        FillSkinRequest request{cube.points, {cube.triangles}};
        for (int k = 0; k < 1 + i; ++k)
            request.shells[0][dice() % request.shells[0].size()][dice() % 3] = Index(dice() %
                                                                                     cube.points.size());
        (void)told(request);
    }
    check_fill(cube, cad::fill_skin(cube));
}

TEST_CASE("more than ten million tetrahedra are refused before they are made")
{
    const ClosedSkin fine = grid_skin({180, 180, 180}, 0);
    CHECK(refusal([&] { (void)cad::fill_skin(fine); }, {"1e+07", "size"}) == "cad.tet_count");
}

TEST_CASE("filling a skin is cancelled within half a second, and names a CAD process that is missing")
{
    const ClosedSkin skin = grid_skin({30, 30, 30}, 0, ball(1));
    CHECK(test::heeds_cancel([&](const RunContext& context) { (void)cad::fill_skin(skin, context); }));
    for (const int wait : {50, 400}) {
        const auto stopped = test::stops_within(
            std::chrono::milliseconds(wait),
            [&](const RunContext& context) { (void)cad::fill_skin(skin, context); });
        REQUIRE(stopped);
        CHECK(*stopped < 0.5);
    }
    const ClosedSkin cube = grid_skin({2, 2, 2}, 6);
    const std::string program = std::getenv("LACUNA_CAD");
    test::kill_worker();
    ::setenv("LACUNA_CAD", "/nowhere/lacuna-cad", 1);
    CHECK(refusal([&] { (void)cad::fill_skin(cube); }) == "cad.no_worker");
    ::setenv("LACUNA_CAD", program.c_str(), 1);
    check_fill(cube, cad::fill_skin(cube));
}
