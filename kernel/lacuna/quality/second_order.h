// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/quality/quality.h>

#include <span>
#include <vector>

namespace lacuna::quality {

/// What is known of a hexahedron of order 2.
struct CurvedCell {
    /// Smallest scaled Jacobian at the 27 nodes: the determinant of the map's derivatives over the product of
    /// their lengths; -1…1.
    double scaled_jacobian = 0;
    /// Smallest Bézier coefficient of the Jacobian over their mean, which is the cell's volume: all of the
    /// Jacobian over the volume lies above it [-].
    double bound = 0;
    double volume = 0;     ///< exact [model length³]
    bool positive = false; ///< the Jacobian is positive everywhere
};

/// Judge a cell of 27 nodes, in the order of `mesh::CellNodes`. A hex20 is judged as the hex27 it equals
/// (`mesh::as_hex27()`).
///
/// Algorithm: the Jacobian of a triquadratic map is a polynomial of degree five in each direction. Its 216
/// Bézier coefficients follow from its values on a grid of 6³ points @cite johnen_2013_curvilinear; all
/// positive: valid; a corner not positive: invalid; else the cell is cut in two along the direction that
/// helps most until decided, `max_depth` times a direction, and invalid if it is not decided then. Positive
/// means above what rounding leaves of the coefficients.
CurvedCell judge(std::span<const Vec3, 27> nodes, int max_depth = 4);

/// Whether middle nodes lie where the corners put them, to rounding: the cell is then as one of order 1.
bool is_straight(std::span<const Vec3, 27> nodes);

/// Places of all nodes of a cell, of a mesh of any order, as those of a hex27.
std::array<Vec3, 27> hex27_of(const mesh::HexMesh& mesh, std::size_t cell);

/// Cells of a mesh whose Jacobian cannot be shown positive everywhere, rising. Parallel.
std::vector<std::size_t> invalid_cells(const mesh::HexMesh& mesh, const RunContext& context = {});

/// Measure hexahedra of order 1 and 2 of any origin; those that are straight are measured as of order 1, the
/// others by `judge()`.
/// @param cells  of 8, 20 or 27 nodes; a middle node of -1 is left out and lies straight.
/// @param columns  as `measure_cells()` of hexahedra has them.
Quality measure_cells(std::span<const Vec3> nodes, std::span<const mesh::CellNodes> cells,
                      const RunContext& context = {}, std::span<const Index> columns = {});

} // namespace lacuna::quality
