// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace lacuna::matching {

/// The cost of a pair by row and column; infinite: forbidden.
using PairCost = std::function<double(std::size_t, std::size_t)>;

/// Assign each row a column of its own with the least sum of costs: a row takes its cheapest column if that
/// is free, otherwise a shortest augmenting path is found for it (Jonker and Volgenant).
/// @param cheapest  for each row, the column of its least cost.
/// @return  column of each row; -1 if no allowed column is left.
/// @note  O(n) where the cheapest columns differ, else O(n²) for each row whose column is taken.
std::vector<int> assign(const PairCost& cost, const std::vector<std::size_t>& cheapest);

} // namespace lacuna::matching
