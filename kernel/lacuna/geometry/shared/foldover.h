// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

/// Parameters of the energy that unfolds meshes, from Garanzha et al. (2021): the shape of each corner, and a
/// barrier χ(J, ε) in place of its determinant J, which may be negative as long as ε is above 0.

namespace lacuna::geometry {

/// Weight of the term for area or volume, relative to the term for shape.
inline constexpr double kSizeShare = 1.0 / 128;

/// Smallest regularisation ε. With a lower value, the energy is closer to a true barrier, but the
/// minimisation is worse conditioned.
inline constexpr double kLeastEpsilon = 1e-3;

/// The regularisation ε for the smallest determinant of a mesh. It decreases as the mesh unfolds.
inline double epsilon_for(double least_determinant)
{
    const double folded = std::fmin(least_determinant, 0.0);
    return std::sqrt(kLeastEpsilon * kLeastEpsilon + 0.04 * folded * folded);
}

} // namespace lacuna::geometry
