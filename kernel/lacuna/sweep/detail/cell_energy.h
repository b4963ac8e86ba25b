// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>

namespace lacuna::sweep {

/// The eight corners of a cell; in a wedge corners 2 and 3, and 6 and 7, coincide.
enum class CellKind { hex, wedge };

/// Energies of one cell, sums over its eight corners, or the six of a wedge.
struct CellEnergy {
    /// Regularization of χ where the determinant is not positive, relative to the reference's volume.
    double epsilon = 1e-3;
    double shape = 1;     ///< weight of the foldover-free energy
    double sharpness = 0; ///< k of exp(-k s); 0: without that term
};

/// Mean edge lengths of a cell along u, v, w: its reference box. For a wedge, u and v are the mean of the
/// triangles' edges, and w is the mean height.
Vec3 mean_edges(const std::array<Vec3, 8>& corners, CellKind kind = CellKind::hex);

/// Minimum determinant of a corner's edges relative to the box; negative if folded.
double least_determinant(const std::array<Vec3, 8>& corners, const Vec3& box, CellKind kind = CellKind::hex);

/// Energy of a cell; its gradient by the corners is written to `slope`.
///
/// With J the corner's edges divided by the box's: shape · (127/128 tr(JᵀJ)/χ^⅔ + 1/128 (1 + det²)/χ), χ = (D
/// + √(ε² + D²))/2 (Garanzha et al. 2021), plus exp(-k s) with s the corner's scaled Jacobian. In a wedge the
/// sum over a triangle's corners is smallest for an equilateral triangle, because its angles have a fixed
/// sum.
double cell_energy(const CellEnergy& energy, const std::array<Vec3, 8>& corners, const Vec3& box,
                   std::array<Vec3, 8>& slope, CellKind kind = CellKind::hex);

} // namespace lacuna::sweep
