// SPDX-License-Identifier: MIT
#pragma once

/// Fraction of a sweep that is done when a stage begins, for progress. Rounded from the times of sweeps of
/// 0.1 to 13 million cells; which stage takes longest differs from sweep to sweep.
namespace lacuna::sweep::share {

inline constexpr double links = 0.02, source = 0.05, walls = 0.2, target = 0.25, layers = 0.3, proof = 0.55,
                        improving = 0.6, order_2 = 0.85, skin = 0.9;

} // namespace lacuna::sweep::share
