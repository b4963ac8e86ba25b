// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/partial_mesh.h>

#include <vector>

namespace lacuna::quads::paving {

/// Join all loops into one by straight lines between nodes, the cheapest first (Kruskal's spanning tree). The
/// joined loop passes each line twice, once in each direction. A line is cheap if it is short and divides the
/// angles at its ends into multiples of a right angle. It must not cross loops or other lines. If every line
/// crosses something, the shortest one is used; the resulting folds are removed later.
/// @note  Each loop is tried with the loops nearest to it. Time grows linearly with the number of nodes. Only
///         the search for the nearest loops grows with the square of the number of loops.
Cycle join_loops(PartialMesh& partial, const std::vector<Cycle>& loops);

} // namespace lacuna::quads::paving
