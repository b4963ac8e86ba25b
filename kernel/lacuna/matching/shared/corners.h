// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <cstddef>
#include <vector>

namespace lacuna::matching {

/// Whether a closed loop has a corner at the start of its i-th use: it turns there by more than 15°, and by
/// more than 1.5 times the turn between the facets next to it. Any other vertex is smooth.
bool is_corner(const topology::Model& model, const std::vector<topology::EdgeUse>& walk, std::size_t i);

} // namespace lacuna::matching
