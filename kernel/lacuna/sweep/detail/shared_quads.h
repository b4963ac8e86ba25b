// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/ids.h>
#include <lacuna/mesh/layered_nodes.h>

#include <optional>
#include <span>
#include <unordered_map>
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

/// A number for some nodes of a mesh. Memory goes by the nodes of the mesh, or where it does not hold its
/// nodes by those that have a number.
class NodeMarkers {
public:
    void be_for(const mesh::SkinNodes& skin)
    {
        dense_ = skin.layers == nullptr;
        if (dense_ && number_.size() < skin.mesh.nodes.size()) number_.resize(skin.mesh.nodes.size(), -1);
    }
    /// -1: none
    Index& operator[](Index node)
    {
        return dense_ ? number_[index(node)] : some_.try_emplace(node, -1).first->second;
    }
    void clear(std::span<const Index> nodes)
    {
        some_.clear();
        if (!dense_) return;
        for (const Index n : nodes) number_[index(n)] = -1;
    }

private:
    bool dense_ = true;
    std::vector<Index> number_;
    std::unordered_map<Index, Index> some_;
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
    std::optional<std::vector<NodePair>> pairs(const mesh::SkinNodes& own, std::span<const Quad> own_quads,
                                               const mesh::SkinNodes& other,
                                               std::span<const Quad> other_quads, double within);

private:
    NodeMarkers own_number_, other_number_;
};

/// Sides of the skin's quads between two patches, the lower node first; those of the source's rim and the
/// target's among them. O(skin).
std::vector<Segment> patch_borders(const mesh::HexMesh& mesh);

} // namespace lacuna::sweep
