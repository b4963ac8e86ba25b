// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/ids.h>
#include <lacuna/mesh/hex_mesh.h>

#include <optional>
#include <span>
#include <vector>

/// What two swept meshes have on a face they share. Internal to this folder.
namespace lacuna::sweep {

/// The quads of a face in the skin of a mesh, by the mesh's nodes.
/// @param faces  of each patch. O(skin).
std::vector<Quad> quads_on(const mesh::HexMesh& mesh, std::span<const FaceId> faces, FaceId face);

/// A node of one mesh and the node of another in the same place.
struct NodePair {
    Index own = -1, other = -1;
};

/// Finds the same quads in two meshes. Keeps its markers, one a node of each mesh, for the next face.
class SameQuads {
public:
    /// The pairs of nodes of two meshes' quads on one face, if the quads are the same: each node within a
    /// distance of one of the other's, and the quads between them one for one. Nothing where they differ.
    ///
    /// Nodes are sorted along a slanted line, so that few stand beside each other there.
    /// @param within  >= 0; 0: to the bit [model length].
    /// @note  O(n log n) for n quads.
    std::optional<std::vector<NodePair>> pairs(const mesh::HexMesh& own, std::span<const Quad> own_quads,
                                               const mesh::HexMesh& other, std::span<const Quad> other_quads,
                                               double within);

private:
    std::vector<Index> own_number_, other_number_;
};

/// Sides of the skin's quads between two patches, the lower node first; those of the source's rim and the
/// target's among them. O(skin).
std::vector<Segment> patch_borders(const mesh::HexMesh& mesh);

} // namespace lacuna::sweep
