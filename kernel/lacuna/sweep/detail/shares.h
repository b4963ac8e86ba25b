// SPDX-License-Identifier: MIT
#pragma once

/// Fraction of a sweep that is done when a stage begins, for progress. A compromise: the quads of the source
/// took 5 to 80 % of the time of sweeps of 0.1 to 13 million cells, and improving, where needed, up to 90 %.
namespace lacuna::sweep::share {

inline constexpr double links = 0.02, source = 0.05, walls = 0.35, target = 0.4, layers = 0.42, proof = 0.55,
                        improving = 0.6, order_2 = 0.85, skin = 0.9;

} // namespace lacuna::sweep::share
