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

/// Walls that go away from the rims of the ends to one side by more than this share of what they go in all
/// tell on which side of the ends the void is. A choice: at a step they go to the other side.
constexpr double kOneWay = 0.75;

/// By how much walls go away from the ends behind the ends' facets, less by how much before them, over all
/// they go: 1 where facets of ends face away from the void. 0 where no wall meets an end.
double walls_behind_ends(const OpenVolume& volume, const std::vector<FaceId>& faces)
{
    const Model& model = volume.model;
    const auto is_wall = [&](FaceId face) { return volume.role[face.index()] == Role::wall; };
    std::unordered_map<std::uint64_t, Vec3> beyond; // of a directed side of a wall's facet its third corner
    for (const FaceId face : faces) {
        if (!is_wall(face)) continue;
        for (const Triangle& t : model[face].triangles)
            for (std::size_t k = 0; k < 3; ++k)
                beyond.emplace(directed_key(t[k], t[(k + 1) % 3]), model.at(t[(k + 2) % 3]));
    }
    double sum = 0, whole = 0;
    for (const FaceId face : faces) {
        if (is_wall(face)) continue;
        for (const Triangle& t : model[face].triangles) {
            const Vec3 &a = model.at(t[0]), &b = model.at(t[1]), &c = model.at(t[2]);
            const Vec3 normal = (b - a).cross(c - a).stableNormalized();
            for (std::size_t k = 0; k < 3; ++k) {
                const auto wall = beyond.find(directed_key(t[(k + 1) % 3], t[k]));
                if (wall == beyond.end()) continue;
                const Vec3 &from = model.at(t[k]), &to = model.at(t[(k + 1) % 3]);
                const Vec3 side = (to - from).stableNormalized(), way = wall->second - from;
                const double behind = -normal.dot((way - way.dot(side) * side).stableNormalized());
                sum += (to - from).norm() * behind;
                whole += (to - from).norm() * std::abs(behind);
            }
        }
    }
    return whole > 0 ? sum / whole : 0;
}

bool is_closed(const std::vector<Triangle>& facets)
{
    std::unordered_set<std::uint64_t> sides;
    for (const Triangle& t : facets)
        for (std::size_t k = 0; k < 3; ++k) sides.insert(directed_key(t[k], t[(k + 1) % 3]));
    return std::ranges::all_of(facets, [&](const Triangle& t) {
        return sides.contains(directed_key(t[1], t[0])) && sides.contains(directed_key(t[2], t[1])) &&
               sides.contains(directed_key(t[0], t[2]));
    });
}

/// Whether the facets of a part face away from the void: as the walls go from the ends where an open part has
/// both and all go one way; else they face away from their middle, or towards it where the part lies within
/// another.
bool outward(const OpenVolume& volume, const std::vector<FaceId>& faces, bool inner)
{
    const Model& model = volume.model;
    const std::vector<Triangle> facets = facets_of(model, faces);
    const auto has = [&](Role role) {
        return std::ranges::any_of(faces, [&](FaceId f) { return volume.role[f.index()] == role; });
    };
    if (has(Role::source) && has(Role::target) && !is_closed(facets)) {
        const double behind = walls_behind_ends(volume, faces);
        if (std::abs(behind) > kOneWay) return behind > 0;
    }
    Vec3 centre = Vec3::Zero();
    double area = 0;
    for (const FaceId face : faces) {
        const double own = face_area(model, face);
        centre += own * face_centroid(model, face);
        area += own;
    }
    centre /= area;
    double sum = 0;
    for (const Triangle& t : facets) {
        const Vec3 &a = model.at(t[0]), &b = model.at(t[1]), &c = model.at(t[2]);
        sum += ((a + b + c) / 3 - centre).dot((b - a).cross(c - a));
    }
    return (sum >= 0) != inner;
}

} // namespace

std::vector<double> concave_turns(const OpenVolume& volume)
{
    const Model& model = volume.model;
    const std::vector<std::vector<FaceId>> parts = parts_of(model);
    const std::vector<bool> inner = inner_parts(model, parts);
    std::vector<double> away(model.faces.size(), 1); // from the void: +1 as the facets face
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const bool right = outward(volume, parts[p], inner[p]);
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

void face_away(OpenVolume& volume)
{
    Model& model = volume.model;
    const std::vector<std::vector<FaceId>> parts = parts_of(model);
    const std::vector<bool> inner = inner_parts(model, parts);
    for (std::size_t p = 0; p < parts.size(); ++p)
        if (!outward(volume, parts[p], inner[p])) flip_faces(model, parts[p]);
}

} // namespace lacuna::closure
