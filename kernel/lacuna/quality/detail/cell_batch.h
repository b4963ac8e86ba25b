// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>
#include <cstddef>
#include <cstdint>

/// The arithmetic of one cell, for several cells at once. Internal to this folder.
///
/// With the cell's edges along u, v, w as U(v,w), V(u,w), W(u,v), each bilinear, the Jacobian of the
/// trilinear map is J = det(U, V, W), of degree two in each of u, v, w. Its 27 Bézier coefficients follow
/// from 20 determinants (Johnen, Weill and Remacle 2017): at a corner the coefficient is J itself; at the
/// middle of an edge along u it is (J0 + J1 - det(U, V1 - V0, W1 - W0)) / 2; and as J holds no u²v², u²w² or
/// v²w² term, the coefficients in the middle of a side and of the cell are (2 · edges - corners) / 4 of the
/// square around them.
namespace lacuna::quality {

/// Cells worked on together: their numbers fit the first-level cache, and loops over them are vector code.
/// Measured with AVX2 when all coefficients were found of every cell: 27 ns a cell; 45 with 16 lanes, 31 with
/// 64.
inline constexpr int kLanes = 32;

/// Corners each edge joins, [d][e]: it runs in direction d (u, v, w); e counts the ends in the other two
/// directions, the lower direction fastest.
inline constexpr std::size_t kEdgeNodes[3][4][2] = {
    {{0, 1}, {3, 2}, {4, 5}, {7, 6}}, {{0, 3}, {1, 2}, {4, 7}, {5, 6}}, {{0, 4}, {1, 5}, {3, 7}, {2, 6}}};

/// Four corners of `N` cells, a coordinate of all cells side by side.
template <int N>
using LevelBatch = double[4][3][N];

/// Corners of `N` cells. The upper corners can become the lower ones of other cells where they are.
template <int N>
struct CellBatch {
    alignas(64) LevelBatch<N> level[2];
    std::size_t low = 0; ///< level of corners 0 to 3

    [[nodiscard]] double (&corner(std::size_t c))[3][N] { return level[low ^ (c / 4)][c % 4]; }
    [[nodiscard]] const double (&corner(std::size_t c) const)[3][N] { return level[low ^ (c / 4)][c % 4]; }
};

/// What is known of `N` cells.
template <int N>
struct CellValues {
    /// Scaled Jacobian; 0 where an edge has no length or a node is not a number.
    alignas(64) double scaled[N];
    /// All of J lies above it: a bound above 0, or the smallest Bézier coefficient.
    alignas(64) double smallest[N];
    alignas(64) double volume[N];
    alignas(64) double bezier[27][N]; ///< coefficient (a, b, c) at a + 3b + 9c
};

/// Evaluate a full batch with the widest vectors the machine has; the same bits on every machine.
/// Coefficients are found where one of the cells needs them: where `smallest` is not above 0 without.
void evaluate(const CellBatch<kLanes>& batch, CellValues<kLanes>& values);

/// The scaled Jacobian alone; the same bits.
void evaluate_scaled(const CellBatch<kLanes>& batch, double (&scaled)[kLanes]);

/// Evaluate one cell, all of its coefficients included; the same scaled Jacobian as in a batch to the bit.
void evaluate(const CellBatch<1>& batch, CellValues<1>& values);

/// Of one cell, (a, b, c) at a + 3b + 9c.
using Coefficients = std::array<double, 27>;

/// Those of one cell where they lie, alone or in a batch.
struct CoefficientsView {
    const double* first;
    std::size_t apart; ///< from one to the next [numbers]

    [[nodiscard]] double at(std::size_t number) const { return first[apart * number]; }
};
inline CoefficientsView view_of(const Coefficients& cell) { return {cell.data(), 1}; }
template <int N>
CoefficientsView view_of(const CellValues<N>& values, int lane)
{
    return {&values.bezier[0][lane], N};
}

/// Whether J is positive everywhere, from its Bézier coefficients. See `certified_positive()`.
bool positive_everywhere(const CoefficientsView& bezier, int max_depth);

/// Whether J is positive everywhere, as far as a single cut tells.
enum class Sign : std::uint8_t { open, positive, not_positive };

/// The same of all cells of a batch at once, for one cut along u, v or w: which of the three does not matter.
/// Most cells that their coefficients leave open are decided so. @return  as `positive_everywhere()` tells.
std::array<Sign, kLanes> signs_after_cut(const CellValues<kLanes>& values);

} // namespace lacuna::quality
