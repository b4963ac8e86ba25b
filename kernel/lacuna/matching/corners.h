// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <cstddef>
#include <vector>

namespace lacuna::matching {

/// True where a closed walk turns at the start of its use number `i`: by more than 15°, and by more than
/// half as much again as its facets turn next to it. Other vertices only say where a smooth run was cut.
bool is_corner(const topology::Model& model, const std::vector<topology::EdgeUse>& walk, std::size_t i);

} // namespace lacuna::matching
