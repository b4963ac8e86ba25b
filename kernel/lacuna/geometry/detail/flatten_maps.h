// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>
#include <span>
#include <vector>

/// The maps that `flatten()` chooses from. Private to this folder.
namespace lacuna::geometry::flat {

/// A triangle's shape in the plane, and what follows from it.
struct Shape {
    double area = 0;              ///< kept above what rounding can bear
    std::array<Vec2, 3> gradient; ///< of the hat function of each corner
    bool thin = false;            ///< of no area to half the digits of a double
};

/// Facets with points numbered densely.
struct Facets {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<std::vector<Index>> loops; ///< boundary, the longest first, facets on the left
    std::vector<Shape> shapes;
    double area = 0;
};

using Positions = std::vector<Vec2>;

/// Set `shapes` and `area`.
void measure_shapes(Facets& facets);

/// Gradient of the map from a triangle to where its corners lie in the plane.
Eigen::Matrix2d jacobian(const Facets& facets, std::size_t triangle, const Positions& positions);
/// Largest and smallest singular value, the smallest signed as the determinant.
std::array<double, 2> stretches(const Eigen::Matrix2d& jacobian);

/// Least squares conformal map, scaled to the facets' area.
Positions conformal(const Facets& facets);
/// As rigid as possible, started from `positions`.
Positions as_rigid_as_possible(const Facets& facets, Positions positions, int max_iterations, double settled);
/// Least symmetric Dirichlet energy, started from `positions`, which come back if they turn a facet over.
Positions injective(const Facets& facets, Positions positions, int max_iterations, double settled);
/// Harmonic map onto a disc of the facets' area, holes filled meanwhile.
Positions convex(const Facets& facets);

/// Facets with two loops onto a ring of the plane, the longer loop outside. The logarithm of the radii goes
/// with a harmonic height, over such a range that small circles stay as round as one number can make them;
/// the angles are harmonic, on both loops by their lengths. Empty where the ring would be too wide.
/// @pre  two loops
Positions ring(const Facets& facets);

/// Scale about the mean so that the triangles' signed areas sum to the facets' area.
void scale_to_area(const Facets& facets, Positions& positions);

} // namespace lacuna::geometry::flat
