// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <array>
#include <map>
#include <vector>

/// Boundary layers on edges of an assembly's members. Internal to this folder.
namespace lacuna::sweep {

/// Rows that end on an edge at one of its ends: the required positions of its nodes.
struct EdgeRows {
    std::vector<double> places; ///< running lengths from that end, rising [model length]; empty: none
    FaceId face;                ///< the face that the rows follow
};
/// For each edge, the rows at its start and at its end.
using RowsOfEdges = std::map<EdgeId, std::array<EdgeRows, 2>>;

/// The rows of a member's boundary layers that end on edges of its source and target, and the boundary layers
/// of its ends on its side lines. Empty if the sweep will refuse the boundary layers.
/// @note  O(edges + facets).
RowsOfEdges edge_rows(const AssemblyMember& member);

} // namespace lacuna::sweep
