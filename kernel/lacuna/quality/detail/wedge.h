// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quality/detail/cell_batch.h>
#include <lacuna/quality/metrics.h>

#include <array>
#include <optional>

/// The arithmetic of one wedge. Internal to this folder.
///
/// The map of a wedge is linear over its triangle and along its height w. With the edges of the triangle a(w)
/// and b(w), both linear in w, and the three edges along the height V_i, its Jacobian is the sum of l_i
/// det(a(w), b(w), V_i) over the barycentric coordinates l_i: linear over the triangle and of degree two in
/// w. Nine Bernstein coefficients hold it, three for each V_i: det(a0, b0, V), the mean of det(a0, b1, V) and
/// det(a1, b0, V), and det(a1, b1, V).
namespace lacuna::quality {

using WedgeCorners = std::array<Vec3, 6>;

struct WedgeValues {
    /// Verdict's: least at the six corners of the Jacobian over the lengths of the three edges there, times
    /// 2/√3; 1 for an even triangle times a height, 0 where an edge has no length.
    double scaled = 0;
    double smallest = 0; ///< smallest coefficient: all of J lies above it
    double volume = 0;
    std::array<std::array<double, 3>, 3> coefficients{}; ///< [i][power of w]
};

WedgeValues evaluate_wedge(const WedgeCorners& corners);

/// The coefficients as those of a cell over the unit cube, whose square is laid over the triangle with one
/// side shrunk to its third corner: they are positive everywhere where the wedge's are.
Coefficients over_cube(const WedgeValues& values);

/// The metric where it is one of wedges: the scaled Jacobian, the Jacobian and the volume.
std::optional<double> wedge_metric(Metric metric, const WedgeCorners& corners);

} // namespace lacuna::quality
