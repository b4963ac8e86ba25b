// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/closure/follow.h>

#include <vector>

namespace lacuna::closure {

/// What is missing of the line between two matched vertices: all of it where neither is on a wall, and the
/// part between what wall edges climb from either end where walls are there in part.
struct Gap {
    VertexId source, target; ///< on the rims
    VertexId from, to;       ///< where the wall edges end, from the source up and from the target down
    std::vector<topology::EdgeUse> below, above; ///< those edges, away from their rim
};

/// The gaps of all matched pairs, in the order of the match. A wall edge is climbed from a rim, and on while
/// the way turns by less than 45° from edge to edge.
std::vector<Gap> find_gaps(const topology::OpenVolume& volume, const matching::Match& match);

/// How void edges run where nobody gave them by hand.
struct Course {
    const Follower* follower = nullptr; ///< not null: bent as the given walls lead. @pre it leads
    bool smooth = false;                ///< a cubic that leaves both ends along tangents; `follower` is null
    const Follower* walls = nullptr; ///< where smooth looks for the tangents of walls; null: there are none
};

/// The paper's Algorithm 2: a void edge across each gap, and those given by hand.
///
/// A smooth one is the cubic Bézier curve from end to end along the tangents there: of the wall edge that
/// ends in the gap, else the way the given walls move the vertex off its rim, else the normal of the face.
/// Its handles are c / (3 cos²(θ/4)), c the chord and θ how far the tangents turn over it together: those of
/// the circular arc with the same chord and turn, which it follows within 0.03 % of the radius at 90°.
/// @throw InvalidInput  a void edge given by hand that names no vertex of the free rims, is doubled,
///         contradicts the match, or crosses a given face; names the vertices.
/// @throw NotClosed     smooth, and the ends do not say to which side the bend goes.
std::vector<EdgeId> make_void_edges(topology::OpenVolume& volume, const matching::Match& match,
                                    const std::vector<VoidEdge>& by_hand, const Course& course,
                                    const RunContext& context);

} // namespace lacuna::closure
