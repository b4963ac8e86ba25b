// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>
#include <span>
#include <vector>

/// The maps that `flatten()` tries. Private to this folder.
namespace lacuna::geometry::flat {

/// The shape of a triangle in the plane, with derived quantities.
struct Shape {
    double area = 0;              ///< limited from below, against rounding
    std::array<Vec2, 3> gradient; ///< gradient of the hat function of each corner
    bool thin = false;            ///< degenerate: the height is at most √ε times the longest side
};

/// Facets with consecutive point numbers.
struct Facets {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<std::vector<Index>> loops; ///< boundary loops, longest first, facets on the left
    std::vector<Shape> shapes;
    double area = 0;
};

using Positions = std::vector<Vec2>;

/// The points of a loop; the first is repeated at the end.
std::vector<Vec3> closed_places(const Facets& facets, const std::vector<Index>& loop);

/// Compute `shapes` and `area` of the facets.
void measure_shapes(Facets& facets);

/// Gradient of the map from a triangle to the plane.
Eigen::Matrix2d jacobian(const Facets& facets, std::size_t triangle, const Positions& positions);
/// The largest and the smallest singular value. The smallest has the sign of the determinant.
std::array<double, 2> stretches(const Eigen::Matrix2d& jacobian);

/// Least squares conformal map, scaled to the area of the facets.
Positions conformal(const Facets& facets);
/// As-rigid-as-possible map, starting from `positions`.
Positions as_rigid_as_possible(const Facets& facets, Positions positions, double settled);
/// Map of least symmetric Dirichlet energy, starting from `positions` and scaled to the area of the facets.
/// If `positions` flip a triangle, they are only scaled.
Positions injective(const Facets& facets, Positions positions, double settled);
/// Harmonic map to a disc with the area of the facets; holes are filled temporarily.
Positions convex(const Facets& facets);

/// Map facets with two loops to a plane ring, with the longer loop outside. Two harmonic functions on the
/// facets give the polar coordinates of a point: the logarithm of the radius is proportional to a height that
/// is constant on each loop, and the angle is proportional to arc length on both loops. The factor of the
/// height is chosen so that small circles stay round on average. Empty if the ratio of the radii would be too
/// large.
/// @pre  two loops
Positions ring(const Facets& facets);

/// Scale about the mean so that the signed areas of the triangles sum to the area of the facets.
void scale_to_area(const Facets& facets, Positions& positions);

} // namespace lacuna::geometry::flat
