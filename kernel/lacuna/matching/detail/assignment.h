// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

namespace lacuna::matching {

/// Assign each row a column of its own with the least sum of costs (Hungarian method with potentials).
/// Infinite entries are forbidden pairs. @return column of each row; -1 if no allowed column is left.
/// @pre cost is square. O(n³).
std::vector<int> assign(const Eigen::MatrixXd& cost);

} // namespace lacuna::matching
