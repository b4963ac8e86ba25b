// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace lacuna::sweep {

/// Returns the given middle node between each pair of positions; NaN where none is given.
using GivenMiddles = std::function<std::vector<Vec3>(std::span<const Vec3> from, std::span<const Vec3> to)>;

/// Returns the given centre of each quad, identified by the positions of its corners; NaN where none is
/// given.
using GivenCentres = std::function<std::vector<Vec3>(std::span<const std::array<Vec3, 4>> corners)>;

struct SecondOrderOptions {
    bool serendipity = false;     ///< hex20 instead of hex27
    GivenMiddles given;           ///< null: none
    GivenCentres given_centres{}; ///< given centres for hex27; null: none
    /// Whether `given` and `given_centres` apply to the whole skin, or only to faces with a given mesh.
    bool given_all_over = false;
};

} // namespace lacuna::sweep
