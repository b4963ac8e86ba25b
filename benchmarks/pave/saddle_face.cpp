// SPDX-License-Identifier: GPL-2.0-or-later
#include "saddle_face.h"

#include <lacuna/cad/load.h>
#include <lacuna/cad_worker/session.h>
#include <lacuna/quads/shared/pave.h>
#include <lacuna/surface/shared/edge_nodes.h>

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <unordered_map>

namespace lacuna::bench {

namespace {

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Half the side of the untrimmed surface's plan, and its control points each way.
constexpr double kHalf = 1.5;
constexpr int kControls = 12;
constexpr int kDegree = 3;

double height(double x, double y)
{
    return (x * x - y * y) / 2 + 0.05 * std::sin(3 * x + 1) * std::sin(2.5 * y);
}

/// Where control point i lies in plan so that the plan is linear in the parameter: its Greville place.
double control_place(int i)
{
    constexpr int kSpans = kControls - kDegree;
    double sum = 0;
    for (int k = 1; k <= kDegree; ++k) sum += std::clamp(i + k - kDegree, 0, kSpans);
    return kHalf * (2 * sum / (kDegree * kSpans) - 1);
}

/// The rim in the surface's parameters: four cubics that bulge out and in.
int draw_rim()
{
    const std::array<Vec2, 4> corner{Vec2(-1, -1), Vec2(1.1, -0.9), Vec2(1, 1.1), Vec2(-0.9, 0.9)};
    const std::array<double, 4> bulge{0.25, -0.2, 0.3, 0.15};
    const auto add = [](const Vec2& p) {
        return gmsh::model::occ::addPoint((p.x() / kHalf + 1) / 2, (p.y() / kHalf + 1) / 2, 0);
    };
    std::array<int, 4> at{};
    for (std::size_t i = 0; i < 4; ++i) at[i] = add(corner[i]);
    std::vector<int> curves;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec2 a = corner[i], d = corner[(i + 1) % 4];
        const Vec2 out = bulge[i] * Vec2(d.y() - a.y(), a.x() - d.x());
        const Vec2 b = a + (d - a) / 3 + out, c = a + 2 * (d - a) / 3 - out / 2;
        curves.push_back(gmsh::model::occ::addBezier({at[i], add(b), add(c), at[(i + 1) % 4]}));
    }
    return gmsh::model::occ::addWire(curves);
}

void write_saddle(const std::string& file)
{
    const cad_worker::Gmsh gmsh_of_ours;
    cad_worker::Session session("the saddle");
    const cad_worker::GmshModel model(session);
    session.run([&] {
        std::vector<int> controls;
        for (int j = 0; j < kControls; ++j) {
            for (int i = 0; i < kControls; ++i) {
                const double x = control_place(i), y = control_place(j);
                controls.push_back(gmsh::model::occ::addPoint(x, y, height(x, y)));
            }
        }
        std::vector<double> knots;
        std::vector<int> multiplicities(kControls - kDegree + 1, 1);
        multiplicities.front() = multiplicities.back() = kDegree + 1;
        for (int k = 0; k <= kControls - kDegree; ++k)
            knots.push_back(static_cast<double>(k) / (kControls - kDegree));
        const int face = gmsh::model::occ::addBSplineSurface(controls, kControls, -1, kDegree, kDegree, {},
                                                             knots, knots, multiplicities, multiplicities,
                                                             {draw_rim()}, false);
        gmsh::vectorpair rest;
        gmsh::model::occ::getEntities(rest);
        gmsh::model::occ::synchronize();
        // What else was drawn is no part of the face.
        std::erase_if(rest, [&](const auto& entity) { return entity == std::pair{2, face}; });
        std::sort(rest.rbegin(), rest.rend());
        for (const auto& entity : rest) gmsh::model::occ::remove({entity});
        gmsh::model::occ::synchronize();
        gmsh::write(file);
    });
}

/// The face in the current model. @return its tag.
int import_face(const std::string& file)
{
    gmsh::vectorpair shapes;
    gmsh::model::occ::importShapes(file, shapes, false);
    gmsh::model::occ::synchronize();
    gmsh::vectorpair faces;
    gmsh::model::getEntities(faces, 2);
    return faces.front().second;
}

void read_mesh(int face, SurfaceQuads& result)
{
    std::unordered_map<std::size_t, Index> place;
    std::vector<std::size_t> nodes, elements, corners;
    std::vector<double> at, parameters;
    gmsh::model::mesh::getNodes(nodes, at, parameters, 2, face, true, false);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto [found, fresh] = place.try_emplace(nodes[i], static_cast<Index>(result.points.size()));
        if (fresh) result.points.emplace_back(at[3 * i], at[3 * i + 1], at[3 * i + 2]);
    }
    gmsh::model::mesh::getElementsByType(2, elements, corners, face);
    result.triangles = elements.size();
    gmsh::model::mesh::getElementsByType(3, elements, corners, face);
    for (std::size_t e = 0; e < elements.size(); ++e) {
        Quad quad;
        for (std::size_t k = 0; k < 4; ++k) quad[k] = place.at(corners[4 * e + k]);
        result.quads.push_back(quad);
    }
}

} // namespace

SeededFace saddle_face(const std::string& file, double quads)
{
    write_saddle(file);
    SeededFace seeded;
    seeded.file = file;
    seeded.model = cad::load({file});
    const topology::Model& model = seeded.model;
    seeded.face = FaceId(0);
    seeded.size = std::sqrt(topology::face_area(model, seeded.face) / quads);
    for (const topology::Loop& loop : model[seeded.face].loops) {
        std::vector<Index>& cycle = seeded.loops.emplace_back();
        for (const topology::EdgeUse& use : loop.uses) {
            const double length = topology::edge_length(model, use.edge);
            const int sides = 2 * std::max(1, static_cast<int>(std::lround(length / seeded.size / 2)));
            seeded.curve_sides.emplace_back(model[use.edge].tag, sides);
            std::vector<double> fractions;
            for (int k = 0; k < sides; ++k)
                fractions.push_back(static_cast<double>(use.reversed ? sides - k : k) / sides);
            const std::vector<Vec3> points = surface::edge_points(model, use.edge, fractions);
            for (std::size_t i = 0; i < points.size(); ++i) {
                cycle.push_back(static_cast<Index>(seeded.rim.size()));
                seeded.rim.push_back({points[i], use.edge, fractions[i]});
            }
        }
    }
    return seeded;
}

SurfaceQuads lacuna_quads(const SeededFace& seeded)
{
    RunContext context;
    context.threads = 1;
    const double start = seconds();
    surface::FaceQuads made = surface::fill_face(
        seeded.model, seeded.face, seeded.rim, seeded.loops, {[&](const Vec3&) { return seeded.size; }},
        [](const quads::PlanarRegion& region, const RunContext& c) {
            return quads::pave(region, {}, c).mesh;
        },
        nullptr, context);
    return {std::move(made.points), std::move(made.quads), 0, seconds() - start};
}

SurfaceQuads gmsh_quads(const SeededFace& seeded, const GmshWay& way)
{
    const cad_worker::Gmsh gmsh_of_ours;
    cad_worker::Session session("the saddle");
    const cad_worker::GmshModel model(session);
    // A recombination to full quads halves the size itself; the division asked for does not.
    const double factor = way.subdivision ? 2 : 1;
    for (const auto& [option, value] : std::initializer_list<std::pair<const char*, double>>{
             {"General.NumThreads", 1},
             {"Mesh.Algorithm", way.algorithm},
             {"Mesh.CrossFieldClosestPoint", 0},
             {"Mesh.RecombinationAlgorithm", way.recombination},
             {"Mesh.SubdivisionAlgorithm", way.subdivision ? 1 : 0},
             {"Mesh.MeshSizeExtendFromBoundary", 0},
             {"Mesh.MeshSizeFromPoints", 0},
             {"Mesh.MeshSizeMin", factor * seeded.size},
             {"Mesh.MeshSizeMax", factor * seeded.size}})
        session.set(option, value);
    SurfaceQuads result;
    session.run([&] {
        const int face = import_face(seeded.file);
        for (const auto& [tag, sides] : seeded.curve_sides)
            gmsh::model::mesh::setTransfiniteCurve(tag, sides / (way.subdivision ? 2 : 1) + 1);
        gmsh::model::mesh::setRecombine(2, face);
        gmsh::model::mesh::generate(1);
        const double start = seconds();
        gmsh::model::mesh::generate(2);
        result.seconds = seconds() - start;
        read_mesh(face, result);
    });
    return result;
}

} // namespace lacuna::bench
