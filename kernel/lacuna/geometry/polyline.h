// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::geometry {

/// Running length along a chain of points; 0 at the first, never falling. A closed chain repeats its first
/// point at the end.
///
/// @return as many lengths as points [model length].
std::vector<double> arc_lengths(std::span<const Vec3> points);

/// Length of the chain, the last of `arc_lengths()`; 0 for fewer than two points [model length].
double length(std::span<const Vec3> points);

/// How far a smooth curve through the points may be off the chain between them [model length]: a side times
/// the angle it makes with the next, over 8, at the most. Angles above a right one are corners and count for
/// nothing.
double sag(std::span<const Vec3> points);

/// A place on a chain: `fraction` of the way from point `segment` to point `segment + 1`.
struct PolylinePlace {
    std::size_t segment = 0;
    double fraction = 0; ///< in [0, 1]
};

/// Where the running length is `s`; the ends stand for all that lies beyond them.
///
/// A point of the chain is found as fraction 0 of the segment it starts (the last as fraction 1 of the last
/// segment), and segments of no length are stepped over.
/// @param arc_lengths  of the chain, as `arc_lengths()` gives them.
/// @pre   arc_lengths is not empty; a chain of one point gives segment 0, fraction 0.
/// @note  O(log points).
PolylinePlace place_at(std::span<const double> arc_lengths, double s);

/// The point at running length `s`, clamped to the chain. The points of the chain come back bit for bit at
/// their own running length.
/// @pre points.size() == arc_lengths.size() > 0
Vec3 point_at(std::span<const Vec3> points, std::span<const double> arc_lengths, double s);

/// Places that part a chain into so many pieces of one length, both ends included: `pieces + 1` of them.
/// @pre points.size() > 0, pieces > 0
std::vector<Vec3> even_places(std::span<const Vec3> points, std::size_t pieces);

/// Unit tangent at the end of a chain that is walked from its start; as if the points lay on an arc.
/// @pre points.size() > 1
Vec3 end_tangent(std::span<const Vec3> points);

} // namespace lacuna::geometry
