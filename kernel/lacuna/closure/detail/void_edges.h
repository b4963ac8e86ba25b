// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/closure/shared/follow.h>

#include <vector>

namespace lacuna::closure {

/// The missing part of the line between two matched vertices: the whole line if neither is on a wall,
/// otherwise the part between the upper ends of the wall edges that start at either vertex.
struct Gap {
    VertexId source, target; ///< on the rims
    VertexId from, to;       ///< where the wall edges end, up from the source and down from the target
    std::vector<topology::EdgeUse> below, above; ///< the wall edges up to `from` and down to `to`, directed
                                                 ///< away from their rim
};

/// The gaps of all matched pairs, in the order of the match. Wall edges are followed from each rim as long as
/// the direction turns by less than 45° from edge to edge.
std::vector<Gap> find_gaps(const topology::OpenVolume& volume, const matching::Match& match);

/// Course of the void edges that the user did not give.
struct Course {
    const Follower* follower = nullptr; ///< void edges follow the motion of these walls; may be null. @pre
                                        ///< leads()
    bool smooth = false;                ///< void edges are cubics along tangents; `follower` is then null
    const Follower* walls = nullptr;    ///< source of wall tangents for `smooth`; null: none
};

/// The paper's Algorithm 2: a void edge across each gap, and the void edges of the user.
///
/// A smooth edge is a cubic Bézier curve. Its tangent at an end is that of the wall edge that ends at the
/// gap, otherwise the direction in which the given walls move the vertex off its rim, otherwise the face's
/// normal. Its handles have the length c / (3 cos²(θ/4)), where c is the chord and θ the total turn of the
/// tangents. These are the handles of the circular arc with the same chord and turn, which the curve
/// approximates within 0.03 % of the radius at 90°.
/// @throw InvalidInput  a user's void edge names no vertex of the free rims, is given twice, contradicts the
///         match, or crosses a given face; names the vertices.
/// @throw NotClosed  edges are smooth, and the ends do not determine to which side they bend.
std::vector<EdgeId> make_void_edges(topology::OpenVolume& volume, const matching::Match& match,
                                    const std::vector<VoidEdge>& by_hand, const Course& course,
                                    const RunContext& context);

} // namespace lacuna::closure
