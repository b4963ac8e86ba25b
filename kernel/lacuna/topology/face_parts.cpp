// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/face_parts.h>

namespace lacuna::topology {

std::vector<Triangle> facets_of(const Model& model, const std::vector<FaceId>& faces)
{
    std::vector<Triangle> facets;
    for (const FaceId face : faces)
        facets.insert(facets.end(), model[face].triangles.begin(), model[face].triangles.end());
    return facets;
}

std::set<EdgeId> edges_of(const Model& model, const std::vector<FaceId>& faces)
{
    std::set<EdgeId> edges;
    for (const FaceId face : faces)
        for (const EdgeUse& use : uses_of(model[face])) edges.insert(use.edge);
    return edges;
}

std::set<VertexId> vertices_of(const Model& model, const std::vector<FaceId>& faces)
{
    std::set<VertexId> vertices;
    for (const FaceId face : faces)
        for (const EdgeUse& use : uses_of(model[face])) vertices.insert(use_from(model, use));
    return vertices;
}

std::set<FaceId> faces_beside(const Model& model, FaceId face)
{
    std::set<FaceId> beside;
    for (const EdgeUse& use : uses_of(model[face]))
        for (const FaceUse& by : model.uses_of_edge(use.edge)) beside.insert(by.face);
    beside.erase(face);
    return beside;
}

std::vector<FaceId> all_faces(const Roles& roles)
{
    std::vector<FaceId> all = roles.source;
    all.insert(all.end(), roles.target.begin(), roles.target.end());
    all.insert(all.end(), roles.walls.begin(), roles.walls.end());
    return all;
}

std::vector<FaceId>& list_of(Roles& roles, Role role)
{
    return role == Role::source ? roles.source : role == Role::target ? roles.target : roles.walls;
}

std::vector<EdgeUse> rim_uses(const Model& model, const std::vector<FaceId>& faces)
{
    std::vector<EdgeUse> uses;
    for (const Rim& rim : rims(model, faces)) uses.insert(uses.end(), rim.uses.begin(), rim.uses.end());
    return uses;
}

std::set<EdgeId> rim_edges(const Model& model, const std::vector<FaceId>& faces)
{
    std::set<EdgeId> edges;
    for (const EdgeUse& use : rim_uses(model, faces)) edges.insert(use.edge);
    return edges;
}

Vec3 area_vector_of(const Model& model, const std::vector<FaceId>& faces)
{
    Vec3 sum = Vec3::Zero();
    for (const FaceId face : faces) sum += face_area_vector(model, face);
    return sum;
}

Vec3 centroid_of(const Model& model, const std::vector<FaceId>& faces)
{
    Vec3 sum = Vec3::Zero();
    double area = 0;
    for (const FaceId face : faces) {
        sum += face_area(model, face) * face_centroid(model, face);
        area += face_area(model, face);
    }
    return sum / area;
}

} // namespace lacuna::topology
