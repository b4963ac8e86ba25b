// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <array>
#include <string>
#include <vector>

/// Boundary layers on edges of an assembly's members. Internal to this folder.
namespace lacuna::sweep {

/// Rows that end on an edge: the required positions of its nodes, from both ends.
struct EdgeRows {
    struct AtEnd {
        std::vector<double> places; ///< running lengths from that end, rising [model length]
        FaceId face;                ///< whose rows they are
    };
    EdgeId edge;
    std::array<AtEnd, 2> end; ///< at its start and its end; no places: none
};

/// The rows of a member's boundary layers that end on edges of its source and target, and the layers at its
/// ends on its side lines. Empty if the sweep will refuse them with a reason.
/// @note  O(edges + facets).
std::vector<EdgeRows> edge_rows(const AssemblyMember& member);

} // namespace lacuna::sweep
