// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

namespace lacuna::surface {

enum class Pairing {
    in_order, ///< equal numbers on both sides are paired whatever their positions
    near,     ///< only close ones are paired: the walls determine the others
};

/// Corresponding breaks of two segments.
using BreakPairs = std::vector<std::pair<double, double>>;

/// Pair breaks of two segments in order, minimizing the difference of relative lengths without crossings; the
/// others stay unpaired, with -1 on the other side.
/// @param a, b  shares of either segment, increasing, in (0, 1).
/// @note  Dynamic programming; time and memory a.size() × b.size().
BreakPairs paired_breaks(const std::vector<double>& a, const std::vector<double>& b,
                         Pairing pairing = Pairing::in_order);
/// The same, pairing only breaks that are closer than `apart`.
BreakPairs paired_breaks(const std::vector<double>& a, const std::vector<double>& b, double apart);

/// Add the other side of unpaired breaks by linear interpolation between the neighbouring pairs; in order.
void complete(BreakPairs& breaks);

} // namespace lacuna::surface
