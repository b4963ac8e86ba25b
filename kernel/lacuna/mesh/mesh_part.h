// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/layered_nodes.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace lacuna::mesh {

/// Several meshes share nodes and have one common numbering. This class maps the node numbers of one of these
/// meshes to the common numbering. Nodes that an earlier mesh has keep their common number; all others get
/// consecutive numbers. Memory: 8 bytes for each shared node, and 4 bytes for 256 nodes.
class NodeNumbers {
public:
    NodeNumbers() = default;
    /// @param first  number of the first node that no earlier mesh has.
    /// @param known  nodes shared with earlier meshes, ascending, with their numbers.
    /// @param nodes  number of nodes of the mesh.
    NodeNumbers(Index first, std::vector<std::pair<Index, Index>> known, std::size_t nodes)
        : first_(first), known_(std::move(known)), nodes_(nodes), before_((nodes >> kShift) + 2)
    {
        std::size_t k = 0;
        for (std::size_t block = 0; block < before_.size(); ++block) {
            while (k < known_.size() && index(known_[k].first) < (block << kShift)) ++k;
            before_[block] = static_cast<Index>(k);
        }
    }

    [[nodiscard]] Index first() const { return first_; }
    /// Number of nodes that no earlier mesh has.
    [[nodiscard]] std::size_t fresh() const { return nodes_ - known_.size(); }
    [[nodiscard]] const std::vector<std::pair<Index, Index>>& known() const { return known_; }

    /// The common number of a node of the mesh.
    [[nodiscard]] Index of(Index node) const
    {
        const std::size_t block = index(node) >> kShift;
        const auto begin = known_.begin() + before_[block], end = known_.begin() + before_[block + 1];
        const auto at = std::lower_bound(begin, end, node,
                                         [](const auto& one, Index n) { return one.first < n; });
        if (at != end && at->first == node) return at->second;
        return first_ + node - static_cast<Index>(at - known_.begin());
    }

    /// The `i`-th node (from 0) of those that no earlier mesh has.
    [[nodiscard]] std::size_t fresh_node(std::size_t i) const
    {
        std::size_t low = 0, high = known_.size(); // bounds of the number of shared nodes before node i
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            if (index(known_[middle].first) - middle <= i)
                low = middle + 1;
            else
                high = middle;
        }
        return i + low;
    }

private:
    static constexpr unsigned kShift = 8; ///< blocks of 256 nodes take 4 bytes each

    Index first_ = 0;
    std::vector<std::pair<Index, Index>> known_;
    std::size_t nodes_ = 0;
    std::vector<Index> before_; ///< number of shared nodes before each block
};

/// Pairs of matching nodes on two groups of faces that have the same mesh.
struct PeriodicNodes {
    Eigen::Isometry3d onto =
        Eigen::Isometry3d::Identity();       ///< moves the first node of each pair to the second
    std::vector<std::array<Index, 2>> pairs; ///< in the numbering of the whole mesh; both nodes are equal on
                                             ///< the axis
};

/// Two groups of faces without common nodes, between which a solver has a tie or a contact.
struct ContactPair {
    std::string name;
    std::array<std::string, 2> groups; ///< of the skins: first the slave's, whose nodes are constrained, then
                                       ///< the master's
    bool tied = true;
    double tolerance = 0;              ///< maximum distance of tied nodes from the master [model length]
    std::array<std::size_t, 2> sets{}; ///< in a deck: indices of the groups' sets of sides
};

/// One of several swept meshes with shared nodes. It may compute its nodes on demand. Holds references only.
struct LayeredPart {
    const HexMesh& mesh;
    const LayeredNodes* nodes = nullptr; ///< null: the mesh stores its nodes
    const NodeNumbers& numbers;
};

} // namespace lacuna::mesh
