// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <span>
#include <vector>

namespace lacuna::healing {

/// Which cells have the corners of an earlier one of the same label, in any order.
/// @param labels one a cell, or none at all.
std::vector<bool> repeated_cells(std::span<const Triangle> cells, std::span<const int> labels);
std::vector<bool> repeated_cells(std::span<const Quad> cells, std::span<const int> labels);

} // namespace lacuna::healing
