// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/ids.h>

#include <utility>
#include <vector>

namespace lacuna::matching {

/// Positions of the vertices on a closed loop.
struct ArcLoop {
    std::vector<VertexId> vertices;
    std::vector<double> at;   ///< share of the loop's length at each vertex, in [0, 1), ascending
    std::vector<bool> corner; ///< by vertex: whether the loop has a corner there, see is_corner(); otherwise
                              ///< the vertex is smooth
    std::vector<bool> open;   ///< by vertex: false if the vertex is on a wall. Such a vertex causes no split
                              ///< and, if smooth, gets no partner
};

/// Vertex pairs, and places where a loop must be split to make a partner for a vertex of the other loop.
struct ArcPairs {
    std::vector<std::pair<VertexId, VertexId>> vertices;   ///< (source, target), in order along the source
    std::vector<std::pair<VertexId, double>> split_target; ///< source vertex, share of the target's length
    std::vector<std::pair<VertexId, double>> split_source; ///< target vertex, share of the source's length
};

/// Pair the vertices of two loops by arc length.
///
/// Hard pairs are kept, and arc length between them is scaled to match. Then, in this order:
/// - Each corner of the loop with fewer corners is paired with a corner of the other loop, in the order of
///   the loops and with the least sum of squared distances. A pair is rejected if its corners are further
///   apart than half of the longest side next to them. Arc length is scaled to match the remaining pairs too.
///   Corners on walls take part, because a wall may end before it reaches the other end.
/// - Other vertices, corner or smooth, are paired if their distance is at most `most_twist` and at most a
///   quarter of the shortest side next to them. A split instead would leave a short edge.
/// - For each unpaired corner that is on no wall, the other loop is split at the corresponding place. Smooth
///   vertices stay unpaired.
/// - If there is neither a pair nor a split, the target is split for the source vertex that is furthest from
///   the target's vertices.
/// @param offset  place that corresponds to the start of the source, as a share of the target's length.
/// @param backward  whether the target is traversed against its own direction.
/// @param most_twist  largest distance of paired smooth vertices, as a share of the loop.
/// @pre  hard pairs keep the order along the loops, see keeps_order().
ArcPairs pair_by_arc(const ArcLoop& source, const ArcLoop& target, double offset, bool backward,
                     const std::vector<std::pair<VertexId, VertexId>>& hard, double most_twist);

/// Whether pairs of vertices have the same cyclic order along both loops, so that no two pairs cross.
bool keeps_order(const ArcLoop& source, const ArcLoop& target, bool backward,
                 const std::vector<std::pair<VertexId, VertexId>>& pairs);

} // namespace lacuna::matching
