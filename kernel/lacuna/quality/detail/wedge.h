// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quality/detail/cell_batch.h>

#include <array>
#include <span>

/// Arithmetic of one wedge. Internal to this folder.
///
/// The map of a wedge is linear over its triangle and along its height w. Let a(w) and b(w) be two edge
/// vectors of the triangle, linear in w, V_i the three edge vectors along the height, and l_i the barycentric
/// coordinates. The Jacobian is the sum of l_i det(a(w), b(w), V_i): linear over the triangle and quadratic
/// in w. It has nine Bernstein coefficients, three for each V = V_i: det(a0, b0, V), the mean of
/// det(a0, b1, V) and det(a1, b0, V), and det(a1, b1, V). The indices 0 and 1 of a and b denote w = 0 and
/// w = 1.
namespace lacuna::quality {

using WedgeCorners = std::array<Vec3, 6>;

struct WedgeValues {
    /// The smallest scaled Jacobian of the six corners, as in Verdict: the determinant of the three edges at
    /// a corner, divided by the product of their lengths, times 2/√3. It is 1 for a right prism on an
    /// equilateral triangle, and 0 if an edge has zero length.
    double scaled = 0;
    double smallest = 0; ///< smallest coefficient: a lower bound of J
    double volume = 0;
    std::array<std::array<double, 3>, 3> coefficients{}; ///< [i][coefficient along w]
};

WedgeValues evaluate_wedge(std::span<const Vec3, 6> corners);

/// Convert the coefficients to those of a cell over the unit cube: a square whose one side is collapsed to
/// the third corner of the triangle replaces the triangle. The converted Jacobian is positive everywhere in
/// the cube if and only if the wedge's Jacobian is positive everywhere in the wedge.
Coefficients over_cube(const WedgeValues& values);

} // namespace lacuna::quality
