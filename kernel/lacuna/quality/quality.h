// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace lacuna::quality {

/// Smallest scaled Jacobian over the eight corners of a hexahedron, Verdict's without the centre; -1…1, 1 for a cube.
double scaled_jacobian(std::span<const Vec3, 8> corners);

/// True when the Jacobian of the trilinear map is positive everywhere in the cell.
///
/// Algorithm: Bézier coefficients of the Jacobian (Johnen, Weill and Remacle 2017): 27 coefficients, all
/// positive ⇒ valid; a corner not positive ⇒ invalid; else subdivided until decided or `max_depth`, then invalid.
bool certified_positive(std::span<const Vec3, 8> corners, int max_depth = 6);

/// A cell with what is wrong with it.
struct WorstCell {
    std::size_t cell = 0; ///< from 0
    int layer = -1;       ///< from 0; -1 where cells are a plain list
    Vec3 centre{0, 0, 0};
    double scaled_jacobian = 0;
};

struct Quality {
    std::size_t hexes = 0;
    double min_scaled_jacobian = 1;
    double mean_scaled_jacobian = 1;
    std::size_t inverted = 0;                ///< cells with a corner that is not positive
    std::size_t uncertified = 0;             ///< cells whose Jacobian could not be shown positive everywhere
    std::array<std::size_t, 20> histogram{}; ///< of the scaled Jacobian, twenty equal bins over [-1, 1]
    std::vector<WorstCell> worst;            ///< at most ten, worst first
    double volume = 0;                       ///< sum over the cells [model length³]
};

/// Measure every cell. Parallel; the same for any thread count. O(cells).
/// @pre  every corner is the number of a node (`prove()` checks it).
Quality measure(const mesh::HexMesh& mesh, const RunContext& context = {});

/// The same for hexahedra of any origin.
Quality measure_cells(std::span<const Vec3> nodes, std::span<const Hex> hexes,
                      const RunContext& context = {});

/// As a table with a histogram.
std::string to_table(const Quality& quality);

/// Prove a mesh fit to be written: conformal (every side of a cell used once or twice), skin closed and made of
/// exactly the patches, no node twice in one place or unused, every Jacobian certified positive.
/// @throw NotSweepable  names what is wrong, the worst cells, their layer and place.
Quality prove(const mesh::HexMesh& mesh, double min_scaled_jacobian = 0, const RunContext& context = {});

/// The same for hexahedra of any origin.
/// @param skin  where not empty, quads that must be exactly the skin, in any order and direction.
Quality prove_cells(std::span<const Vec3> nodes, std::span<const Hex> hexes, std::span<const Quad> skin = {},
                    double min_scaled_jacobian = 0, const RunContext& context = {});

} // namespace lacuna::quality
