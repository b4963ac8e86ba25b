// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/partial_mesh.h>

#include <vector>

namespace lacuna::quads::paving {

/// How strictly a row's height is kept.
enum class RowKind {
    tall,  ///< as high as asked on most of the loop, or not at all
    thin,  ///< also where the next loop is near
    exact, ///< as high as asked everywhere, or not at all
    buffer ///< at least two quads at every node, and flatter until the row fits
};

/// Whether a loop needs a row: where its nodes turn without being corners, by more than half a right angle in
/// sum.
bool needs_row(const PartialMesh& partial, const Cycle& cycle);

/// Lay a row of quads inward from each wanted loop, and replace the loop by the row's inner side.
///
/// By their angle, loop nodes are ends (one quad), sides (two, of neighbouring edges), corners (three) or
/// reversals (four). Rows are as high as `height` says; where another side is near, all but exact rows are a
/// third of the gap. A row that would fold, run into another or leave too few nodes is not laid.
///
/// @param wanted  the loops that shall get a row; false afterwards for those that got none.
/// @param height  of the row over a boundary point [length].
/// @return how many rows were laid.
int lay_rows(PartialMesh& partial, std::vector<Cycle>& loops, std::vector<bool>& wanted,
             const SizeField& height, RowKind kind);

} // namespace lacuna::quads::paving
