// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <cstddef>
#include <vector>

namespace lacuna::matching {

/// True where a closed loop has a corner at the start of its use number `i`: it turns by more than 15° there,
/// and by more than 1.5 times as much as between its facets next to it. Other vertices lie on a smooth run.
bool is_corner(const topology::Model& model, const std::vector<topology::EdgeUse>& walk, std::size_t i);

} // namespace lacuna::matching
