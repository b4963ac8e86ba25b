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
    /// Nodes on an edge inside the mesh. They slide along the edge between their neighbours.
    struct OnEdge {
        EdgeId edge;
        std::vector<Index> nodes; ///< in the direction of the edge, with its two ends, which are fixed
        std::vector<double> at;   ///< their positions, as fractions of the edge's length
    };
    std::vector<OnEdge> edges;
    /// Nodes inside a face: they move on it.
    struct OnFace {
        FaceId face;
        Index first = 0, last = 0; ///< range of nodes, without `last`
    };
    std::vector<OnFace> faces;
};

/// Move the nodes of poor quads, one at a time, to maximize the minimum sine of the corners around them. A
/// node moves by pattern search along its edge or on its face.
///
/// Each face was meshed separately, in a flat image and between prescribed nodes on shared edges, so poor
/// quads in space become visible only here. A node moves only if the worst corner around it improves, so the
/// minimum over the mesh cannot decrease. Finally, the moved nodes are projected onto the exact edges and
/// faces. If the worst quad around them is then worse than before, all moves are undone.
/// @return  for each edge with a moved node, the new positions as in `OnEdge::at`.
/// @note  Deterministic. O(quads), plus work for poor ones.
std::map<EdgeId, std::vector<double>> raise_poor_quads(mesh::QuadMesh& mesh, const topology::Model& model,
                                                       const NodeFreedom& freedom,
                                                       const RunContext& context = {});

} // namespace lacuna::surface
