// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/skin_triangles.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/surface/detail/linked_triangles.h>
#include <lacuna/surface/detail/skin_remesher.h>
#include <lacuna/surface/detail/skin_shape.h>
#include <lacuna/surface/detail/skin_size.h>
#include <lacuna/surface/shared/default_size.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/give_mesh.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Whether each point is fixed. Vertices, given nodes, and the ends and corners of lines are fixed.
std::vector<char> fixed_points(const Model& model, std::span<const SkinLine> lines)
{
    std::vector<char> fixed(model.points.size(), 0);
    const auto fix = [&](Index p) { fixed[index(p)] = 1; };
    for (const Vertex& vertex : model.vertices) fix(vertex.point);
    for (const Face& face : model.faces) {
        if (!keeps_cells(face)) continue;
        for (const Triangle& t : face.triangles) std::ranges::for_each(t, fix);
    }
    for (const SkinLine& line : lines) {
        fix(line.points.front());
        fix(line.points.back());
        if (line.kept) std::ranges::for_each(line.points, fix);
        if (line.edge.valid() && model[line.edge].curve != nullptr) continue;
        for (std::size_t i = 1; i + 1 < line.points.size(); ++i) {
            const Vec3& at = model.at(line.points[i]);
            const Vec3 in = at - model.at(line.points[i - 1]), out = model.at(line.points[i + 1]) - at;
            if (geometry::angle_between(in, out) > kCreaseAngle * kDegree) fix(line.points[i]);
        }
    }
    return fixed;
}

/// The sides of given meshes, each as a midpoint and a length.
std::vector<PointSize> given_sides(const Model& model, std::span<const SkinLine> lines)
{
    std::vector<PointSize> sides;
    for (const SkinLine& line : lines) {
        if (!line.kept) continue;
        for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
            const Vec3 &a = model.at(line.points[i]), &b = model.at(line.points[i + 1]);
            sides.push_back({(a + b) / 2, (b - a).norm()});
        }
    }
    return sides;
}

/// The facets of all faces as linked triangles, with their lines.
LinkedTriangles linked(const Model& model, std::span<const SkinLine> lines, const SizeField& size)
{
    LinkedTriangles mesh;
    std::vector<LinkedTriangles::Node> nodes(model.points.size());
    const std::vector<char> fixed = fixed_points(model, lines);
    for (std::size_t p = 0; p < nodes.size(); ++p) {
        nodes[p].at = model.points[p];
        nodes[p].point = static_cast<Index>(p);
        nodes[p].fixed = fixed[p] != 0;
        nodes[p].size = size(nodes[p].at);
    }
    std::vector<Triangle> corners;
    std::vector<LinkedTriangles::Owner> owners;
    std::vector<std::array<Vec3, 3>> normals;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const Face& face = model.faces[f];
        corners.insert(corners.end(), face.triangles.begin(), face.triangles.end());
        owners.resize(corners.size(), {FaceId(f), keeps_cells(face)});
        const auto own = corner_normals(model.points, face.triangles);
        normals.insert(normals.end(), own.begin(), own.end());
    }
    for (std::size_t l = 0; l < lines.size(); ++l) {
        for (const Index p : lines[l].points)
            if (!nodes[index(p)].fixed) nodes[index(p)].line = static_cast<Index>(l);
    }
    if (const Index open = mesh.build(std::move(nodes), corners, owners); open >= 0) {
        throw InvalidInput(Message("surface.skin_open", "the skin is not closed at {}",
                                   entity_of(model, owners[index(open) / 3].face))
                               .remedy("close the volume first"));
    }
    for (std::size_t i = 0; i < mesh.sides.size(); ++i) mesh.sides[i].normal = normals[i / 3][i % 3];
    // For each side, given by its two points: its line, and the position of its first point on that line.
    std::unordered_map<std::uint64_t, std::pair<Index, double>> on_line;
    for (std::size_t l = 0; l < lines.size(); ++l) {
        const SkinLine& line = lines[l];
        for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
            const Index a = line.points[i], b = line.points[i + 1];
            on_line[directed_key(a, b)] = {static_cast<Index>(l), line.arc[i]};
            on_line[directed_key(b, a)] = {static_cast<Index>(l), line.arc[i + 1]};
        }
    }
    for (std::size_t i = 0; i < mesh.sides.size(); ++i) {
        const auto s = static_cast<Index>(i);
        const Index a = mesh.nodes[index(mesh.from(s))].point, b = mesh.nodes[index(mesh.to(s))].point;
        const auto found = on_line.find(directed_key(a, b));
        if (found == on_line.end()) continue;
        mesh.sides[i].line = found->second.first;
        mesh.sides[i].s = found->second.second;
    }
    return mesh;
}

/// The cells of a skin: new triangles, and the cells of given meshes.
SkinMesh skin_of(const Model& model, const LinkedTriangles& mesh)
{
    SkinMesh result;
    std::vector<Index> number(mesh.nodes.size(), -1);
    std::map<Index, Index> of_point;
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
        const LinkedTriangles::Node& node = mesh.nodes[i];
        if (node.out < 0) continue;
        const auto next = static_cast<Index>(result.skin.points.size());
        const bool given = node.point >= 0 && node.fixed;
        const auto [found, fresh] = given ? of_point.emplace(node.point, next)
                                          : std::pair(of_point.end(), true);
        number[i] = fresh ? next : found->second;
        if (fresh) result.skin.points.push_back(node.at);
    }
    std::vector<std::vector<Triangle>> made(model.faces.size());
    for (std::size_t i = 0; i < mesh.sides.size(); i += 3) {
        const auto s = static_cast<Index>(i);
        if (!mesh.lives(s) || mesh.owner(s).kept) continue;
        made[mesh.owner(s).face.index()].push_back(
            {number[index(mesh.from(s))], number[index(mesh.from(s + 1))], number[index(mesh.from(s + 2))]});
    }
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const Face& face = model.faces[f];
        if (keeps_cells(face)) {
            for (Triangle t : loose_triangles(face)) {
                for (Index& p : t) p = of_point.at(p);
                made[f].push_back(t);
            }
            for (Quad q : face.given_quads) {
                for (Index& p : q) p = of_point.at(p);
                result.skin.quads.push_back(q);
                result.quad_face.emplace_back(f);
            }
        }
        result.skin.triangles.insert(result.skin.triangles.end(), made[f].begin(), made[f].end());
        result.triangle_face.resize(result.skin.triangles.size(), FaceId(f));
    }
    return result;
}

/// @throw NotSweepable  a triangle is turned away from its face, or two triangles cross.
void check_skin(const Model& model, const LinkedTriangles& mesh, const RunContext& context)
{
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<FaceId> faces;
    for (const LinkedTriangles::Node& node : mesh.nodes) points.push_back(node.at);
    for (std::size_t i = 0; i < mesh.sides.size(); i += 3) {
        const auto s = static_cast<Index>(i);
        if (!mesh.lives(s)) continue;
        const FaceId face = mesh.owner(s).face;
        if (!mesh.owner(s).kept && !(mesh.quality(s) > 0)) {
            throw NotSweepable(
                Message("surface.skin_folds", "triangles on {} fold at this size", entity_of(model, face))
                    .remedy("use a smaller 'size'"));
        }
        triangles.push_back({mesh.from(s), mesh.from(s + 1), mesh.from(s + 2)});
        faces.push_back(face);
    }
    const geometry::FacetTree tree(points, triangles, context);
    const auto corners = [&](Index t) {
        const Triangle& c = triangles[index(t)];
        return std::array{points[index(c[0])], points[index(c[1])], points[index(c[2])]};
    };
    std::optional<std::pair<Index, Index>> first;
    tree.overlaps(
        tree,
        [&](Index a, Index b) {
            if ((!first || std::pair(a, b) < *first) &&
                geometry::triangles_cross(corners(a), corners(b), model.tolerance))
                first = {a, b};
            return true;
        },
        0, context);
    if (!first) return;
    throw NotSweepable(Message("surface.skin_crosses", "triangles of {} and {} cross at this size",
                               entity_of(model, faces[index(first->first)]),
                               entity_of(model, faces[index(first->second)]))
                           .remedy("use a smaller 'size'"));
}

} // namespace

SkinMesh triangulate_skin(const Model& given, const SizeField& size, std::span<const FixedFace> fixed,
                          const RunContext& context)
{
    OpenVolume volume{given, std::vector<Role>(given.faces.size(), Role::wall), {}};
    for (const FixedFace& face : fixed) give_mesh(volume, face.face, face.nodes, face.quads);
    const Model& model = volume.model;
    const SizeField asked = checked_size(size, "size");
    std::vector<SkinLine> lines = skin_lines(model);
    const SizeField local = skin_sizes(model, lines, given_sides(model, lines), asked, context);
    for (SkinLine& line : lines) line.sample(model, local);
    std::vector<FaceShapeTree> shapes;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        check_cancelled(context);
        shapes.emplace_back(model, FaceId(f), local);
    }
    LinkedTriangles mesh = linked(model, lines, local);
    SkinRemesher(mesh, lines, shapes, local, context).run(model);
    check_skin(model, mesh, context);
    return skin_of(model, mesh);
}

} // namespace lacuna::surface
