// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>
#include <cstddef>
#include <cstdint>

/// Arithmetic for several cells at once. Internal to this folder.
///
/// Let U(v,w), V(u,w), W(u,v) be the edge vectors of the cell along u, v, w, each bilinear. The Jacobian of
/// the trilinear map is J = det(U, V, W), quadratic in each of u, v, w. Its 27 Bézier coefficients follow
/// from 20 determinants (Johnen, Weill and Remacle 2017):
/// - At a corner, the coefficient is J itself.
/// - At the middle of an edge along u, it is (J0 + J1 - det(U, V1 - V0, W1 - W0)) / 2. The indices 0 and 1
///   denote the two ends of the edge.
/// - At the middle of a side or of the cell, it follows from eight coefficients around it, which form a
///   square, because J has no u²v², u²w² or v²w² term. It is half the sum of the four coefficients at the
///   edges of the square, minus a quarter of the sum of the four at the corners of the square.
namespace lacuna::quality {

/// Number of cells processed together by vector instructions; their data fit into the first-level cache.
/// Measured with AVX2 and all coefficients of every cell: 27 ns per cell; 45 ns with 16 lanes, 31 ns with 64.
inline constexpr int kLanes = 32;

/// End corners of each edge, [d][e]. The edge runs in direction d (u, v, w). The two bits of e are the edge's
/// positions (0 or 1) in the other two directions; the lower bit belongs to the lower direction.
inline constexpr std::size_t kEdgeNodes[3][4][2] = {
    {{0, 1}, {3, 2}, {4, 5}, {7, 6}}, {{0, 3}, {1, 2}, {4, 7}, {5, 6}}, {{0, 4}, {1, 5}, {3, 7}, {2, 6}}};

/// Four corners of `N` cells; the same coordinate of all cells is contiguous.
template <int N>
using LevelBatch = double[4][3][N];

/// Corners of `N` cells. The upper corners of one cell can be used as the lower corners of the next.
template <int N>
struct CellBatch {
    alignas(64) LevelBatch<N> level[2];
    std::size_t low = 0; ///< index of the level that holds corners 0 to 3

    [[nodiscard]] double (&corner(std::size_t c))[3][N] { return level[low ^ (c / 4)][c % 4]; }
    [[nodiscard]] const double (&corner(std::size_t c) const)[3][N] { return level[low ^ (c / 4)][c % 4]; }
};

/// Results for `N` cells.
template <int N>
struct CellValues {
    /// Scaled Jacobian; 0 if an edge has zero length or a node is not finite.
    alignas(64) double scaled[N];
    /// Lower bound of J in the cell: an inexpensive positive bound, or the smallest Bézier coefficient.
    alignas(64) double smallest[N];
    alignas(64) double volume[N];
    alignas(64) double bezier[27][N]; ///< coefficient (a, b, c) at a + 3b + 9c
};

/// Evaluate a full batch with the widest vectors of the processor; the result has the same bits on every
/// processor. Coefficients are computed only if the inexpensive bound of some cell is not positive.
void evaluate(const CellBatch<kLanes>& batch, CellValues<kLanes>& values);

/// Evaluate the scaled Jacobian only; same bits as `evaluate()`.
void evaluate_scaled(const CellBatch<kLanes>& batch, double (&scaled)[kLanes]);

/// Evaluate one cell with all its coefficients; the scaled Jacobian has the same bits as in a batch.
void evaluate(const CellBatch<1>& batch, CellValues<1>& values);

/// Bézier coefficients of one cell, (a, b, c) at a + 3b + 9c.
using Coefficients = std::array<double, 27>;

/// View of the coefficients of one cell, stored alone or in a batch.
struct CoefficientsView {
    const double* first;
    std::size_t apart; ///< stride between coefficients

    [[nodiscard]] double at(std::size_t number) const { return first[apart * number]; }
};
inline CoefficientsView view_of(const Coefficients& cell) { return {cell.data(), 1}; }
template <int N>
CoefficientsView view_of(const CellValues<N>& values, int lane)
{
    return {&values.bezier[0][lane], N};
}

inline constexpr int kCertifyDepth = 6; ///< as in `certified_positive()`

/// Whether J is positive in the whole cell, decided from its Bézier coefficients. See `certified_positive()`.
bool positive_everywhere(const CoefficientsView& bezier, int max_depth);

/// Result of `signs_after_cut()` for one cell; open: undecided.
enum class Sign : std::uint8_t { open, positive, not_positive };

/// Test all cells of a batch at once. Each cell is bisected once along u, once along v and once along w; its
/// sign is known if one of these bisections decides. This decides most of the cells that the coefficients
/// alone leave undecided.
/// @return consistent with `positive_everywhere()`.
std::array<Sign, kLanes> signs_after_cut(const CellValues<kLanes>& values);

} // namespace lacuna::quality
