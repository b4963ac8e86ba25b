// SPDX-License-Identifier: MIT
#include "support/measure_sources.h"
#include "support/source_family.h"

#include <lacuna/mesh/shared/incidence.h>
#include <lacuna/quads/shared/pave.h>
#include <lacuna/surface/detail/raise_quads.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/surface/shared/projector.h>

#include <doctest/doctest.h>

#include <cmath>
#include <set>

using namespace lacuna;

namespace {

/// Source faces meshed, what their nodes may do, and all of them shaken.
struct Shaken {
    surface::SourceMesh mesh;
    surface::NodeFreedom freedom;
    std::set<Index> fixed;
};

double least(const surface::SourceMesh& mesh, double size)
{
    return test::measure_union(mesh, size).min_scaled_jacobian;
}

Shaken shaken(const test::FamilySource& own, double quads, double by)
{
    double area = 0;
    for (const FaceId face : own.volume.faces(topology::Role::source))
        area += topology::face_area(own.volume.model, face);
    const double h = std::sqrt(area / quads);
    const surface::SizeField size = [h](const Vec3&) { return h; };
    const auto links = surface::linking_surfaces(own.volume);
    const surface::Seeds seeds = surface::seed_source(own.volume, links, size, surface::QuadStyle::automatic,
                                                      {.curvature = 0});
    Shaken result{surface::mesh_source(own.volume, links, seeds, {size, {}},
                                       [](const quads::PlanarRegion& region, const RunContext& c) {
                                           return quads::pave(region, {}, c).mesh;
                                       }),
                  {},
                  {}};
    mesh::QuadMesh& mesh = result.mesh.quads;
    for (const auto& loop : mesh.loops) result.fixed.insert(loop.begin(), loop.end());
    std::set<Index> on_edges = result.fixed;
    unsigned seed = 12345;
    const auto random = [&seed] {
        seed = seed * 1664525u + 1013904223u;
        return 2 * (seed >> 8) / double(1u << 24) - 1;
    };
    for (const auto& [edge, nodes] : result.mesh.on_edge) {
        on_edges.insert(nodes.begin(), nodes.end());
        result.fixed.insert({nodes.front(), nodes.back()});
        if (nodes.size() < 3 || result.fixed.contains(nodes[1])) continue;
        surface::NodeFreedom::OnEdge free{edge, nodes, seeds.fractions(edge)};
        const std::vector<double> even = free.at;
        for (std::size_t i = 1; i + 1 < even.size(); ++i)
            free.at[i] += by * random() * (even[i + 1] - even[i - 1]) / 2;
        const std::vector<Vec3> points = surface::edge_points(own.volume.model, edge, free.at);
        for (std::size_t i = 1; i + 1 < even.size(); ++i) mesh.nodes[index(nodes[i])] = points[i];
        result.freedom.edges.push_back(std::move(free));
    }
    for (const FaceId face : own.volume.faces(topology::Role::source)) {
        std::set<Index> inside;
        for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
            if (mesh.face[q] != static_cast<Index>(face.index())) continue;
            for (const Index p : mesh.quads[q]) {
                if (!on_edges.contains(p)) inside.insert(p);
            }
        }
        if (inside.empty()) continue;
        std::vector<Vec3> moved;
        for (const Index p : inside)
            moved.push_back(mesh.nodes[index(p)] + by * h * Vec3(random(), random(), random()));
        surface::Projector(own.volume.model, {face}).project(moved);
        std::size_t next = 0;
        for (const Index p : inside) mesh.nodes[index(p)] = moved[next++];
        result.freedom.faces.push_back({face, *inside.begin(), *inside.rbegin() + 1});
    }
    return result;
}

} // namespace

TEST_CASE("poor quads over several faces get better, on edges and faces, and the rim stays")
{
    int poor = 0, mended = 0;
    for (const test::FamilySource& own : test::source_family()) {
        for (const double by : {0.0, 0.2, 0.3}) {
            CAPTURE(own.name);
            CAPTURE(by);
            const topology::Model& model = own.volume.model;
            Shaken source = shaken(own, 150, by);
            const double before = least(source.mesh, 1);
            const mesh::QuadMesh old = source.mesh.quads;
            const auto moved = surface::raise_poor_quads(source.mesh.quads, model, source.freedom);
            const double after = least(source.mesh, 1);
            CHECK(after >= before);
            if (before > 0 && before < 0.5) ++poor;
            if (before > 0 && before < 0.5 && after >= 0.5) ++mended;
            const std::vector<Vec3>& nodes = source.mesh.quads.nodes;
            if (before >= 0.6) CHECK(nodes == old.nodes);
            CHECK(source.mesh.quads.quads == old.quads);
            for (const Index p : source.fixed) CHECK(nodes[index(p)] == old.nodes[index(p)]);
            for (const surface::NodeFreedom::OnEdge& edge : source.freedom.edges) {
                const auto found = moved.find(edge.edge);
                const std::vector<double>& at = found != moved.end() ? found->second : edge.at;
                CHECK(std::is_sorted(at.begin(), at.end()));
                const std::vector<Vec3> points = surface::edge_points(model, edge.edge, at);
                for (std::size_t i = 1; i + 1 < at.size(); ++i)
                    CHECK((points[i] - nodes[index(edge.nodes[i])]).norm() <= model.tolerance);
            }
            for (const surface::NodeFreedom::OnFace& face : source.freedom.faces) {
                std::vector<Vec3> on_face(nodes.begin() + face.first, nodes.begin() + face.last);
                surface::Projector(model, {face.face}).project(on_face);
                for (Index p = face.first; p < face.last; ++p)
                    CHECK((on_face[index(p - face.first)] - nodes[index(p)]).norm() <= model.tolerance);
            }
        }
    }
    CAPTURE(poor);
    CAPTURE(mended);
    CHECK(poor >= 20);
    CHECK(mended >= 0.8 * poor);
}
