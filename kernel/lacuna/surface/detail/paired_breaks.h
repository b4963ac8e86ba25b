// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

namespace lacuna::surface {

enum class Pairing {
    in_order, ///< if both sides have equally many breaks, all are paired, whatever their positions
    near,     ///< only breaks close to each other are paired; the walls determine the others
};

/// Corresponding breaks of two segments.
using BreakPairs = std::vector<std::pair<double, double>>;

/// Pair breaks of two segments in order, minimizing the difference of their relative positions without
/// crossings. A break that stays unpaired has -1 for the other side.
/// @param a, b  breaks as shares of either segment, increasing, in (0, 1).
/// @note  Dynamic programming; time and memory a.size() × b.size().
BreakPairs paired_breaks(const std::vector<double>& a, const std::vector<double>& b,
                         Pairing pairing = Pairing::in_order);
/// As above, but only breaks closer than `apart` are paired.
BreakPairs paired_breaks(const std::vector<double>& a, const std::vector<double>& b, double apart);

/// Replace each -1 by linear interpolation between the neighbouring pairs, and sort.
void complete(BreakPairs& breaks);

} // namespace lacuna::surface
