// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>
#include <span>

namespace lacuna::geometry {

/// Steps of `pattern_search()`.
struct PatternSteps {
    double scale;       ///< a length of the neighbourhood
    double first, last; ///< the longest step, and a bound below all [of `scale`]
    double least_gain;  ///< in the value, for a step as long as `scale`, >= 0
};

/// Eight directions, all around.
inline std::span<const Vec2> all_around()
{
    constexpr double kDiagonal = 0.70710678118654752; // √½
    static const std::array<Vec2, 8> kDirections{
        Vec2(1, 0),  Vec2(kDiagonal, kDiagonal),   Vec2(0, 1),  Vec2(-kDiagonal, kDiagonal),
        Vec2(-1, 0), Vec2(-kDiagonal, -kDiagonal), Vec2(0, -1), Vec2(kDiagonal, -kDiagonal)};
    return kDirections;
}

/// Move a point to where a value is larger, by pattern search: in some directions, the step halved where none
/// wins.
/// @param best   the value at `x`.
/// @param value  of a place, called as value(const Vec2&, double floor): where it is no more than the floor
///               it may be any number up to that.
/// @param directions  of length 1, those that differ in the value: along others it goes up by rounding.
/// @return the value at the new `x`, at least `best`.
template <class Value>
double pattern_search(Vec2& x, double best, const PatternSteps& steps, const Value& value,
                      std::span<const Vec2> directions = all_around())
{
    // Of each length: values may go up by rounding alone for ever. A choice, far above what is needed.
    constexpr int kRounds = 10000;
    for (double step = steps.first * steps.scale; step > steps.last * steps.scale; step /= 2) {
        bool better = true;
        for (int round = 0; better && round < kRounds; ++round) {
            better = false;
            const Vec2 from = x;
            for (const Vec2& direction : directions) {
                const Vec2 to = from + step * direction;
                const double floor = best + steps.least_gain * step / steps.scale;
                const double found = value(to, floor);
                if (found <= floor) continue;
                best = found;
                x = to;
                better = true;
            }
        }
    }
    return best;
}

} // namespace lacuna::geometry
