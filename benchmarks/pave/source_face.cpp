// SPDX-License-Identifier: GPL-2.0-or-later
#include "source_face.h"

#include <lacuna/cad/load.h>
#include <lacuna/cad_worker/session.h>
#include <lacuna/closure/close.h>
#include <lacuna/quads/shared/pave.h>
#include <lacuna/surface/shared/seeds.h>
#include <lacuna/surface/shared/source_mesh.h>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <set>
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
            const std::size_t last = curve.through.size() - 1,
                              pieces = std::max<std::size_t>(1, last / kEvery);
            for (std::size_t k = 1; k < pieces; ++k) {
                const Vec2& p = curve.through[k * last / pieces];
                points.push_back(occ::addPoint(p.x(), p.y(), 0));
            }
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

/// A facet of `faces` leans by no more than this from their mean normal: 72°. Steeper ones would stand on the
/// walls. A choice.
constexpr double kLeans = 0.3;

Vec3 mean_normal(const topology::Model& model, const std::vector<FaceId>& faces)
{
    Vec3 sum = Vec3::Zero();
    for (const FaceId face : faces) sum += topology::face_area_vector(model, face);
    return sum.stableNormalized();
}

bool look_one_way(const topology::Model& model, const std::vector<FaceId>& faces)
{
    const Vec3 normal = mean_normal(model, faces);
    return std::ranges::all_of(faces, [&](FaceId face) {
        return std::ranges::all_of(model[face].triangles, [&](const Triangle& t) {
            const Vec3 area = (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0]));
            return area.dot(normal) > kLeans * area.norm();
        });
    });
}

/// What `raised_over()` adds to the model of the file.
class Raiser {
public:
    Raiser(const topology::Model& model, const std::vector<FaceId>& source) : model_(model)
    {
        double area = 0;
        for (const FaceId face : source) area += topology::face_area(model, face);
        by_ = -0.6 * std::sqrt(area) * mean_normal(model, source);
        std::map<EdgeId, int> uses;
        for (const FaceId face : source) {
            for (const topology::Loop& loop : model[face].loops) {
                for (const topology::EdgeUse& use : loop.uses) ++uses[use.edge];
            }
        }
        roles_.source = source;
        topology::Face target;
        for (const FaceId face : source) {
            for (const Triangle& t : model_[face].triangles)
                target.triangles.push_back({moved(t[0]), moved(t[2]), moved(t[1])});
        }
        for (const auto& [edge, count] : uses) {
            if (count == 1) add_wall(edge);
        }
        add_face(std::move(target), roles_.target);
        std::vector<topology::Face> faces;
        topology::Roles renumbered;
        for (auto list : {&topology::Roles::source, &topology::Roles::target, &topology::Roles::walls}) {
            for (const FaceId face : roles_.*list) {
                (renumbered.*list).emplace_back(faces.size());
                faces.push_back(model_[face]);
            }
        }
        model_.faces = std::move(faces);
        roles_ = std::move(renumbered);
        model_.build_loops();
        made_ = std::move(model_).finish();
        topology::orient_consistently(made_);
    }

    [[nodiscard]] topology::OpenVolume volume() const { return topology::open_volume(made_, roles_); }

private:
    Index moved(Index p)
    {
        const auto [found, fresh] = moved_.try_emplace(p, static_cast<Index>(model_.points.size()));
        if (fresh) model_.points.emplace_back(model_.at(p) + by_);
        return found->second;
    }

    VertexId moved_vertex(VertexId v)
    {
        const auto [found, fresh] = moved_vertex_.try_emplace(v, VertexId(model_.vertices.size()));
        if (!fresh) return found->second;
        topology::Vertex vertex = model_[v];
        vertex.point = moved(vertex.point);
        vertex.tag = static_cast<int>(model_.vertices.size()) + 1;
        model_.vertices.push_back(vertex);
        const VertexId to = found->second;
        topology::Edge upright;
        upright.from = v;
        upright.to = to;
        upright.points = {model_[v].point, vertex.point};
        add_edge(std::move(upright));
        return to;
    }

    void add_edge(topology::Edge edge)
    {
        edge.tag = static_cast<int>(model_.edges.size()) + 1;
        model_.edges.push_back(std::move(edge));
    }

    void add_face(topology::Face face, std::vector<FaceId>& role)
    {
        face.tag = 100000 + static_cast<int>(model_.faces.size());
        role.emplace_back(model_.faces.size());
        model_.faces.push_back(std::move(face));
    }

    void add_wall(EdgeId edge)
    {
        topology::Edge above;
        above.from = moved_vertex(model_[edge].from);
        above.to = moved_vertex(model_[edge].to);
        const std::vector<Index> below = model_[edge].points;
        for (const Index p : below) above.points.push_back(moved(p));
        topology::Face wall;
        for (std::size_t i = 0; i + 1 < below.size(); ++i) {
            wall.triangles.push_back({below[i], below[i + 1], above.points[i + 1]});
            wall.triangles.push_back({below[i], above.points[i + 1], above.points[i]});
        }
        add_edge(std::move(above));
        add_face(std::move(wall), roles_.walls);
    }

    topology::ModelBuilder model_;
    topology::Model made_;
    topology::Roles roles_;
    Vec3 by_;
    std::map<Index, Index> moved_;
    std::map<VertexId, VertexId> moved_vertex_;
};

} // namespace

std::vector<std::string> groups_of(const topology::Model& model)
{
    std::map<EdgeId, std::vector<FaceId>> users;
    for (const FaceId face : topology::all_faces(model)) {
        for (const topology::Loop& loop : model[face].loops) {
            for (const topology::EdgeUse& use : loop.uses) users[use.edge].push_back(face);
        }
    }
    std::set<std::set<FaceId>> groups;
    for (const FaceId seed : topology::all_faces(model)) {
        std::vector<FaceId> group{seed};
        if (!look_one_way(model, group)) continue;
        for (std::size_t next = 0; next < group.size(); ++next) {
            for (const topology::Loop& loop : model[group[next]].loops) {
                for (const topology::EdgeUse& use : loop.uses) {
                    for (const FaceId other : users[use.edge]) {
                        if (group.size() >= 12 || std::ranges::find(group, other) != group.end()) continue;
                        group.push_back(other);
                        if (!look_one_way(model, group)) group.pop_back();
                    }
                }
            }
        }
        for (const std::size_t size : {1, 2, 4, 7, 12}) {
            if (size <= group.size())
                groups.insert(std::set<FaceId>(group.begin(), group.begin() + static_cast<long>(size)));
        }
    }
    std::vector<std::string> tags;
    for (const std::set<FaceId>& group : groups) {
        std::string words;
        for (const FaceId face : group) words += (words.empty() ? "" : ",") + std::to_string(model[face].tag);
        tags.push_back(words);
    }
    return tags;
}

topology::OpenVolume raised_over(const topology::Model& model, const std::string& tags)
{
    return Raiser(model, faces_of(model, tags)).volume();
}

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
    const topology::OpenVolume volume = topology::open_volume(
        model, {faces_of(model, parts[1]), faces_of(model, parts[2]), faces_of(model, parts[3])});
    matching::Match match;
    if (!parts[1].empty() && !parts[2].empty()) match = matching::match(volume);
    return closure::close(volume, match).volume;
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
