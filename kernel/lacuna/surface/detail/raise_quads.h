// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/topology/model.h>

#include <map>
#include <vector>

/// Improvement of the worst quads across several faces, in space. Internal to this folder.
namespace lacuna::surface {

/// Degrees of freedom of the nodes of a mesh over several faces. Nodes not listed are fixed.
struct NodeFreedom {
    /// Nodes on an edge inside the mesh: they slide between their neighbours on it.
    struct OnEdge {
        EdgeId edge;
        std::vector<Index> nodes; ///< in the direction of the edge, both ends included, which are fixed
        std::vector<double> at;   ///< their positions, as fractions of the edge's length
    };
    std::vector<OnEdge> edges;
    /// Nodes inside a face: they move on it.
    struct OnFace {
        FaceId face;
        Index first = 0, last = 0; ///< last excluded
    };
    std::vector<OnFace> faces;
};

/// Move the nodes of poor quads, one at a time, to maximize the minimum sine of the corners around them. Each
/// is moved by pattern search along its edge or on its face.
///
/// Each face was meshed on its own, in a flat image and between prescribed nodes on shared edges, so poor
/// quads in space show only here. A node moves only if the worst corner around it improves, so the minimum
/// over the mesh cannot fall. At the end nodes are projected onto the exact edges and faces; if the worst
/// quad around the moved nodes is then worse than before, all moves are undone.
/// @return  new positions of the nodes on edges with a moved node, as `OnEdge::at`.
/// @note  Deterministic. O(quads), plus work for poor ones.
std::map<EdgeId, std::vector<double>> raise_poor_quads(mesh::QuadMesh& mesh, const topology::Model& model,
                                                       const NodeFreedom& freedom,
                                                       const RunContext& context = {});

} // namespace lacuna::surface
