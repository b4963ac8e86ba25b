// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/detail/same_edges.h>

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
    std::size_t member = 0;        ///< the member that has these rows, of several the first
    int faces = 1;                 ///< number of members with these rows, of whose positions this is the mean
};

/// For each set of same edges on which rows end: the rows at the start and at the end of its first edge.
using RowsOfSets = std::map<std::size_t, std::array<EdgeRows, 2>>;

/// The rows of all members. The rows of one member apply to all members that have the edge.
/// @throw NotSweepable "assembly.layers_differ"  different tables end on one edge
/// @note  O(edges + facets).
RowsOfSets shared_rows(const SameEdges& edges);

} // namespace lacuna::sweep
