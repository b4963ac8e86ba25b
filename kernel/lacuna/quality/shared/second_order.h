// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/quality/quality.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace lacuna::quality {

/// Validity and quality of a hexahedron of order 2.
struct CurvedCell {
    /// Smallest scaled Jacobian at the 27 nodes: the determinant of the derivatives of the map divided by the
    /// product of their lengths; between -1 and 1.
    double scaled_jacobian = 0;
    /// Smallest Bézier coefficient of the Jacobian divided by the mean of all coefficients, which is the
    /// volume of the cell: a lower bound of Jacobian / volume [-].
    double bound = 0;
    double volume = 0;     ///< exact [model length³]
    bool positive = false; ///< the Jacobian is positive everywhere
};

/// Measure a cell with 27 nodes, in the order of `mesh::CellNodes`. A hex20 is converted to its equivalent
/// hex27 by `mesh::as_hex27()`.
///
/// Algorithm: the Jacobian of a triquadratic map is a polynomial of degree five in each direction. Its 216
/// Bézier coefficients follow from its values on a grid of 6³ points @cite johnen_2013_curvilinear. If all
/// coefficients are positive, the cell is valid. If the coefficient at a corner is not positive, the cell is
/// invalid. Otherwise the cell is bisected, each time along the direction with the smallest inner
/// coefficient, and at most `max_depth` times along each direction. If this does not decide, the cell counts
/// as invalid. A coefficient counts as positive only if it exceeds its rounding error.
CurvedCell judge(std::span<const Vec3, 27> nodes, int max_depth = 4);

/// Whether the middle nodes are where linear interpolation puts them, up to rounding. The cell then has the
/// shape of a cell of order 1.
bool is_straight(std::span<const Vec3, 27> nodes);

/// The node coordinates of a cell of any order, converted to those of a hex27.
std::array<Vec3, 27> hex27_of(const mesh::HexMesh& mesh, std::size_t cell);

/// Cells of a mesh whose Jacobian is not proved positive everywhere, ascending. Parallel.
std::vector<std::size_t> invalid_cells(const mesh::HexMesh& mesh, const RunContext& context = {});

/// Measure a cell of a list.
/// @return empty if its middle nodes are where linear interpolation puts them, so that it is a cell of order
///         1.
/// @param cell  as `mesh::merged_nodes()`; a middle node of -1 is missing and interpolated linearly
std::optional<CurvedCell> judge_listed(std::span<const Vec3> nodes, const mesh::CellNodes& cell);

/// The curved cells of a list whose Jacobian is not proved positive everywhere, ascending. Parallel.
std::vector<std::size_t> invalid_cells(std::span<const Vec3> nodes, std::span<const mesh::CellNodes> cells,
                                       const RunContext& context = {});

/// Measure a list of cells of order 1 and 2: straight cells by their corners, curved cells with
/// `judge_listed()`.
/// @param columns  as for `measure_cells()` of hexahedra.
Quality measure_cells(std::span<const Vec3> nodes, std::span<const mesh::CellNodes> cells,
                      const RunContext& context = {}, std::span<const Index> columns = {});

} // namespace lacuna::quality
