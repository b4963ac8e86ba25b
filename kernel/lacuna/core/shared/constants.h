// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <numbers>

namespace lacuna {

/// The cost of an impossible choice, and the initial value in a search for a minimum.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Radians per degree.
inline constexpr double kDegree = std::numbers::pi / 180;

/// Angles in radians.
inline constexpr double kRightAngle = std::numbers::pi / 2, kFullTurn = 2 * std::numbers::pi;

/// Stands for "no index".
inline constexpr std::size_t kNoIndex = static_cast<std::size_t>(-1);

/// Steps of a loop between two checks for cancellation, if a step takes less than a microsecond.
inline constexpr std::size_t kBetweenPolls = 4096;

} // namespace lacuna
