// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/layered_nodes.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace lacuna::mesh {

/// The numbers of a mesh's nodes among those of several meshes that have nodes in common, in memory that goes
/// by the nodes in common.
class NodeNumbers {
public:
    NodeNumbers() = default;
    /// @param first  of the nodes that no earlier mesh has, the first one's number.
    /// @param known  the others, rising, and their numbers.
    /// @param nodes  of the mesh.
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
    /// Nodes that no earlier mesh has.
    [[nodiscard]] std::size_t fresh() const { return nodes_ - known_.size(); }
    [[nodiscard]] const std::vector<std::pair<Index, Index>>& known() const { return known_; }

    [[nodiscard]] Index of(Index node) const
    {
        const std::size_t block = index(node) >> kShift;
        const auto begin = known_.begin() + before_[block], end = known_.begin() + before_[block + 1];
        const auto at = std::lower_bound(begin, end, node,
                                         [](const auto& one, Index n) { return one.first < n; });
        if (at != end && at->first == node) return at->second;
        return first_ + node - static_cast<Index>(at - known_.begin());
    }

    /// The node that is the `i`-th, from 0, of those that no earlier mesh has.
    [[nodiscard]] std::size_t fresh_node(std::size_t i) const
    {
        std::size_t low = 0, high = known_.size(); // known nodes before it
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
    static constexpr unsigned kShift = 8; ///< 4 bytes for 256 nodes: a choice

    Index first_ = 0;
    std::vector<std::pair<Index, Index>> known_;
    std::size_t nodes_ = 0;
    std::vector<Index> before_; ///< known nodes before each block of nodes
};

/// One of several swept meshes that have nodes in common.
struct MeshPart {
    const HexMesh* mesh = nullptr;
    /// Of each node, its number in the whole, from 0: a new one is the next, one of an earlier part has that
    /// one's.
    std::span<const Index> number;
};

/// The same of a mesh that may not hold its nodes. Refers to all.
struct LayeredPart {
    const HexMesh& mesh;
    const LayeredNodes* nodes = nullptr; ///< null: the mesh holds them
    const NodeNumbers& numbers;
};

} // namespace lacuna::mesh
