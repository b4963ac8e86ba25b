// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/skin_shape.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace lacuna::surface {

using namespace topology;

namespace {

/// The sides of facets inside a face at which two facets form an angle larger than `angle`, as a graph of
/// points.
std::map<Index, std::set<Index>> creases(const Model& model, const Face& face, double angle)
{
    std::unordered_map<std::uint64_t, std::size_t> first;
    std::map<Index, std::set<Index>> result;
    for (std::size_t i = 0; i < face.triangles.size(); ++i) {
        const Triangle& t = face.triangles[i];
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            const auto [found, fresh] = first.try_emplace(edge_key(a, b), i);
            if (fresh) continue;
            const Vec3 own = facet_area_vector(model, t);
            const Vec3 other = facet_area_vector(model, face.triangles[found->second]);
            // The normal of a facet without height is only a rounding error.
            const double side = (model.at(a) - model.at(b)).norm();
            if (std::min(own.norm(), other.norm()) <= model.tolerance * side) continue;
            if (geometry::angle_between(own, other) <= angle) continue;
            result[a].insert(b);
            result[b].insert(a);
        }
    }
    return result;
}

/// The chains of a graph. A chain ends at a point of `ends`, or at a point whose number of sides is not two.
std::vector<std::vector<Index>> chains_of(std::map<Index, std::set<Index>> graph, const std::set<Index>& ends)
{
    std::set<Index> stops;
    for (const auto& [point, others] : graph)
        if (others.size() != 2 || ends.contains(point)) stops.insert(point);
    std::vector<std::vector<Index>> chains;
    const auto walk = [&](Index start) {
        while (!graph[start].empty()) {
            std::vector<Index>& chain = chains.emplace_back(std::vector{start});
            for (Index at = start; chain.size() == 1 || (at != start && !stops.contains(at));) {
                const Index to = *graph[at].begin();
                graph[at].erase(to);
                graph[to].erase(at);
                chain.push_back(at = to);
            }
        }
    };
    for (const Index stop : stops) walk(stop);
    for (const auto& [point, others] : std::map(graph)) walk(point); // closed chains
    return chains;
}

} // namespace

bool keeps_cells(const Face& face) { return face.keeps_nodes || !face.given_quads.empty(); }

std::vector<std::array<Vec3, 3>> corner_normals(std::span<const Vec3> points,
                                                std::span<const Triangle> triangles)
{
    std::vector<Vec3> area(triangles.size());
    std::vector<char> flat(triangles.size());
    std::unordered_map<Index, std::vector<std::size_t>> around; // the triangles at each point
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Triangle& t = triangles[i];
        const Vec3& a = points[index(t[0])];
        const Vec3 ab = points[index(t[1])] - a, ac = points[index(t[2])] - a;
        area[i] = ab.cross(ac);
        flat[i] = area[i].norm() <= kFileAccuracy * std::max(ab.squaredNorm(), ac.squaredNorm()) ? 1 : 0;
        for (const Index p : t) around[p].push_back(i);
    }
    std::vector<std::array<Vec3, 3>> normals(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3 all = Vec3::Zero(), near = Vec3::Zero();
            for (const std::size_t j : around[triangles[i][k]]) {
                all += area[j];
                if (flat[i] == 0 && area[j].dot(area[i]) > kContinues * area[j].norm() * area[i].norm())
                    near += area[j];
            }
            normals[i][k] = (near.norm() > 0 ? near : all).stableNormalized();
        }
    }
    return normals;
}

FaceShapeTree::FaceShapeTree(const Model& model, FaceId face, const SizeField& size)
    : facets_(fine_facets(model, face, size)),
      normals_(corner_normals(facets_.points, facets_.triangles)),
      tree_(facets_.points, facets_.triangles),
      plane_(model[face].kind == "plane")
{
}

FaceShapeTree::Place FaceShapeTree::closest(const Vec3& p) const
{
    const geometry::FacetTree::Hit hit = tree_.closest(p);
    const std::array<Vec3, 3>& n = normals_[index(hit.triangle)];
    const Vec3& w = hit.barycentric;
    return {plane_ ? p : hit.point, (w[0] * n[0] + w[1] * n[1] + w[2] * n[2]).stableNormalized()};
}

void FaceShapeTree::make_exact(std::span<Vec3> points, const RunContext& context) const
{
    if (facets_.surface == nullptr || points.empty()) return;
    std::vector<Vec2> uv;
    for (const Vec3& p : points) {
        const geometry::FacetTree::Hit hit = tree_.closest(p);
        const std::array<Vec2, 3>& c = facets_.uv[index(hit.triangle)];
        const Vec3& w = hit.barycentric;
        uv.emplace_back(w[0] * c[0] + w[1] * c[1] + w[2] * c[2]);
    }
    facets_.surface->project(points, uv, context);
}

Vec3 SkinLine::point(double where) const { return geometry::point_at(at, s, where); }

std::vector<SkinLine> skin_lines(const Model& model)
{
    std::vector<SkinLine> lines;
    std::set<Index> on_lines;
    std::map<FaceId, std::map<Index, std::set<Index>>> found;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        if (model.faces[f].surface == nullptr && !model.faces[f].keeps_nodes)
            found[FaceId(f)] = creases(model, model.faces[f], kCreaseAngle * kDegree);
    }
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const Edge& edge = model.edges[e];
        const auto uses = model.uses_of_edge(EdgeId(e));
        if (uses.size() == 2 && uses[0].face == uses[1].face && !edge.keeps_nodes) continue;
        lines.push_back({EdgeId(e), edge.points, {}, edge.keeps_nodes});
        on_lines.insert(edge.points.begin(), edge.points.end());
    }
    for (const Vertex& vertex : model.vertices) on_lines.insert(vertex.point);
    for (auto& [face, graph] : found) {
        for (std::vector<Index>& chain : chains_of(std::move(graph), on_lines))
            lines.push_back({EdgeId(), std::move(chain), {}, false});
    }
    for (SkinLine& line : lines) {
        line.arc = geometry::arc_lengths(places_at(model, line.points));
    }
    return lines;
}

void SkinLine::sample(const Model& model, const SizeField& size)
{
    if (!edge.valid() || model[edge].curve == nullptr) {
        s = arc;
        at = places_at(model, points);
        return;
    }
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double length = arc[i + 1] - arc[i];
        const Vec3 middle = (model.at(points[i]) + model.at(points[i + 1])) / 2;
        const double wanted = std::ceil(kSamplesPerSide * length / size(middle));
        const auto count = static_cast<int>(std::clamp(wanted, 1.0, kMostSamples));
        for (int k = 0; k < count; ++k) s.push_back(arc[i] + k * length / count);
    }
    s.push_back(arc.back());
    std::vector<double> fractions;
    for (const double where : s) fractions.push_back(where / arc.back());
    at = edge_points(model, edge, fractions);
}

} // namespace lacuna::surface
