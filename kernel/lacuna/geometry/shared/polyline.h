// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::geometry {

/// Arc length at each point of a polyline; 0 at the first, not decreasing. A closed polyline repeats its
/// first point at the end.
///
/// @return one length for each point [model length].
std::vector<double> arc_lengths(std::span<const Vec3> points);

/// Length of a polyline; 0 for fewer than two points [model length].
double length(std::span<const Vec3> points);

/// Centroid of the closed polyline through points; the first point is not repeated at the end. It does not
/// depend on how densely the points lie, as their mean does. Zero for no points.
Vec3 centre_of_ring(std::span<const Vec3> points);

/// Estimated sag: the largest distance between the polyline and a smooth curve through its points [model
/// length]. Each pair of neighbouring segments gives the estimate L · α / 8, where L is the length of the
/// longer segment and α the angle between both; the result is the largest estimate. Angles above 90° are
/// corners and ignored.
double sag(std::span<const Vec3> points);

/// A position on a polyline: `fraction` of the segment from point `segment` to point `segment + 1`.
struct PolylinePlace {
    std::size_t segment = 0;
    double fraction = 0; ///< in [0, 1]
};

/// The position at arc length `s`, clamped to the ends.
///
/// A point of the polyline is returned as fraction 0 of the segment that starts there; the last point as
/// fraction 1 of the last segment. Segments of zero length are skipped.
/// @param arc_lengths  as returned by `arc_lengths()`.
/// @pre   arc_lengths is not empty; a polyline of one point gives segment 0, fraction 0.
/// @note  O(log points).
PolylinePlace place_at(std::span<const double> arc_lengths, double s);

/// The point at arc length `s`, clamped to the ends. At the arc length of a given point, that point is
/// returned bit for bit.
/// @pre points.size() == arc_lengths.size() > 0
Vec3 point_at(std::span<const Vec3> points, std::span<const double> arc_lengths, double s);

/// Points that divide a polyline into `pieces` of equal length, both ends included: `pieces + 1` points.
/// @pre points.size() > 0, pieces > 0
std::vector<Vec3> even_places(std::span<const Vec3> points, std::size_t pieces);

/// Unit tangent at the last point, in the direction of the polyline. It is estimated as if the last three
/// points were equally spaced on an arc.
/// @pre points.size() > 1
Vec3 end_tangent(std::span<const Vec3> points);

} // namespace lacuna::geometry
