// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

namespace lacuna::surface {

enum class Pairing {
    /// Breaks are paired in order; if both sides have equally many, all are paired, whatever their positions.
    in_order,
    near, ///< only breaks close to each other are paired; the caller places the others' partners
};

/// Corresponding breaks of two segments.
using BreakPairs = std::vector<std::pair<double, double>>;

/// Pair breaks of two segments in order, so that their relative positions differ as little as possible. Pairs
/// do not cross. A break without a partner is paired with -1.
/// @param a, b  breaks of the two segments, as shares of the segment's length, increasing, in (0, 1).
/// @note  Dynamic programming; time and memory a.size() × b.size().
BreakPairs paired_breaks(const std::vector<double>& a, const std::vector<double>& b,
                         Pairing pairing = Pairing::in_order);
/// As above, but only breaks closer than `apart` are paired.
BreakPairs paired_breaks(const std::vector<double>& a, const std::vector<double>& b, double apart);

/// Replace each -1 by linear interpolation between the neighbouring pairs, and sort.
void complete(BreakPairs& breaks);

} // namespace lacuna::surface
