// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

namespace lacuna::matching {

/// Give each row a column of its own so that the sum of costs is least (Hungarian method with potentials).
/// Infinite entries are pairs that may not be. @return column of each row; -1 where no finite choice is left.
/// @pre cost is square. O(n³).
std::vector<int> assign(const Eigen::MatrixXd& cost);

} // namespace lacuna::matching
