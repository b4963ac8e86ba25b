// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/belt.h>

#include <optional>
#include <span>
#include <vector>

namespace lacuna::surface {

/// Where on their target chains the source chains of belts without side lines start when all loops turn as one body
/// [running length]. Empty for a belt with side lines.
///
/// The turn is the rigid motion that fits the loops' centres, and the points that side lines pair, best. None is given
/// when nothing tells it: one loop, loops about one centre, or no belt without side lines.
std::vector<std::optional<double>> common_turn_starts(std::span<const Belt> belts);

} // namespace lacuna::surface
