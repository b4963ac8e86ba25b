// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/partial_mesh.h>

#include <vector>

namespace lacuna::quads::paving {

/// Where a row must have the requested height.
enum class RowKind {
    tall,  ///< the row must be so high on most of the loop; otherwise it is dropped
    exact, ///< the row must be so high everywhere; otherwise it is dropped
};

/// Whether a loop needs a row. It does if the differences between its angles and multiples of a right angle
/// sum to more than 45°.
bool needs_row(const PartialMesh& partial, const Cycle& cycle);

/// Place a row of quads inward from each wanted loop, and replace the loop by the row's inner side.
///
/// By their angles, nodes of the loop are ends (one quad), sides (two quads, one for each adjacent edge),
/// corners (three quads) or reversals (four). Rows have the height `height`. Where another side is near, rows
/// are lowered to a third of the gap, except exact rows. A row that would fold, run into another one or leave
/// too few nodes is dropped.
///
/// @param wanted  whether each loop should get a row. The function sets it to false for loops that got no
///         row.
/// @param height  height of the row over a boundary point [length].
/// @return  number of rows placed.
int lay_rows(PartialMesh& partial, std::vector<Cycle>& loops, std::vector<bool>& wanted,
             const SizeField& height, RowKind kind);

} // namespace lacuna::quads::paving
