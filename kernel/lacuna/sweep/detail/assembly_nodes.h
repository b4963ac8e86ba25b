// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/detail/shared_quads.h>

#include <cstddef>
#include <span>
#include <vector>

/// Common node numbers of an assembly. Internal to this folder.
namespace lacuna::sweep {

/// Pairs of nodes on a face of two parts.
struct SharedNodes {
    std::size_t own = 0, other = 0; ///< parts
    std::vector<NodePair> pairs;
};

/// Give coincident nodes one number: nodes within shared faces by the pairs found there; nodes on the borders
/// of faces, and middle nodes, by position, because volumes that touch along an edge share no face.
/// @param shared  of every shared face.
/// @post  `number` and `nodes` of the assembly are set.
/// @note  O(nodes + shared nodes log).
void number_nodes(SweptAssembly& assembly, std::span<const SharedNodes> shared);

/// Check nodes on the edges of a part's faces against sides of the other parts: volumes that touch only along
/// an edge have no shared face to match.
/// @throw NotSweepable "assembly.hanging_node"
void check_no_hanging_nodes(const SweptAssembly& assembly, std::span<const AssemblyMember> members);

} // namespace lacuna::sweep
