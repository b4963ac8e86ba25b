// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <set>
#include <span>
#include <vector>

namespace lacuna::topology {

/// Nodes of an edge in its direction, both ends included: the first and last are at its vertices, which
/// coincide on a closed edge [model length].
struct EdgeNodes {
    EdgeId edge;
    std::vector<Vec3> nodes;
};

/// Edges whose nodes are kept, because they are given or belong to a given mesh of a face.
std::set<EdgeId> kept_edges(const Model& model);

/// Set the nodes of edges. When the adjacent faces are meshed, these nodes are kept.
///
/// The edges become polylines through their nodes and lose their exact curves. Adjacent facets are split at
/// the nodes. Old points of the edges move to the nearest node along the edge.
/// @throw InvalidInput "topology.nodes_off_edge"  the nodes of an edge are not in its order, or are too few;
///         names the edge. "topology.face_vanishes"  the nodes leave no area of an adjacent face.
/// @note  O(facets + nodes × points of an edge).
void give_edge_nodes(OpenVolume& volume, std::span<const EdgeNodes> edges);

/// Set quads as the given mesh of a face, as if the file had contained them. The face's facets become the
/// halves of the quads, and its edges become the polylines of the quads' rim. The edges lose their exact
/// curves, and the face its exact surface, because the given mesh replaces them.
///
/// Facets of adjacent faces are split at the rim's nodes. Old points of the edges move to the nearest node
/// along the edge. A vertex at which edges of other faces end must be a node of the rim. Other vertices, such
/// as the start of a closed edge or the end of a seam, move to the nearest node.
/// @param nodes  of the mesh [model length].
/// @param quads  of the mesh, consistently oriented either way. A triangle repeats its last corner.
/// @throw InvalidInput "topology.mesh_unlike_face"  the quads are not a manifold, their rims do not
///         correspond one to one to the face's loops, or a rim node does not lie on a loop.
///         "topology.mesh_misses_vertex"  a vertex with edges of other faces has no node.
///         "topology.meshes_differ"  an adjacent face has a given mesh with another number of nodes on the
///         common edge. Names the face, the vertex or the edge. "topology.face_vanishes"  as above.
/// @note  O(facets + quads + nodes of the rim × points of the loop).
void give_mesh(OpenVolume& volume, FaceId face, std::span<const Vec3> nodes, std::span<const Quad> quads);

} // namespace lacuna::topology
