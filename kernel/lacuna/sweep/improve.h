// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// What the improvement steps of one call have spent so far.
struct ImproveSpent {
    double work = 0;                                            ///< number of cell evaluations
    std::optional<std::chrono::steady_clock::time_point> start; ///< when the first step began
};

struct ImproveOptions {
    double good_enough = 0.5; ///< cells with a smaller scaled Jacobian are worked on [-1, 1]
    int rings = 2;            ///< rings of neighbours that are moved together with these cells, >= 0
    int iterations = 60;      ///< descent steps of each minimisation, >= 1
    double work = 4e7;        ///< maximum number of cell evaluations, > 0; about 20 seconds of one core
    double seconds = 0;       ///< no step begins after this time, >= 0; 0: only `work` limits
    // `work` counts evaluations instead of time, so that the result is the same on every machine.
    /// The work and time spent so far, shared by copies of these options; null: each copy has its own limits.
    /// While a mesh has folded cells, only the work on this mesh counts, not that on earlier meshes.
    std::shared_ptr<ImproveSpent> spent{};
};

/// @throw InvalidInput  an option out of range; names it.
void check(const ImproveOptions& options);

/// The options with limits of work and time that all their copies share.
ImproveOptions with_shared_limits(ImproveOptions options);

/// The nodes of the skin that may slide, each along the surface on which its face lies.
struct Sliding {
    /// For each node of the mesh, the surface that it slides on; -1: it does not slide. Empty: no node
    /// slides.
    std::vector<Index> surface;
    std::function<void(Index surface, std::span<Vec3> points)> project; ///< moves the points onto that
                                                                        ///< surface
    /// The direction of a surface that is a curve, at a point; zero: it is no curve. Null: none is.
    std::function<Vec3(Index surface, const Vec3& point)> along{};
    /// For each node of the mesh, whether it is fixed, even if it is inside; empty: none is.
    std::vector<char> held{};
};

/// Two sides of a cell that are collinear or inverted because their nodes are fixed. No free node can repair
/// them.
struct StuckCorner {
    Index node = -1;
    std::array<Index, 2> to{-1, -1}; ///< the other ends of both sides
};

struct Improved {
    mesh::HexMesh mesh{};                   ///< the given one with its nodes moved
    std::size_t cells = 0;                  ///< cells that were worked on
    std::size_t moved = 0;                  ///< nodes that were free
    double before = 1, after = 1;           ///< minimum scaled Jacobian of those cells
    double mean_before = 1, mean_after = 1; ///< mean scaled Jacobian of those cells
    bool untangled = false;                 ///< whether some of those cells were folded before
    bool unfinished = false;                ///< stopped by the limit of work or time
    bool won = false;                       ///< whether the result has moved nodes
    /// Set if a cell has no volume because of fixed nodes; then nothing was tried.
    std::optional<StuckCorner> stuck{};
};

/// Move nodes to unfold folded cells and improve poor ones. Nodes on edges are fixed, and so are all nodes of
/// the skin that may not slide.
///
/// There are two stages. Each minimises an energy over the poor cells and their neighbours by L-BFGS:
/// 1. While a Jacobian is not positive: foldover-free maps (Garanzha et al. 2021). The energy consists of the
///    terms tr(JᵀJ)/χ^⅔ and (1 + D²)/χ at the eight corners of each cell. J contains the three edges at the
///    corner, relative to the edges of the cell's reference box; D is the determinant of J, and χ = (D + √(ε²
///    + D²))/2. The reference box has the cell's own mean edge lengths, so that thin layers stay thin. From
///    round to round, the regularisation ε is reduced while the smallest determinant grows.
/// 2. Then the sum of exp(-k s) over the scaled Jacobians s of the corners, with increasing k. The worst
///    corners have the largest terms. A share of the first energy is added: it keeps the lengths of the edges
///    and prevents folding.
///
/// @post  the minimum scaled Jacobian is not smaller than before. If no cell was folded, the mean decreases
///         by at most 0.01. If nothing improves, no node moves. Each cell is judged against the best quality
///         that its fixed nodes allow, so a cell that cannot improve does not stop the improvement of others.
///         Sliding nodes lie on their surfaces.
/// @throw InvalidInput  an option that `check()` refuses.
/// @note  Deterministic for any thread count, unless `seconds` ends it. O(iterations · cells of the region).
Improved improve(mesh::HexMesh mesh, const ImproveOptions& options = {}, const Sliding& sliding = {},
                 const RunContext& context = {});

} // namespace lacuna::sweep
