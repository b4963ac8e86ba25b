// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <array>
#include <map>
#include <vector>

/// Boundary layers on edges of an assembly's members. Internal to this folder.
namespace lacuna::sweep {

/// Rows that end on an edge, at one end of it: the positions that its nodes must have.
struct EdgeRows {
    std::vector<double> places; ///< running lengths from that end, increasing [model length]; empty: no rows
    FaceId face;                ///< the face that the rows follow
    std::vector<double> heights{}; ///< of the rows' table [model length]
};
/// For each edge, the rows at its start and at its end.
using RowsOfEdges = std::map<EdgeId, std::array<EdgeRows, 2>>;

/// The rows that end on edges of a member: rows of walls on the edges of its source and target, and rows of
/// ends on its side lines. Empty if the sweep will refuse the boundary layers.
/// @note  O(edges + facets).
RowsOfEdges edge_rows(const AssemblyMember& member);

} // namespace lacuna::sweep
