// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <set>
#include <span>
#include <vector>

namespace lacuna::topology {

/// Nodes of an edge, as it runs, both ends included: first and last are its vertices' places, those of a
/// closed edge the same one [model length].
struct EdgeNodes {
    EdgeId edge;
    std::vector<Vec3> nodes;
};

/// Edges that keep their nodes, by themselves or with the mesh of a face.
std::set<EdgeId> kept_edges(const Model& model);

/// Make points the nodes of edges, to be kept by whoever meshes the faces beside them.
///
/// The edges become the chains of their nodes and lose their exact curves. Facets beside them are cut at the
/// nodes, and the edges' other points go to the nearest node along them.
/// @throw InvalidInput "topology.nodes_off_edge"  nodes that do not follow each other as the edge runs, or
///     too
///         few of them; names the edge.
/// @note  O(facets + nodes × points of an edge).
void give_edge_nodes(OpenVolume& volume, std::span<const EdgeNodes> edges);

/// Make quads the mesh a face came with, as if it had been read so: its facets become their halves, its edges
/// the chains of their rim, and the faces beside it end at those.
///
/// Facets beside the face are cut at the rim's nodes, and the points of their edges that are none of them go
/// to the nearest one along the edge. A vertex where other edges end must be a node of the rim. One where
/// none does, such as the start of a closed edge, goes to the nearest node; so do the ends of seams. Edges
/// lose their exact curve, and the face its exact surface: what they were needed for is there.
/// @param nodes  of the mesh [model length].
/// @param quads  of the mesh, one way round all of them; either way. A triangle has its last corner twice.
/// @throw InvalidInput "topology.mesh_unlike_face"  quads that are no manifold, whose rim has other loops
///     than
///         the face, or is off them; "topology.mesh_misses_vertex"  a vertex that is no node;
///         "topology.meshes_differ"  a face beside it whose own mesh has other nodes on their edge. Names
///         them.
/// @note  O(facets + quads + nodes of the rim × points of the loop).
void give_mesh(OpenVolume& volume, FaceId face, std::span<const Vec3> nodes, std::span<const Quad> quads);

} // namespace lacuna::topology
