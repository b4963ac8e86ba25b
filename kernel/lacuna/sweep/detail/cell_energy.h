// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>

namespace lacuna::sweep {

/// What eight corners are; a wedge has corners 2 and 3, and 6 and 7, in one.
enum class CellKind { hex, wedge };

/// Energies of one cell, sums over its eight corners, or the six of a wedge.
struct CellEnergy {
    /// How far χ stays from nought where the determinant is not positive; of the reference's volume.
    double epsilon = 1e-3;
    double shape = 1;     ///< weight of the foldover-free energy
    double sharpness = 0; ///< k of exp(-k s); 0: without that term
};

/// Mean edge lengths along u, v, w: the box a cell is measured against. Of a wedge, that of its
/// triangles' edges for u and v, and that along its height.
Vec3 mean_edges(const std::array<Vec3, 8>& corners, CellKind kind = CellKind::hex);

/// Least determinant of a corner's edges over those of the box; negative where folded.
double least_determinant(const std::array<Vec3, 8>& corners, const Vec3& box, CellKind kind = CellKind::hex);

/// Energy of a cell, its slopes by the corners written to `slope`.
///
/// With J the corner's edges over the box's: shape · (127/128 tr(JᵀJ)/χ^⅔ + 1/128 (1 + det²)/χ), χ = (D +
/// √(ε² + D²))/2 (Garanzha et al. 2021), and exp(-k s), s the corner's scaled Jacobian.
/// Of a wedge the energies of a triangle's three corners, whose angles have one sum, are least together where
/// the triangle is even.
double cell_energy(const CellEnergy& energy, const std::array<Vec3, 8>& corners, const Vec3& box,
                   std::array<Vec3, 8>& slope, CellKind kind = CellKind::hex);

} // namespace lacuna::sweep
