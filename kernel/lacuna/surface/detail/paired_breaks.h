// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

namespace lacuna::surface {

enum class Pairing {
    in_order, ///< as many on both sides go together whatever their place
    near,     ///< only what lies near each other: the walls say what goes where
};

/// Pair breaks of two segments in order: the pairs that lie nearest to each other in relative length, none
/// crossing; the rest stay alone, -1 on the other side.
/// @param a, b  shares of either segment, rising, in (0, 1).
/// @note  Dynamic programming; time and memory a.size() × b.size().
std::vector<std::pair<double, double>> paired_breaks(const std::vector<double>& a,
                                                     const std::vector<double>& b,
                                                     Pairing pairing = Pairing::in_order);
/// The same for breaks that go together only where they are less than `apart` from each other.
std::vector<std::pair<double, double>> paired_breaks(const std::vector<double>& a,
                                                     const std::vector<double>& b, double apart);

/// Fill in the other side of breaks that stand alone, at the same share of the way between the pairs around
/// them; in order.
void complete(std::vector<std::pair<double, double>>& breaks);

} // namespace lacuna::surface
