// SPDX-License-Identifier: MIT
#include "families.h"

#include <lacuna/core/error.h>
#include <lacuna/sweep/detail/morph.h>
#include <lacuna/sweep/detail/surface_smoothing.h>
#include <lacuna/sweep/shared/layers.h>

#include <doctest/doctest.h>

using namespace lacuna;
using namespace lacuna::test;
using sweep::morph;
using sweep::SurfaceProjector;
using sweep::worst_quad;

namespace {

/// Closest point of a sphere.
SurfaceProjector sphere(const Vec3& centre, double radius)
{
    return [=](std::span<Vec3> points) {
        for (Vec3& p : points) {
            const Vec3 out = p - centre;
            p = centre + radius * (out.norm() > 0 ? Vec3(out.normalized()) : Vec3(Vec3::UnitZ()));
        }
    };
}

/// Closest point of the part of a sphere above a height.
SurfaceProjector sphere_above(const Vec3& centre, double radius, double height)
{
    return [=](std::span<Vec3> points) {
        sphere(centre, radius)(points);
        const double rim = std::sqrt(radius * radius - (height - centre[2]) * (height - centre[2]));
        for (Vec3& p : points) {
            if (p[2] >= height) continue;
            const double length = std::hypot(p[0] - centre[0], p[1] - centre[1]);
            const Vec3 out = length > 0 ? Vec3((p[0] - centre[0]) / length, (p[1] - centre[1]) / length, 0)
                                        : Vec3::UnitX();
            p = Vec3(centre[0], centre[1], height) + rim * out;
        }
    };
}

SurfaceProjector plane(double height)
{
    return [=](std::span<Vec3> points) {
        for (Vec3& p : points) p[2] = height;
    };
}

/// One layer of columns from the source's rim to where `map` takes it.
sweep::RimColumns columns_to(const mesh::QuadMesh& source, const Map& map)
{
    return columns_along(source, 1, [&](const Vec3& p, double) { return map(p); });
}

void check_rim(const sweep::RimColumns& columns, const std::vector<Vec3>& nodes)
{
    std::size_t astray = 0;
    for (std::size_t k = 0; k < columns.rim.size(); ++k) {
        if (nodes[static_cast<std::size_t>(columns.rim[k])] != columns.row(columns.layers)[k]) ++astray;
    }
    CHECK(astray == 0);
}

/// The rim's circle on a sphere whose cap opens by `degrees` from its top.
struct Cap {
    Vec3 centre;
    double radius;
    SurfaceProjector projector() const { return sphere_above(centre, radius, 2); }
    explicit Cap(double degrees)
    {
        const double angle = degrees * std::numbers::pi / 180;
        radius = 1 / std::sin(angle);
        centre = Vec3(0, 0, 2 - radius * std::cos(angle));
    }
};

} // namespace

TEST_CASE("an affine image that lies on the target is left as it is")
{
    const Map map = [](const Vec3& p) { return Vec3(2 * p[0] + p[1] + 1, p[1] - 0.5 * p[0], 3); };
    for (const Family& family : planar_families()) {
        CAPTURE(family.name);
        const auto columns = columns_to(family.mesh, map);
        for (const bool projected : {false, true}) {
            const auto result = morph(family.mesh, columns, projected ? plane(3) : SurfaceProjector());
            check_rim(columns, result.nodes);
            for (std::size_t i = 0; i < result.nodes.size(); ++i) {
                CHECK((result.nodes[i] - map(family.mesh.nodes[i])).norm() < 1e-12);
            }
        }
    }
}

TEST_CASE("on caps from shallow to deep, nodes lie on the sphere and quads stay good")
{
    for (const double degrees : {5.0, 30.0, 60.0, 80.0, 90.0, 110.0, 130.0}) {
        CAPTURE(degrees);
        const Cap cap(degrees);
        for (const Family& family : {Family{"disc", disc(6, 4)}, Family{"fine disc", disc(14, 8)}}) {
            CAPTURE(family.name);
            const auto columns = columns_to(family.mesh, [](const Vec3& p) { return Vec3(p[0], p[1], 2); });
            const auto result = morph(family.mesh, columns, cap.projector());
            check_rim(columns, result.nodes);
            for (const Vec3& p : result.nodes) CHECK(std::abs((p - cap.centre).norm() - cap.radius) < 1e-12);
            CHECK(result.worst == doctest::Approx(worst_quad(family.mesh.quads, result.nodes)));
            CHECK(result.worst > 0.3);
            // The cells under the dome, straight columns at its rim: beyond 90 degrees it leans out over
            // them.
            if (degrees > 90) continue;
            const auto walls = columns_along(family.mesh, 6, lifted(2));
            const auto layers = sweep::place_layers(family.mesh, result.nodes, walls);
            CHECK(worst_hex(family.mesh, layers.nodes, 6) > 0);
        }
    }
}

TEST_CASE("a bowl is morphed to a flat target without folding")
{
    for (const double degrees : {30.0, 60.0, 90.0}) {
        CAPTURE(degrees);
        const Cap cap(degrees);
        const auto flat = disc(8, 5);
        const auto onto = columns_to(flat, [](const Vec3& p) { return Vec3(p[0], p[1], 2); });
        auto bowl = flat;
        bowl.nodes = morph(flat, onto, cap.projector()).nodes;
        const auto columns = columns_to(bowl, [](const Vec3& p) { return Vec3(p[0], p[1], 5); });
        const auto result = morph(bowl, columns, plane(5));
        check_rim(columns, result.nodes);
        CHECK(result.worst > 0.3);
    }
}

TEST_CASE("a square becomes a disc, an L bends, and no quad folds")
{
    const auto round = [](const Vec3& p) {
        const double reach = std::max(std::abs(p[0]), std::abs(p[1]));
        const double length = std::hypot(p[0], p[1]);
        return Vec3(p[0] * reach / length, p[1] * reach / length, 2);
    };
    for (const int count : {2, 6, 20}) {
        const auto mesh = square(count);
        const auto columns = columns_to(mesh, round);
        const auto result = morph(mesh, columns, plane(2));
        check_rim(columns, result.nodes);
        CHECK(result.worst > 0);
    }
    const auto mesh = l_shape(8);
    const auto bend = [](const Vec3& p) {
        return Vec3(p[0] + 0.2 * p[1] * p[1], p[1] + 0.3 * std::sin(2 * p[0]), 2);
    };
    const auto result = morph(mesh, columns_to(mesh, bend), plane(2));
    CHECK(result.worst > 0.5);
}

TEST_CASE("smoothing never makes the worst quad worse, and mends one that was pulled out of place")
{
    for (const Family& family : planar_families()) {
        CAPTURE(family.name);
        std::vector<Index> free_nodes;
        const auto rim = rim_nodes(family.mesh);
        for (std::size_t i = 0; i < family.mesh.nodes.size(); ++i) {
            if (std::find(rim.begin(), rim.end(), static_cast<Index>(i)) == rim.end())
                free_nodes.push_back(static_cast<Index>(i));
        }
        if (free_nodes.empty()) continue;
        const auto graph = sweep::node_graph(family.mesh.quads, family.mesh.nodes.size());
        const auto weights = sweep::side_weights(graph, family.mesh.quads, family.mesh.nodes);
        const sweep::HarmonicSpread spread(graph, weights, rim);
        const SurfaceProjector project = plane(0);
        const sweep::SurfaceSmoother smoother(family.mesh, graph, weights, spread, free_nodes, project);
        for (const Index pulled : free_nodes) {
            auto nodes = family.mesh.nodes;
            nodes[static_cast<std::size_t>(pulled)] += Vec3(0.3, 0.2, 0);
            const double before = worst_quad(family.mesh.quads, nodes);
            const double model = worst_quad(family.mesh.quads, family.mesh.nodes);
            const auto relaxed = smoother.relax(nodes, model - 0.01, {});
            const auto polished = smoother.polish(nodes, model - 0.01, {});
            CHECK(worst_quad(family.mesh.quads, relaxed) >= before);
            CHECK(worst_quad(family.mesh.quads, relaxed) > model - 0.1);
            CHECK(worst_quad(family.mesh.quads, polished) >= before);
        }
    }
}

TEST_CASE("a tube is morphed to a wider tube that bulges")
{
    const auto skin = tube(24, 8);
    const SurfaceProjector barrel = [](std::span<Vec3> points) {
        for (Vec3& p : points) {
            const double wide = 2 + 0.3 * p[2] * (2 - p[2]);
            const double length = std::hypot(p[0], p[1]);
            p = Vec3(p[0] * wide / length, p[1] * wide / length, p[2]);
        }
    };
    const auto columns = columns_to(skin, [](const Vec3& p) { return Vec3(2 * p[0], 2 * p[1], p[2]); });
    const auto result = morph(skin, columns, barrel);
    check_rim(columns, result.nodes);
    CHECK(result.worst > 0.9);
}

TEST_CASE("a finely graded mesh keeps its grading on a curved target")
{
    // Rings crowd to the rim, as a boundary layer does.
    const auto graded = mapped(disc(6, 8), [](const Vec3& p) {
        const double length = std::hypot(p[0], p[1]);
        const double scale = length > 0.5 ? (1 - std::pow(2 * (1 - length), 2) / 2) / length : 1;
        return Vec3(scale * p[0], scale * p[1], 0);
    });
    const Cap cap(60);
    const auto columns = columns_to(graded, [](const Vec3& p) { return Vec3(p[0], p[1], 2); });
    const auto result = morph(graded, columns, cap.projector());
    CHECK(result.worst > 0.3);
    const std::size_t last_ring = graded.nodes.size() - 24;
    for (std::size_t i = last_ring; i < graded.nodes.size(); ++i) {
        const double thin = (graded.nodes[i] - graded.nodes[i - 24]).norm();
        const double morphed = (result.nodes[i] - result.nodes[i - 24]).norm();
        CHECK(morphed / thin > 0.5);
        CHECK(morphed / thin < 2);
    }
}

TEST_CASE("the morphed nodes do not depend on the number of threads")
{
    const auto mesh = disc(10, 6);
    const Cap cap(90);
    const auto columns = columns_to(mesh, [](const Vec3& p) { return Vec3(p[0], p[1], 2); });
    RunContext context;
    context.threads = 1;
    const auto first = morph(mesh, columns, cap.projector(), context).nodes;
    for (const int threads : {2, 5}) {
        context.threads = threads;
        CHECK(morph(mesh, columns, cap.projector(), context).nodes == first);
    }
}
