// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/topology/model.h>

#include <map>
#include <span>
#include <vector>

/// The poorest quads of several faces made better in space. Internal to this folder.
namespace lacuna::surface {

/// What nodes of a mesh over several faces may do. Those named nowhere stay.
struct NodeFreedom {
    /// Nodes on an edge inside the mesh: they slide between their neighbours on it.
    struct OnEdge {
        EdgeId edge;
        std::vector<Index> nodes; ///< as the edge runs, both ends included; these stay
        std::vector<double> at;   ///< of each, as fractions of the edge's length
    };
    std::vector<OnEdge> edges;
    /// Nodes inside a face: they move on it.
    struct OnFace {
        FaceId face;
        Index first = 0, last = 0; ///< last excluded
    };
    std::vector<OnFace> faces;
};

/// Move the nodes of poor quads to where the least sine of the corners around them is largest, one after the
/// other, by pattern search on their edge or face.
///
/// Each face is meshed for itself, between nodes on shared edges that were there first and in a flat image of
/// it: what is poor for that is seen only here. A node moves where the worst corner around it gains, so the
/// worst of the mesh can but rise. Nodes on edges are on the exact edges at the end, and those of faces on
/// the exact faces; where the worst quad around them is worse there than before, all go back.
/// @return  of the edges whose nodes moved, where they are now: as `OnEdge::at`.
/// @note  Deterministic. O(quads), and more for poor ones alone.
std::map<EdgeId, std::vector<double>> raise_poor_quads(mesh::QuadMesh& mesh, const topology::Model& model,
                                                       const NodeFreedom& freedom,
                                                       const RunContext& context = {});

} // namespace lacuna::surface
