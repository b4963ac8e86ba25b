// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>
#include <span>

namespace lacuna::geometry {

/// Step lengths of `pattern_search()`.
struct PatternSteps {
    double scale;       ///< unit of the step lengths, such as the length of a side at the point
    double first, last; ///< longest and shortest step [of `scale`]
    double least_gain;  ///< required increase of the value for a step of length `scale`, >= 0
};

/// Eight directions, every 45°.
inline std::span<const Vec2> all_around()
{
    constexpr double kDiagonal = 0.70710678118654752; // √½
    static const std::array<Vec2, 8> kDirections{
        Vec2(1, 0),  Vec2(kDiagonal, kDiagonal),   Vec2(0, 1),  Vec2(-kDiagonal, kDiagonal),
        Vec2(-1, 0), Vec2(-kDiagonal, -kDiagonal), Vec2(0, -1), Vec2(kDiagonal, -kDiagonal)};
    return kDirections;
}

/// Move a point to increase a value by pattern search: try steps in some directions, and halve the step if
/// none succeeds.
/// @param best   the value at `x`.
/// @param value  called as value(const Vec2&, double floor). A value that does not exceed the floor may be
///               replaced by any other number that does not exceed it, so its computation may stop early.
/// @param directions  unit vectors of the steps. Leave out directions along which the value is constant:
///                    there it would increase by rounding errors only.
/// @return the value at the new `x`, at least `best`.
template <class Value>
double pattern_search(Vec2& x, double best, const PatternSteps& steps, const Value& value,
                      std::span<const Vec2> directions = all_around())
{
    // Limits the number of steps of each length, because values may increase by rounding alone. A search
    // needs far fewer steps.
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
