// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/partial_mesh.h>

#include <vector>

namespace lacuna::quads::paving {

/// Where a row must have the requested height.
enum class RowKind {
    tall,  ///< on most of the loop; otherwise the row is dropped
    exact, ///< everywhere; otherwise the row is dropped
};

/// Whether a loop needs a row: whether the differences between its angles and the nearest multiples of a
/// right angle sum to more than 45°.
bool needs_row(const PartialMesh& partial, const Cycle& cycle);

/// Place a row of quads inward from each wanted loop, and replace the loop by the row's inner side.
///
/// By its angle, a node of the loop is an end (one quad), a side (two quads, one for each adjacent edge), a
/// corner (three quads) or a reversal (four). Where another side is near, a row that is not exact is lowered
/// to a third of the gap. A row is dropped if it would fold, meet another row or leave too few nodes.
///
/// @param wanted  whether each loop should get a row. The function sets it to false for loops that got no
///         row.
/// @param height  height of the row over a boundary point [length].
/// @return  number of rows placed.
int lay_rows(PartialMesh& partial, std::vector<Cycle>& loops, std::vector<bool>& wanted,
             const SizeField& height, RowKind kind);

} // namespace lacuna::quads::paving
