// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <cstddef>
#include <vector>

namespace lacuna::healing {

/// Orient faces consistently across every edge that has exactly two faces of one group, and outward if the
/// group closes a volume. A group is a solid, or all faces if there are no solids. Faces that cannot be
/// oriented consistently are unchanged.
/// @param groups  face numbers; a face is in one group at most.
/// @note  O(n log n) in facets.
void orient_groups(topology::ModelBuilder& model, const std::vector<std::vector<std::size_t>>& groups);

} // namespace lacuna::healing
