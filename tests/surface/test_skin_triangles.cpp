// SPDX-License-Identifier: MIT
#include "sealed.h"
#include "support/check_skin.h"

#include <lacuna/core/error.h>
#include <lacuna/io/load_facets.h>
#include <lacuna/surface/shared/default_size.h>
#include <lacuna/surface/shared/skin_triangles.h>

#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>

using namespace lacuna;
using surface::even_size;
using surface::triangulate_skin;

namespace {

/// A closed surface from a grid that wraps round in both directions; one that closes in poles merges them.
topology::Model wrapped(int n, int m, const std::function<Vec3(double, double)>& at)
{
    healing::FacetSoup soup;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= m; ++j) soup.points.push_back(at(kFullTurn * i / n, kFullTurn * j / m));
    }
    const auto point = [&](int i, int j) { return static_cast<Index>(i * (m + 1) + j); };
    const auto add = [&](Index a, Index b, Index c) {
        const auto& p = soup.points;
        const double least = 1e-9;
        if ((p[index(a)] - p[index(b)]).norm() < least || (p[index(b)] - p[index(c)]).norm() < least ||
            (p[index(c)] - p[index(a)]).norm() < least)
            return;
        soup.triangles.push_back({a, b, c});
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            add(point(i, j), point(i + 1, j), point(i + 1, j + 1));
            add(point(i, j), point(i + 1, j + 1), point(i, j + 1));
        }
    }
    topology::Model model = healing::split_facets(soup);
    topology::orient_consistently(model);
    return model;
}

topology::Model oriented(test::PrismOptions options)
{
    topology::Model model = test::prism(options).model;
    topology::orient_consistently(model);
    return model;
}

struct Body {
    const char* name;
    topology::Model model;
    double size, angle;
};

std::vector<Body> bodies()
{
    const auto torus = [](double u, double v) {
        const double r = 2 + 0.7 * std::cos(v);
        return Vec3(r * std::cos(u), r * std::sin(u), 0.7 * std::sin(v));
    };
    const auto sphere = [](double u, double v) {
        const double turn = v / 2;
        return Vec3(std::sin(turn) * std::cos(u), std::sin(turn) * std::sin(u), -std::cos(turn));
    };
    std::vector<Body> all;
    all.push_back({"box", oriented({}), 0.3, 25});
    all.push_back({"coarse box", oriented({}), 30, 20});
    all.push_back({"thin plate", oriented({.height = 0.05}), 0.2, 20});
    all.push_back({"cylinder", oriented({.sides = 0, .cuts = 4}), 0.3, 25});
    all.push_back({"twisted", oriented({.cuts = 4, .levels = 8, .twist = 40}), 0.25, 20});
    all.push_back(
        {"bent", oriented({.sides = 0, .height = 4, .cuts = 4, .levels = 12, .bend = 90}), 0.3, 25});
    all.push_back({"barrel", oriented({.sides = 6, .cuts = 4, .levels = 8, .belly = 1.3}), 0.3, 20});
    all.push_back({"torus", wrapped(96, 48, torus), 0.3, 25});
    all.push_back({"sphere", wrapped(64, 64, sphere), 0.3, 25});
    return all;
}

bool same(const surface::SkinMesh& a, const surface::SkinMesh& b)
{
    return a.skin.points == b.skin.points && a.skin.triangles == b.skin.triangles &&
           a.skin.quads == b.skin.quads && a.triangle_face == b.triangle_face;
}

} // namespace

TEST_CASE("the skin of a body is closed and encloses its volume, with triangles of good shape")
{
    for (const Body& body : bodies()) {
        CAPTURE(body.name);
        const surface::SkinMesh mesh = triangulate_skin(body.model, even_size(body.size));
        test::check_closed(mesh.skin);
        const double volume = topology::volume_integral(body.model, topology::all_faces(body.model));
        CHECK(test::volume_within(mesh.skin) == doctest::Approx(volume).epsilon(0.01));
        CHECK(test::smallest_angle(mesh.skin) > body.angle);
        CHECK(mesh.triangle_face.size() == mesh.skin.triangles.size());
        CHECK(mesh.skin.quads.empty());
        for (const topology::Vertex& vertex : body.model.vertices)
            CHECK(std::ranges::count(mesh.skin.points, body.model.at(vertex.point)) == 1);
        const surface::SkinMesh again = triangulate_skin(body.model, even_size(body.size), {},
                                                         {3, nullptr, {}, {}});
        CHECK(same(mesh, again));
    }
}

TEST_CASE("half the size gives about four times as many triangles, and local sizes hold")
{
    const topology::Model box = oriented({});
    const auto count = [&](const surface::SizeField& size) {
        return static_cast<double>(triangulate_skin(box, size).skin.triangles.size());
    };
    const double whole = count(even_size(0.2)), half = count(even_size(0.1));
    CHECK(half > 3.3 * whole);
    CHECK(half < 4.7 * whole);
    const double local = count([](const Vec3& p) { return p.z() < 0.2 ? 0.1 : 0.2; });
    CHECK(local > 1.2 * whole);
    CHECK(local < half);
}

TEST_CASE("a fixed face keeps its quads, and its neighbours share their nodes")
{
    const topology::Model box = oriented({});
    const std::vector<FaceId> faces = topology::all_faces(box);
    const auto bottom = std::ranges::find_if(
        faces, [&](FaceId face) { return topology::face_centroid(box, face).z() < 1e-9; });
    REQUIRE(bottom != faces.end());
    const FaceId face = *bottom;
    std::vector<Vec3> corner;
    for (const topology::EdgeUse& use : box[face].loops.front().uses)
        corner.push_back(box.at(topology::use_points(box, use).front()));
    REQUIRE(corner.size() == 4);
    for (const int n : {1, 3, 12}) {
        CAPTURE(n);
        surface::FixedFace fixed{face, {}, {}};
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; j <= n; ++j) {
                const double u = double(i) / n, v = double(j) / n;
                fixed.nodes.push_back((1 - u) * (1 - v) * corner[0] + u * (1 - v) * corner[1] +
                                      u * v * corner[2] + (1 - u) * v * corner[3]);
            }
        }
        const auto node = [&](int i, int j) { return static_cast<Index>(i * (n + 1) + j); };
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j)
                fixed.quads.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
        }
        const surface::SkinMesh mesh = triangulate_skin(box, even_size(0.3), std::array{fixed});
        test::check_closed(mesh.skin);
        CHECK(mesh.skin.quads.size() == static_cast<std::size_t>(n * n));
        CHECK(std::ranges::count(mesh.quad_face, face) == n * n);
        CHECK(std::ranges::count(mesh.triangle_face, face) == 0);
        for (const Vec3& p : fixed.nodes) CHECK(std::ranges::count(mesh.skin.points, p) == 1);
        CHECK(test::smallest_angle(mesh.skin) > 15);
    }
}

TEST_CASE("an open skin is refused, and remeshing can be cancelled")
{
    const topology::Model open = test::prism({.drop = test::without(true, false, false)}).model;
    CHECK_THROWS_AS(triangulate_skin(open, even_size(0.3)), InvalidInput);
    const std::atomic<bool> cancel{true};
    CHECK_THROWS_AS(triangulate_skin(oriented({}), even_size(0.05), {}, {1, &cancel, {}, {}}), Cancelled);
}

TEST_CASE("sizes that are no lengths, or far too small, are refused")
{
    const auto refusal = [](double size) {
        try {
            triangulate_skin(oriented({}), even_size(size));
        } catch (const Error& error) {
            return error.code();
        }
        return std::string("none");
    };
    for (const double size : {0.0, -1.0, std::nan(""), double(INFINITY)})
        CHECK(refusal(size) == "sweep.size");
    for (const double size : {1e-5, 1e-9}) CHECK(refusal(size) == "surface.skin_count");
}

TEST_CASE("real facets get a closed skin of the same volume")
{
    const std::string folder = std::string(LACUNA_SOURCE_DIR) + "/../shared/data/stl/";
    for (const char* file : {"bracket_01.stl"}) {
        CAPTURE(file);
        if (!std::filesystem::exists(folder + file)) {
            MESSAGE("skipped: there is no " << folder + file);
            continue;
        }
        topology::Model model = io::load_facets({folder + file});
        topology::orient_consistently(model);
        const surface::SkinMesh mesh = triangulate_skin(model, even_size(model.diagonal / 20));
        test::check_closed(mesh.skin);
        const double volume = topology::volume_integral(model, topology::all_faces(model));
        CHECK(test::volume_within(mesh.skin) == doctest::Approx(volume).epsilon(0.01));
    }
}
