// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/volume_share.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lacuna::sweep {

double volume_lost(const Fidelity& fidelity) { return 1 - fidelity.volume / fidelity.sealed_volume; }

bool loses_volume(const Fidelity& fidelity, const SweepOptions& options)
{
    return options.volume_share > 0 && options.curvature > 0 && volume_lost(fidelity) > options.volume_share;
}

int sides_for_volume(double share, int before)
{
    constexpr double kOfShare = 0.6;
    const double wanted = std::sqrt(2 * std::numbers::pi * std::numbers::pi / (3 * kOfShare * share));
    return std::max(before + before / 4 + 1, static_cast<int>(std::ceil(wanted)));
}

std::optional<int> sides_for_lost_volume(const Fidelity& fidelity, const SweepOptions& options)
{
    if (!loses_volume(fidelity, options)) return std::nullopt;
    const int sides = sides_for_volume(options.volume_share, options.curvature);
    return sides > kMostPerTurn ? std::nullopt : std::optional(sides);
}

bool is_closer(double after, double before)
{
    constexpr double kLessLost = 0.75; // a choice, not a measurement
    return after <= kLessLost * before;
}

} // namespace lacuna::sweep
