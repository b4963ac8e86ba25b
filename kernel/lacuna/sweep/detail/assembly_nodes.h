// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/detail/shared_quads.h>

#include <cstddef>
#include <span>
#include <vector>

/// Nodes of an assembly as one mesh's. Internal to this folder.
namespace lacuna::sweep {

/// Pairs of nodes on a face of two parts.
struct SharedNodes {
    std::size_t own = 0, other = 0; ///< parts
    std::vector<NodePair> pairs;
};

/// Give nodes in one place one number: those within shared faces by the pairs found there; those where faces
/// meet, and middle nodes, by their places, for volumes that touch along an edge share no face.
/// @param shared  of each part, its pairs with those meshed before it.
/// @post  `number` and `nodes` of the assembly are set.
/// @note  O(nodes + shared nodes log).
void number_nodes(SweptAssembly& assembly, std::span<const std::vector<SharedNodes>> shared);

/// Nodes on the edges of a part's faces against such sides of the others: volumes that touch along an edge
/// alone have no face to agree on.
/// @throw NotSweepable "assembly.hanging_node"
void check_no_hanging_nodes(const SweptAssembly& assembly, std::span<const AssemblyMember> members);

} // namespace lacuna::sweep
