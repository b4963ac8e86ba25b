// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/pave_draft.h>

#include <vector>

namespace lacuna::quads::paving {

/// How rows are laid.
enum class RowKind {
    tall,  ///< as high as asked on most of the loop, or not at all
    thin,  ///< also where the next loop is near
    exact, ///< as high as asked everywhere, or not at all
    buffer ///< no node is an end, and the row gets flatter until it fits
};

/// What a row costs a loop in turns: it needs one where its nodes turn without being corners.
bool needs_row(const Draft& draft, const Cycle& cycle);

/// Lay a row of quads inward from each loop that is asked for and replace it by the row's inner side.
///
/// Loop nodes are ends (one quad), sides (two, of neighbouring edges), corners (three) or reversals (four) by
/// their angle. Rows are as high as `height` says, or (but exact ones) a third of the gap where another side is near. A row
/// that would fold, run into another or leave too few nodes is not laid.
///
/// @param kind  how.
/// @param wanted  loops a row is wanted on; false afterwards for those that got none.
/// @return how many were laid.
int lay_rows(Draft& draft, std::vector<Cycle>& loops, std::vector<bool>& wanted,
             const std::function<double(const Vec2&)>& height, RowKind kind = RowKind::tall);

} // namespace lacuna::quads::paving
