// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quality/quality.h>

#include <span>
#include <vector>

namespace lacuna::quality {

/// Result of the proof of a list of cells.
struct CellsProof : Proof {
    /// The sides that belong to one cell only, oriented outward, in an order that depends on the cells alone;
    /// a triangle is {a, b, c, c}. Empty if a fault was found.
    std::vector<Quad> skin;
};

/// Prove that cells of any origin are a valid mesh, as `prove()` does for a swept mesh. A valid mesh fulfils
/// these conditions:
/// - each side is used once, or twice in opposite directions;
/// - no quad of one cell lies against triangles of others;
/// - the skin is closed;
/// - no nodes coincide or are unused;
/// - every Jacobian is certified positive.
/// @param cells  hexahedra, and others as for `measure_cells()`.
/// @throw Cancelled
/// @note  O(cells) if few sides meet at a node. Independent of the number of threads.
CellsProof prove_cells(std::span<const Vec3> nodes, std::span<const Hex> cells,
                       const RunContext& context = {});

} // namespace lacuna::quality
