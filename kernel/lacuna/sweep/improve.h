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

/// A time limit shared by all improvement steps. It starts when the first step begins.
class ImproveDeadline {
public:
    explicit ImproveDeadline(double seconds) : seconds_(seconds) {}
    bool passed();

private:
    double seconds_;
    std::optional<std::chrono::steady_clock::time_point> start_;
};

struct ImproveOptions {
    double good_enough = 0.5; ///< cells with a smaller scaled Jacobian are worked on [-1, 1]
    int rings = 2;            ///< rings of neighbours that move with them, >= 0
    int iterations = 60;      ///< descent steps of each minimisation, >= 1
    double work = 4e7;        ///< maximum number of cell evaluations, > 0; about 20 seconds of one core
    double seconds = 0;       ///< no step begins after this time, >= 0; 0: only `work` limits
    // `work` counts evaluations instead of time, so that the result is the same on every machine.
    /// State of `seconds`, for copies of these options that share one limit; null: each has its own.
    std::shared_ptr<ImproveDeadline> deadline{};
};

/// @throw InvalidInput  an option out of range; names it.
void check(const ImproveOptions& options);

/// The options with a time limit that their copies share, if there is any.
ImproveOptions with_deadline(ImproveOptions options);

/// Skin nodes that may slide, each along the surface its face lies on.
struct Sliding {
    std::vector<Index> surface; ///< for each node of the mesh; -1: inside, or fixed. Empty: no node slides
    std::function<void(Index surface, std::span<Vec3> points)> project; ///< moves the points onto that
                                                                        ///< surface
    std::vector<char> held{}; ///< for each node of the mesh: it is fixed, also inside; empty: none
};

/// Two sides of a cell that are collinear or inverted because of fixed nodes: no free node can repair them.
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
    bool untangled = false;                 ///< some were folded before
    bool unfinished = false;                ///< stopped by the limit of work or time
    bool won = false;                       ///< nodes were moved in the end
    std::optional<StuckCorner> stuck{};     ///< set for a cell without volume; then nothing was tried
};

/// Move nodes to unfold folded cells and improve poor ones. Nodes of edges are fixed, as are all nodes of the
/// skin that may not slide.
///
/// Two stages, both minimised over the poor cells and their neighbours by L-BFGS:
/// 1. While a Jacobian is not positive: foldover-free maps (Garanzha et al. 2021). The energy is tr(JᵀJ)/χ^⅔
///    and (1 + det²)/χ with χ = (D + √(ε² + D²))/2 at the eight corners of each cell; ε falls as the least
///    determinant rises. A cell is measured against a box of its own mean edge lengths, so that thin layers
///    stay thin.
/// 2. Then the sum of exp(-k s) over the corners' scaled Jacobians s, whose heaviest terms are the worst
///    corners, with k rising. A share of the first energy keeps the edges' lengths and is the barrier against
///    folding.
///
/// @post  the minimum scaled Jacobian is not smaller than before, nor is the mean by more than a hundredth if
///        no cell was folded. Without improvement nothing is changed. A cell that fixed nodes keep poor does
///        not block others: each is judged by the distance from its achievable quality. Sliding nodes lie on
///        their surfaces.
/// @throw InvalidInput  what `check()` refuses.
/// @note  Deterministic for any thread count, unless `seconds` ends it. O(iterations · cells of the region).
Improved improve(mesh::HexMesh mesh, const ImproveOptions& options = {}, const Sliding& sliding = {},
                 const RunContext& context = {});

} // namespace lacuna::sweep
