// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace lacuna::matching {

/// The cost of a pair by row and column; infinite: forbidden.
using PairCost = std::function<double(std::size_t, std::size_t)>;

/// Assign each row a different column with the least sum of costs. Each row first takes its cheapest column,
/// if this column is free. A shortest augmenting path is then found for each remaining row (Jonker and
/// Volgenant).
/// @param cheapest  for each row, the column of its least cost.
/// @return  column of each row; -1 if no allowed column is left.
/// @note  O(n) if the cheapest columns of all rows differ, plus O(n²) for each row whose cheapest column is
///         taken.
std::vector<int> assign(const PairCost& cost, const std::vector<std::size_t>& cheapest);

} // namespace lacuna::matching
