// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <cstddef>
#include <vector>

namespace lacuna::healing {

/// Turn faces so that neighbours agree, as far as each edge has two of them in its group (a solid, or all
/// faces of none), and outward where that closes a volume. Where no orientation agrees, faces stay as they
/// are.
/// @param groups  numbers of faces, each face in one group at most.
/// @note  O(n log n) in facets.
void orient_groups(topology::Model& model, const std::vector<std::vector<std::size_t>>& groups);

} // namespace lacuna::healing
