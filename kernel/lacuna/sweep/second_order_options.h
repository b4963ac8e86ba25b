// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace lacuna::sweep {

/// Middle nodes that a deck gives between two places of it, pair by pair; not a number where it gives none.
using GivenMiddles = std::function<std::vector<Vec3>(std::span<const Vec3> from, std::span<const Vec3> to)>;

/// The same of quads, by the places of their corners.
using GivenCentres = std::function<std::vector<Vec3>(std::span<const std::array<Vec3, 4>> corners)>;

struct SecondOrderOptions {
    bool serendipity = false;     ///< hex20 instead of hex27
    GivenMiddles given;           ///< null: none
    GivenCentres given_centres{}; ///< of hex27; null: none
    bool given_all_over = false;  ///< both are asked for the whole skin, not only where faces came as meshes
};

} // namespace lacuna::sweep
