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
    std::vector<bool> corner; ///< false for a vertex on a smooth run
    std::vector<bool> open;   ///< false for a vertex on a wall: it needs no split and, if smooth, no partner
};

/// Vertex pairs, and the places where an edge must be split to give a vertex of the other loop a partner.
struct ArcPairs {
    std::vector<std::pair<VertexId, VertexId>> vertices;   ///< (source, target), in order along the source
    std::vector<std::pair<VertexId, double>> split_target; ///< source vertex, share of the target's length
    std::vector<std::pair<VertexId, double>> split_source; ///< target vertex, share of the source's length
};

/// Pair the vertices of two loops by arc length.
///
/// Hard pairs are kept, and arc length between them is scaled to match. Then, in this order:
/// - All corners of the loop with fewer corners are paired with corners of the other loop, in order and with
///   the least sum of squared distances. A pair is rejected if its corners are more than half a side apart
///   and another corner is closer. Arc length is scaled to match these pairs too. Corners on walls take part,
///   as a wall may end before the other end.
/// - Remaining vertices of any kind are paired if their distance is less than `most_twist` and a quarter of
///   the shortest side next to them; splitting there would leave a short edge.
/// - For each corner that is still unpaired, the other loop is split at the same share of its length. Smooth
///   vertices stay unpaired.
/// - If there is neither a pair nor a split, the target is split for the source vertex that is furthest from
///   the target's vertices.
/// @param offset  share of the target's length at which the source starts.
/// @param backward  the target is traversed against the source.
/// @param most_twist  largest distance of paired smooth vertices, as a share of the loop.
/// @pre hard pairs keep the order along the loops: keeps_order().
ArcPairs pair_by_arc(const ArcLoop& source, const ArcLoop& target, double offset, bool backward,
                     const std::vector<std::pair<VertexId, VertexId>>& hard, double most_twist);

/// Whether pairs of vertices keep the order along the loops, that is, do not cross.
bool keeps_order(const ArcLoop& source, const ArcLoop& target, bool backward,
                 const std::vector<std::pair<VertexId, VertexId>>& pairs);

} // namespace lacuna::matching
