// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <cstddef>
#include <vector>

namespace lacuna::healing {

/// Orient the faces of each group (a solid, or all faces if there are no solids). Connected faces are
/// oriented consistently across edges that have exactly two faces of the group. If they enclose a volume,
/// they are oriented outward. Connected faces that cannot be oriented consistently are unchanged.
/// @param groups  indices of the faces of each group; a face is in one group at most.
/// @note  O(n log n) in facets.
void orient_groups(topology::ModelBuilder& model, const std::vector<std::vector<std::size_t>>& groups);

} // namespace lacuna::healing
