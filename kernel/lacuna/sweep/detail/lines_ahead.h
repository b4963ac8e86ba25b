// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/detail/same_edges.h>

#include <cstddef>
#include <functional>
#include <vector>

/// Closed lines inside an end, opposite to a wall of a neighbour. Internal to this folder.
namespace lacuna::sweep {

/// A part of the rim of a grid that must be about as fine as a line in front of it.
///
/// A closed line inside one end of a member is swept to the other end. If that end is a wall of a neighbour,
/// it is a grid, and the line follows sides of the grid there (`surface::path_around()`). The same holds for
/// lines in members that are joined to this member end by end.
struct LineAhead {
    std::size_t edge = 0;    ///< edge of the grid's rim
    double from = 0, to = 1; ///< the part in front of the line, as shares of the edge's length
    double size = 0;         ///< mean length of the line's sides [model length]
};

/// @param sides_of  number of sides of an edge.
/// @note  O(members × shared faces) if all members are joined end by end; usually O(shared faces).
std::vector<LineAhead> lines_ahead(const SameEdges& edges,
                                   const std::function<double(std::size_t)>& sides_of);

} // namespace lacuna::sweep
