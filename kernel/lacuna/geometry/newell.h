// SPDX-License-Identifier: MIT
#pragma once

// In: points, triangles and plane regions, without a model; out: planes, fits, triangulations, maps and
// motions.
//
// Where to change things:
//   planes of loops and faces              newell.cpp
//   lengths and points along polylines     polyline.cpp
//   closest points, crossings, rays        facet_tree.cpp
//   exact signs; crossing loops            predicates.cpp, crossing.cpp
//   triangulating a plane region           triangulate.cpp, over delaunay.cpp
//   flattening facets                      flatten.cpp; its maps: flatten_maps.cpp, flatten_ring.cpp
//   harmonic values on triangles           harmonic.cpp
//   affine and rigid fits; principal axes  affine.cpp, spread.cpp
//   patches between four sides             transfinite.cpp; along a bend: swept_patch.cpp
//   motions of a source; along a path      motion.cpp, sweep_path.cpp
//   exact curves and surfaces              exact.h; those that a motion makes: swept_surface.cpp
//   linear systems                         dense_solve.cpp, sparse_factor.cpp, multigrid.cpp
//   minimising a function                  minimise.cpp

#include <lacuna/core/types.h>

#include <span>
#include <vector>

namespace lacuna::geometry {

/// Area vector of a closed loop (Newell): half the sum of the cross products of successive points. The
/// projection of the loop along this vector has a larger area than all other projections, and runs
/// counter-clockwise seen from the tip of the vector. The length of the vector is this area [model length²].
/// The vector does not depend on translation. The first point is not repeated.
Vec3 newell_vector(std::span<const Vec3> closed_loop);

/// A plane with an orthonormal, right-handed frame `u`, `v`, `normal`.
struct Plane {
    Vec3 origin = Vec3::Zero();
    Vec3 u = Vec3::UnitX();
    Vec3 v = Vec3::UnitY();
    Vec3 normal = Vec3::UnitZ();
};

/// The plane through `origin` with the given normal; its axes depend on the normal only.
/// @pre normal is finite and not zero; its length does not matter.
Plane plane_across(const Vec3& origin, const Vec3& normal);

/// The plane in which the projection of a face bounded by `loops` has the largest area.
///
/// The normal is the sum of the loops' Newell vectors; inner loops are directed oppositely, so holes are
/// subtracted. The origin is the mean of the points of the outer loop. If the sum vanishes (a slit, collinear
/// points, a figure of eight), the least-squares plane of all points is used, with either orientation.
/// @param loops  the outer loop first; no loop repeats its first point.
/// @throw InvalidInput "geometry.no_points"  there are no points.
Plane newell_plane(std::span<const std::vector<Vec3>> loops);

/// Coordinates of the projected point along `u` and `v` [model length].
Vec2 to_plane(const Plane& plane, const Vec3& point);

/// The point at coordinates `uv` and the given height above the plane.
Vec3 from_plane(const Plane& plane, const Vec2& uv, double height = 0);

/// Signed distance along the normal [model length].
double height(const Plane& plane, const Vec3& point);

} // namespace lacuna::geometry
