// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>

#include <cstddef>

namespace lacuna::sweep {

struct UntangleOptions {
    double good_enough = 0.2; ///< cells with a smaller scaled Jacobian are worked on [-1, 1]
    int rings = 2;            ///< layers of neighbours that may move with them
    int rounds = 40;          ///< minimisations, each with a smaller regularisation
    double seconds = 20;      ///< stop after a round that ends later than this
};

struct Untangled {
    std::size_t cells = 0;        ///< cells that took part
    std::size_t moved = 0;        ///< nodes that took part
    double before = 1, after = 1; ///< least scaled Jacobian of the mesh
};

/// Move inside nodes so that folded and poor cells open up; the skin stays where it is.
///
/// Algorithm: foldover-free maps (Garanzha et al. 2021): the energy tr(JᵀJ)/χ^⅔ and (1 + det²)/χ with χ = (D + √(ε² + D²))/2
/// at the eight corners of each cell, ε falling as the least determinant rises, minimised by L-BFGS. Each cell's reference is a box
/// of its own mean edge lengths, so that thin layers stay thin.
/// @post  the least scaled Jacobian is not smaller than before: where nothing was won, nothing is changed.
/// @note  Deterministic for any thread count while the time lasts.
Untangled untangle(mesh::HexMesh& mesh, const UntangleOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::sweep
