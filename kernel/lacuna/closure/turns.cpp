// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/turns.h>

#include <lacuna/core/edge_key.h>
#include <lacuna/geometry/facet_tree.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

namespace lacuna::closure {

using namespace topology;

namespace {

std::vector<std::vector<FaceId>> parts_of(const Model& model)
{
    std::vector<FaceId> faces;
    for (std::size_t f = 0; f < model.faces.size(); ++f) faces.emplace_back(f);
    return connected_parts(model, faces);
}

std::vector<Triangle> facets_of(const Model& model, const std::vector<FaceId>& faces)
{
    std::vector<Triangle> facets;
    for (const FaceId face : faces)
        facets.insert(facets.end(), model[face].triangles.begin(), model[face].triangles.end());
    return facets;
}

/// Of each part, whether it lies within another.
std::vector<bool> inner_parts(const Model& model, const std::vector<std::vector<FaceId>>& parts)
{
    std::vector<bool> inner(parts.size(), false);
    if (parts.size() < 2) return inner;
    for (std::size_t o = 0; o < parts.size(); ++o) {
        const geometry::FacetTree tree(model.points, facets_of(model, parts[o]));
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const Vec3& at = model.at(model[parts[p].front()].triangles.front()[0]);
            if (p != o && tree.bounds().contains(at) && std::abs(tree.winding_number(at)) > 0.5)
                inner[p] = !inner[p];
        }
    }
    return inner;
}

/// Whether facets face away from their middle.
bool faces_outward(const Model& model, const std::vector<FaceId>& faces)
{
    Vec3 centre = Vec3::Zero();
    double area = 0;
    for (const FaceId face : faces) {
        const double own = face_area(model, face);
        centre += own * face_centroid(model, face);
        area += own;
    }
    centre /= area;
    double sum = 0;
    for (const Triangle& t : facets_of(model, faces)) {
        const Vec3 &a = model.at(t[0]), &b = model.at(t[1]), &c = model.at(t[2]);
        sum += ((a + b + c) / 3 - centre).dot((b - a).cross(c - a));
    }
    return sum >= 0;
}

} // namespace

std::vector<double> concave_turns(const OpenVolume& volume)
{
    const Model& model = volume.model;
    const std::vector<std::vector<FaceId>> parts = parts_of(model);
    const std::vector<bool> inner = inner_parts(model, parts);
    std::vector<double> away(model.faces.size(), 1); // from the void: +1 as the facets face
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const bool right = faces_outward(model, parts[p]) != inner[p];
        for (const FaceId face : parts[p]) away[face.index()] = right ? 1 : -1;
    }
    std::vector<bool> on_edge(model.points.size(), false);
    std::unordered_set<std::uint64_t> sides;
    for (const Edge& edge : model.edges) {
        for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
            sides.insert(edge_key(edge.points[i], edge.points[i + 1]));
            on_edge[index(edge.points[i])] = on_edge[index(edge.points[i + 1])] = true;
        }
    }
    struct Beside {
        Vec3 normal;
        std::size_t face;
    };
    std::unordered_map<std::uint64_t, Beside> beside; // of a directed side on an edge
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        for (const Triangle& t : model.faces[f].triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Index a = t[k], b = t[(k + 1) % 3];
                if (!on_edge[index(a)] || !on_edge[index(b)] || !sides.contains(edge_key(a, b))) continue;
                const Vec3 normal = (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0]));
                beside.emplace(directed_key(a, b), Beside{normal, f});
            }
        }
    }
    std::vector<double> turns;
    for (const Edge& edge : model.edges) {
        double sum = 0, length = 0;
        for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
            const Index a = edge.points[i], b = edge.points[i + 1];
            const auto left = beside.find(directed_key(a, b)), right = beside.find(directed_key(b, a));
            if (left == beside.end() || right == beside.end() || left->second.face == right->second.face)
                continue;
            const Vec3 way = model.at(b) - model.at(a);
            const Vec3 turn = left->second.normal.cross(right->second.normal);
            const double angle = std::atan2(turn.norm(), left->second.normal.dot(right->second.normal));
            // From the facet that runs with the edge to the other, a convex skin turns about the edge's way.
            const double convex = away[left->second.face] * (turn.dot(way) > 0 ? 1 : -1);
            sum -= way.norm() * convex * angle;
            length += way.norm();
        }
        turns.push_back(length > 0 ? sum / length : 0);
    }
    return turns;
}

void face_away(Model& model)
{
    const std::vector<std::vector<FaceId>> parts = parts_of(model);
    const std::vector<bool> inner = inner_parts(model, parts);
    for (std::size_t p = 0; p < parts.size(); ++p)
        if (faces_outward(model, parts[p]) == inner[p]) flip_faces(model, parts[p]);
}

} // namespace lacuna::closure
