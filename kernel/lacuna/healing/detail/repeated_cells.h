// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <span>
#include <vector>

namespace lacuna::healing {

/// Flags each cell that has the same corners as an earlier cell of its label, in any order.
/// @param labels one per cell, or empty.
std::vector<bool> repeated_cells(std::span<const Triangle> cells, std::span<const int> labels);
std::vector<bool> repeated_cells(std::span<const Quad> cells, std::span<const int> labels);

} // namespace lacuna::healing
