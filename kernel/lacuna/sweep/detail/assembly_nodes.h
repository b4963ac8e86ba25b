// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/detail/shared_quads.h>

#include <cstddef>
#include <span>
#include <vector>

/// Common node numbers and groups of an assembly. Internal to this folder.
namespace lacuna::sweep {

/// Give coincident nodes one number: nodes of shared faces, nodes on the borders of all faces, and middle
/// nodes. Borders are included because volumes that touch along an edge share no face.
/// @post  `number` and `nodes` of the assembly are set.
/// @note  O(n + s log s) for n nodes, of which s lie on the skin.
void number_nodes(SweptAssembly& assembly);

/// Name the groups of cells, and prefix groups of roles with the member's name unless it is the only volume.
/// Faces between two pieces of one volume are in no group.
void name_groups(SweptAssembly& assembly, std::span<const AssemblyMember> members);

/// Check that no node on the borders of a part's faces lies inside a side of another part. Volumes that touch
/// only along an edge need this check, because they share no face on which their meshes are compared.
/// @throw NotSweepable "assembly.hanging_node"
void check_no_hanging_nodes(const SweptAssembly& assembly, std::span<const AssemblyMember> members);

} // namespace lacuna::sweep
