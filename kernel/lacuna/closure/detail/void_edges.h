// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/closure/shared/follow.h>

#include <vector>

namespace lacuna::closure {

/// The missing part of the line between two matched vertices. Wall edges that start at a matched vertex and
/// lead towards the other end are existing parts of the line; the gap is the rest.
struct Gap {
    VertexId source, target; ///< the matched vertices
    VertexId from, to;       ///< the ends of the gap: the last vertices of `below` and `above`; `source` or
                             ///< `target` if there are no wall edges
    std::vector<topology::EdgeUse> below, above; ///< the wall edges from `source` to `from`, and from
                                                 ///< `target` to `to`
};

/// The gaps of all matched pairs, in the order of the match. Pairs without a gap are left out. Wall edges are
/// followed from each rim as long as the direction turns by less than 45° from edge to edge.
std::vector<Gap> find_gaps(const topology::OpenVolume& volume, const matching::Match& match);

/// Shape of the void edges that the user did not give; straight by default.
struct Course {
    const Follower* follower = nullptr; ///< void edges follow this motion; may be null. @pre leads()
    bool smooth = false;                ///< void edges are cubics; `follower` is then null
    const Follower* walls = nullptr;    ///< for `smooth`: the motion of the given walls, for tangents at
                                        ///< matched vertices; null: no given wall
};

/// Make a void edge across each gap, and the void edges of the user: Algorithm 2 of the paper
/// (docs/bibliography.md).
///
/// A smooth edge is a cubic Bézier curve. Its tangent at an end is the first of these that exists:
/// 1. the tangent of the wall edge that ends at the gap;
/// 2. the direction of the given walls at the matched vertex (`Course::walls`);
/// 3. the mean normal of the end's faces at the matched vertex, towards the void.
///
/// The distance of an inner control point from the nearer end is c / (3 cos²(θ/4)), where c is the chord and
/// θ the sum of the angles between the tangents and the chord. With this distance the curve approximates a
/// circular arc of 90° within 0.03 % of the radius.
/// @throw InvalidInput  a user's void edge names a vertex that is not on a free rim, is given twice,
///         contradicts the match, or crosses a given face; names the vertices.
/// @throw NotClosed  edges are smooth, and the ends do not determine to which side they bend.
std::vector<EdgeId> make_void_edges(topology::OpenVolume& volume, const matching::Match& match,
                                    const std::vector<VoidEdge>& by_hand, const Course& course,
                                    const RunContext& context);

} // namespace lacuna::closure
