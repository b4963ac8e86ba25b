// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/counted_loop.h>

#include <optional>
#include <vector>

namespace lacuna::quads {

/// Numbers of sides for a grid round the longest hole: the number along it for which the costs of the two
/// loops it runs between, each over what that loop wants, are least in sum.
/// @return nothing where there is no hole, or no such grid.
std::optional<std::vector<int>> ring_counts(const CountTask& task);

} // namespace lacuna::quads
