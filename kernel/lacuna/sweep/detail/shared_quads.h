// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/ids.h>
#include <lacuna/mesh/layered_nodes.h>

#include <optional>
#include <span>
#include <vector>

/// Matching of two swept meshes on a shared face. Internal to this folder.
namespace lacuna::sweep {

/// The quads of the mesh's skin on one face, with node numbers of the mesh.
/// @param faces  face of each patch. O(skin).
std::vector<Quad> quads_on(const mesh::HexMesh& mesh, std::span<const FaceId> faces, FaceId face);

/// A node of one mesh and the node of another mesh in the same position.
struct NodePair {
    Index own = -1, other = -1;
};

/// Quads whose nodes are numbered from 0 in order of first use, and the original nodes.
struct QuadsAlone {
    std::vector<Quad> quads;
    std::vector<Index> nodes;
};
QuadsAlone quads_alone(std::vector<Quad> quads);

/// `QuadsAlone` with the position of each node.
struct FaceMesh : QuadsAlone {
    std::vector<Vec3> places;
};
FaceMesh face_mesh(const mesh::SkinNodes& skin, std::span<const Quad> quads);

/// For each position of `a`, a position of `b` within a distance, each used once. Empty if a position has
/// none. Positions are sorted along an oblique line, so that few of them have similar keys.
/// @param within  >= 0; 0: bit-identical [model length].
/// @note  O(n log n) for n positions.
std::vector<Index> same_places(std::span<const Vec3> a, std::span<const Vec3> b, double within);

/// The pairs of coincident nodes of two meshes on one face, if the meshes are equal: each node has a
/// counterpart as in `same_places()`, and the quads correspond one to one. Empty if they differ.
std::optional<std::vector<NodePair>> same_quads(FaceMesh own, const FaceMesh& other, double within);

/// Sides of the skin's quads between two patches, including the rims of source and target. The lower node of
/// each side comes first. O(skin).
std::vector<Segment> patch_borders(const mesh::HexMesh& mesh);

} // namespace lacuna::sweep
