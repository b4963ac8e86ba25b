// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/counted_loop.h>

#include <optional>
#include <vector>

namespace lacuna::quads {

/// Numbers of sides for a grid around the longest hole. The number of columns around the ring minimises the
/// sum of the costs of the outer loop and the hole.
/// @return empty if there is no hole or no such grid.
std::optional<std::vector<int>> ring_counts(const CountTask& task);

} // namespace lacuna::quads
