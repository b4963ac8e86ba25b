// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/ids.h>

#include <utility>
#include <vector>

namespace lacuna::matching {

/// A closed loop by where its vertices stand.
struct ArcLoop {
    std::vector<VertexId> vertices;
    std::vector<double> at;   ///< share of the loop's length at each vertex, in [0, 1), rising
    std::vector<bool> corner; ///< false for a vertex that only says where a smooth run was cut
    std::vector<bool> open;   ///< false for a vertex on a wall: it wants no split, nor, smooth, a partner
};

/// Vertices paired, and places that need a vertex for one to pair with.
struct ArcPairs {
    std::vector<std::pair<VertexId, VertexId>> vertices;   ///< (source, target), in order along the source
    std::vector<std::pair<VertexId, double>> split_target; ///< source vertex, share of the target's length
    std::vector<std::pair<VertexId, double>> split_source; ///< target vertex, share of the source's length
};

/// Pair the vertices of two loops by how far along the loops they stand.
///
/// Hard pairs hold, and shares between them are stretched to meet. Then, in this order:
/// - Corners meet corners: of the loop with fewer all, the nearest ones that keep the order (least sum of
///   squares); but none further apart than half a side of either, for which another corner is closer. Shares
///   are stretched to meet there too. Corners on walls take part: a wall may stop short of the other end.
/// - Vertices left, of any kind, are paired where they are nearer than a quarter of the shortest side beside
///   them, rather than cut off a short piece, and than `most_twist`.
/// - A corner left wants a vertex at its share of the other loop. Smooth vertices need none.
/// - A loop that has no pair so far gets one: the source vertex whose place is farthest from the target's
///   vertices wants one there.
/// @param offset      share of the target's length where the source's start lies.
/// @param backward    the target runs against the source.
/// @param most_twist  share of a loop that smooth vertices may be apart.
/// @pre hard pairs keep the order along the loops: keeps_order().
ArcPairs pair_by_arc(const ArcLoop& source, const ArcLoop& target, double offset, bool backward,
                     const std::vector<std::pair<VertexId, VertexId>>& hard, double most_twist);

/// True where pairs of vertices do not cross along the loops.
bool keeps_order(const ArcLoop& source, const ArcLoop& target, bool backward,
                 const std::vector<std::pair<VertexId, VertexId>>& pairs);

} // namespace lacuna::matching
