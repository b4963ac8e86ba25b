// SPDX-License-Identifier: GPL-2.0-or-later
#include "source_face.h"

#include <lacuna/cad/load.h>
#include <lacuna/cad_worker/session.h>
#include <lacuna/closure/close.h>
#include <lacuna/quads/pave.h>
#include <lacuna/surface/seeds.h>
#include <lacuna/surface/source_mesh.h>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

namespace lacuna::bench {

namespace {

namespace occ = gmsh::model::occ;
using topology::Role;

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

int draw_loop(const std::vector<test::PlaneCurve>& loop)
{
    std::vector<int> corners, curves;
    for (const test::PlaneCurve& curve : loop)
        corners.push_back(occ::addPoint(curve.from.x(), curve.from.y(), 0));
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const test::PlaneCurve& curve = loop[i];
        const int from = corners[i], to = corners[(i + 1) % loop.size()];
        if (curve.kind == test::PlaneCurve::Kind::line) {
            curves.push_back(occ::addLine(from, to));
        } else if (curve.kind == test::PlaneCurve::Kind::arc) {
            const int centre = occ::addPoint(curve.centre.x(), curve.centre.y(), 0);
            curves.push_back(occ::addCircleArc(from, centre, to));
            occ::remove({{0, centre}});
        } else {
            constexpr std::size_t kEvery = 8; // points of the fine line that the spline goes through
            std::vector<int> points{from};
            for (std::size_t k = kEvery; k + kEvery <= curve.through.size(); k += kEvery)
                points.push_back(occ::addPoint(curve.through[k].x(), curve.through[k].y(), 0));
            if (points.size() > 1 && (curve.through.size() - 1) % kEvery == 0) points.pop_back();
            points.push_back(to);
            curves.push_back(occ::addSpline(points));
        }
    }
    return occ::addCurveLoop(curves);
}

void write_prism(const test::PlaneDomain& domain, const std::string& file)
{
    const cad_worker::Gmsh gmsh_of_ours;
    cad_worker::Session session("the prism");
    const cad_worker::GmshModel model(session);
    session.run([&] {
        std::vector<int> loops;
        for (const auto& loop : domain.loops) loops.push_back(draw_loop(loop));
        const int face = occ::addPlaneSurface(loops);
        gmsh::vectorpair made;
        occ::extrude({{2, face}}, 0, 0, 1, made);
        occ::synchronize();
        gmsh::write(file);
    });
}

std::vector<FaceId> faces_of(const topology::Model& model, const std::string& tags)
{
    std::vector<FaceId> faces;
    std::istringstream words(tags);
    for (std::string word; std::getline(words, word, ',');) {
        for (std::size_t f = 0; f < model.faces.size(); ++f) {
            if (model.faces[f].tag == std::stoi(word)) faces.emplace_back(f);
        }
    }
    return faces;
}

} // namespace

topology::OpenVolume prism_over(const test::PlaneDomain& domain, const std::string& file)
{
    write_prism(domain, file);
    const topology::Model model = cad::load({file});
    topology::Roles roles;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        double low = 1, high = 0;
        for (const Triangle& t : model.faces[f].triangles) {
            for (const Index p : t) {
                low = std::min(low, model.at(p).z());
                high = std::max(high, model.at(p).z());
            }
        }
        (high < 0.5 ? roles.source : low > 0.5 ? roles.target : roles.walls).emplace_back(f);
    }
    return topology::open_volume(model, roles);
}

topology::OpenVolume real_case(const std::string& spec)
{
    std::vector<std::string> parts;
    std::istringstream words(spec);
    for (std::string word; std::getline(words, word, '|');) parts.push_back(word);
    parts.resize(4);
    const topology::Model model = cad::load({parts[0]});
    topology::OpenVolume volume = topology::open_volume(
        model, {faces_of(model, parts[1]), faces_of(model, parts[2]), faces_of(model, parts[3])});
    matching::Match match;
    if (!parts[1].empty() && !parts[2].empty()) match = matching::match(volume);
    closure::close(volume, match);
    return volume;
}

SourceQuads mesh_source_faces(const topology::OpenVolume& volume, double quads)
{
    RunContext context;
    context.threads = 1;
    SourceQuads result;
    result.faces = volume.faces(Role::source);
    double area = 0;
    for (const FaceId face : result.faces) area += topology::face_area(volume.model, face);
    result.size = std::sqrt(area / quads);
    const surface::SizeField size = [&](const Vec3&) { return result.size; };
    const std::vector<surface::LinkingSurface> links = surface::linking_surfaces(volume);
    const double start = seconds();
    const surface::Seeds seeds = surface::seed_source(volume, links, size, surface::QuadStyle::automatic,
                                                      {.curvature = 0});
    const surface::SourceMesh made = surface::mesh_source(
        volume, links, seeds, {size, {}},
        [](const quads::PlanarRegion& region, const RunContext& c) {
            return quads::pave(region, {}, c).mesh;
        },
        context);
    result.seconds = seconds() - start;
    for (const std::string& note : made.notes) result.how += (result.how.empty() ? "" : "; ") + note;
    for (const FaceId face : result.faces) {
        SurfaceQuads& own = result.on_face.emplace_back();
        std::unordered_map<Index, Index> number;
        for (std::size_t q = 0; q < made.quads.quads.size(); ++q) {
            if (made.quads.face[q] != static_cast<Index>(face.index())) continue;
            Quad quad = mesh::turned_over(made.quads.quads[q]);
            if (mesh::is_triangle(quad)) ++own.triangles;
            for (Index& p : quad) {
                const auto [found, fresh] = number.try_emplace(p, static_cast<Index>(own.points.size()));
                if (fresh) own.points.push_back(made.quads.nodes[static_cast<std::size_t>(p)]);
                p = found->second;
            }
            own.quads.push_back(quad);
        }
    }
    return result;
}

} // namespace lacuna::bench
