// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>

namespace lacuna::sweep {

/// The eight corners of a cell; in a wedge corners 2 and 3, and 6 and 7, coincide.
enum class CellKind { hex, wedge };

/// Weights of the energies of one cell. Each energy is a sum over the eight corners of a hexahedron, or the
/// six corners of a wedge.
struct CellEnergy {
    /// Regularization ε of χ for determinants that are not positive, relative to the volume of the reference
    /// box.
    double epsilon = 1e-3;
    double shape = 1;     ///< weight of the foldover-free energy
    double sharpness = 0; ///< k in exp(-k s); 0: without this term
};

/// Mean edge lengths of a cell along u, v and w, which define its reference box. In a wedge, u and v are the
/// mean of the triangles' edges, and w is the mean height.
Vec3 mean_edges(const std::array<Vec3, 8>& corners, CellKind kind = CellKind::hex);

/// Minimum over the corners of the determinant of the edges, relative to the volume of the box; negative if
/// folded.
double least_determinant(const std::array<Vec3, 8>& corners, const Vec3& box, CellKind kind = CellKind::hex);

/// Energy of a cell; its gradient with respect to the corners is written to `slope`.
///
/// Let J be the edges at a corner divided by those of the box, D its determinant, and s the scaled Jacobian
/// of the corner. The energy of the corner is shape · (127/128 tr(JᵀJ)/χ^⅔ + 1/128 (1 + D²)/χ) + exp(-k s),
/// with χ = (D + √(ε² + D²))/2 (Garanzha et al. 2021). In a wedge, the sum over a triangle's corners is
/// smallest for an equilateral triangle, because its angles have a fixed sum.
double cell_energy(const CellEnergy& energy, const std::array<Vec3, 8>& corners, const Vec3& box,
                   std::array<Vec3, 8>& slope, CellKind kind = CellKind::hex);

} // namespace lacuna::sweep
