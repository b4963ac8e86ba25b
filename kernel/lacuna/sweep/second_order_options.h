// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace lacuna::sweep {

/// Given middle nodes between pairs of positions of a deck; NaN where it has none.
using GivenMiddles = std::function<std::vector<Vec3>(std::span<const Vec3> from, std::span<const Vec3> to)>;

/// The same for quads, by the positions of their corners.
using GivenCentres = std::function<std::vector<Vec3>(std::span<const std::array<Vec3, 4>> corners)>;

struct SecondOrderOptions {
    bool serendipity = false;     ///< hex20 instead of hex27
    GivenMiddles given;           ///< null: none
    GivenCentres given_centres{}; ///< given centres for hex27; null: none
    bool given_all_over = false;  ///< whether both apply to the whole skin, not only to faces with a given
                                  ///< mesh
};

} // namespace lacuna::sweep
