// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/partial_mesh.h>

#include <vector>

namespace lacuna::quads::paving {

/// Join all loops into one by straight lines between nodes, the cheapest first (Kruskal's spanning tree). The
/// joined loop runs along each line twice, once in either direction. A line is cheap if it is short and
/// divides the angles at its ends into multiples of a right angle; it must cross neither loops nor other
/// lines. If every line crosses something, the shortest is taken, and the resulting folds are removed later.
/// @note  Each loop is tried with the loops nearest to it. Time grows with the number of nodes, and with the
///        square of the number of loops only in finding the nearest.
Cycle join_loops(PartialMesh& partial, const std::vector<Cycle>& loops);

} // namespace lacuna::quads::paving
