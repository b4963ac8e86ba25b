// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <span>
#include <vector>

namespace lacuna::geometry {

/// Area vector of a closed loop (Newell): half the sum of the cross products of successive points. Its
/// direction is that from which the loop encloses most, counter-clockwise; its length is that area
/// [model length²]. The first point is not repeated. It does not depend on where the loop lies.
Vec3 newell_vector(std::span<const Vec3> closed_loop);

/// A plane with axes: `u`, `v` and `normal` are orthonormal and right-handed.
struct Plane {
    Vec3 origin = Vec3::Zero();
    Vec3 u = Vec3::UnitX();
    Vec3 v = Vec3::UnitY();
    Vec3 normal = Vec3::UnitZ();
};

/// The plane through `origin` across `normal`, with axes of its own choice that depend on the normal alone.
/// @pre normal is finite and not zero; its length does not matter.
Plane plane_across(const Vec3& origin, const Vec3& normal);

/// The plane on which a face bounded by `loops` shows its largest area (the paper's Newell domain).
///
/// The normal is the sum of the loops' Newell vectors: inner loops run against the outer one, so they take
/// their holes away. The origin is the mean of the outer loop's points. Where the sum vanishes (a slit,
/// collinear points, a figure of eight) it is the least-squares plane of all points instead, either way up.
/// @param loops  the outer first; first points not repeated.
/// @throw InvalidInput "geometry.no_points"  there is no point at all.
Plane newell_plane(std::span<const std::vector<Vec3>> loops);

/// Coordinates of a point's foot along `u` and `v` [model length].
Vec2 to_plane(const Plane& plane, const Vec3& point);

/// The point `height` above the plane's place `uv`.
Vec3 from_plane(const Plane& plane, const Vec2& uv, double height = 0);

/// Signed distance along the normal [model length].
double height(const Plane& plane, const Vec3& point);

} // namespace lacuna::geometry
