// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/limits.h>
#include <lacuna/core/types.h>

#include <array>
#include <numbers>
#include <span>

namespace lacuna::geometry {

/// Usual longest and shortest step of `pattern_search()`, as shares of `PatternSteps::scale`. Shorter steps
/// gain little.
inline constexpr double kLongestStep = 1.0 / 4, kShortestStep = 1.0 / 256;

struct PatternSteps {
    double scale;          ///< unit of the step lengths, such as the length of a side at the point
    double least_gain = 0; ///< required increase of the value for a step of length `scale`, >= 0
    double longest = kLongestStep, shortest = kShortestStep; ///< [of `scale`]
};

/// Eight directions, every 45°.
inline std::span<const Vec2> all_around()
{
    static const std::array<Vec2, 8> directions = [] {
        const double half = std::numbers::sqrt2 / 2;
        return std::array<Vec2, 8>{Vec2(1, 0),  Vec2(half, half),   Vec2(0, 1),  Vec2(-half, half),
                                   Vec2(-1, 0), Vec2(-half, -half), Vec2(0, -1), Vec2(half, -half)};
    }();
    return directions;
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
    // Halving the share ends for a scale of 0 too, as where two points coincide.
    for (double share = steps.longest; share >= steps.shortest; share /= 2) {
        const double step = share * steps.scale;
        bool better = true;
        // The limit is needed because values may increase by rounding alone.
        for (int round = 0; better && round < kMostRounds; ++round) {
            better = false;
            const Vec2 from = x;
            for (const Vec2& direction : directions) {
                const Vec2 to = from + step * direction;
                const double floor = best + steps.least_gain * share;
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
