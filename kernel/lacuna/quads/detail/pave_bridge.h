// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/partial_mesh.h>

#include <optional>
#include <vector>

namespace lacuna::quads::paving {

/// Join all loops to a single loop by straight lines between nodes, starting with the cheapest line
/// (Kruskal's spanning tree). The joined loop passes each line twice, once in each direction. A line is cheap
/// if it is short and divides the angles at its ends into multiples of a right angle. It must not cross loops
/// or other lines.
/// @return empty if every line between two loops crosses something.
/// @note  Each loop is joined only to loops near it. O(nodes), plus O(loops²) for the search of these loops.
std::optional<Cycle> join_loops(PartialMesh& partial, const std::vector<Cycle>& loops);

} // namespace lacuna::quads::paving
