// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <ranges>
#include <set>
#include <vector>

/// Lists of the edge uses, edges, vertices and facets of one or several faces.
namespace lacuna::topology {

/// The uses of edges by all loops of a face, in order. @pre the face outlives the view
inline auto uses_of(const Face& face)
{
    return face.loops | std::views::transform(&Loop::uses) | std::views::join;
}

/// The corners of all facets of a face, in order. @pre the face outlives the view
inline auto corners_of(const Face& face) { return face.triangles | std::views::join; }

/// The facets of some faces, in order.
std::vector<Triangle> facets_of(const Model& model, const std::vector<FaceId>& faces);

/// The edges of some faces, and the vertices of some faces.
std::set<EdgeId> edges_of(const Model& model, const std::vector<FaceId>& faces);
std::set<VertexId> vertices_of(const Model& model, const std::vector<FaceId>& faces);

/// The other faces that share an edge with a face.
std::set<FaceId> faces_beside(const Model& model, FaceId face);

/// The faces of all roles: source, target, walls.
std::vector<FaceId> all_faces(const Roles& roles);

/// The list of one role.
std::vector<FaceId>& list_of(Roles& roles, Role role);

/// The uses of edges along all rims of a set of faces, in the order of rims(), and their edges.
std::vector<EdgeUse> rim_uses(const Model& model, const std::vector<FaceId>& faces);
std::set<EdgeId> rim_edges(const Model& model, const std::vector<FaceId>& faces);

/// Sum of the area vectors of some faces [model length²].
Vec3 area_vector_of(const Model& model, const std::vector<FaceId>& faces);

/// Area-weighted centre of some faces. @pre their area is not 0
Vec3 centroid_of(const Model& model, const std::vector<FaceId>& faces);

} // namespace lacuna::topology
