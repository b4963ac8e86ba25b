// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/ids.h>
#include <lacuna/mesh/layered_nodes.h>

#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

/// Matching of two swept meshes on a shared face. Internal to this folder.
namespace lacuna::sweep {

/// The quads of a face in the skin of a mesh, by the mesh's nodes.
/// @param faces  of each patch. O(skin).
std::vector<Quad> quads_on(const mesh::HexMesh& mesh, std::span<const FaceId> faces, FaceId face);

/// A node of one mesh and the node of another in the same place.
struct NodePair {
    Index own = -1, other = -1;
};

/// A number for some nodes of a mesh. Uses memory for all nodes of the mesh or, if it does not hold its
/// nodes, for the numbered ones.
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

/// Finds equal quads in two meshes. Keeps its markers, one per node of each mesh, between faces.
class SameQuads {
public:
    /// The pairs of nodes of two meshes' quads on one face, if the quads are equal: each node within a
    /// distance of one of the other's, and a one to one map of the quads. Nothing if they differ.
    ///
    /// Nodes are sorted along an oblique line, so that few have similar keys.
    /// @param within  >= 0; 0: bit-identical [model length].
    /// @note  O(n log n) for n quads.
    std::optional<std::vector<NodePair>> pairs(const mesh::SkinNodes& own, std::span<const Quad> own_quads,
                                               const mesh::SkinNodes& other,
                                               std::span<const Quad> other_quads, double within);

private:
    NodeMarkers own_number_, other_number_;
};

/// Sides of the skin's quads between two patches, the lower node first, including those of the source's and
/// the target's rim. O(skin).
std::vector<Segment> patch_borders(const mesh::HexMesh& mesh);

} // namespace lacuna::sweep
