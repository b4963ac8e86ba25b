// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::sweep {

/// The columns of wall nodes over the source's rim.
struct RimColumns {
    int layers = 0;
    /// For each column, its source node; every boundary node of the source occurs once.
    std::vector<Index> rim;
    std::vector<Vec3> points; ///< (layers + 1) × rim.size(), layer-major; row 0 is the source rim itself

    /// Points of one layer's rim, in the order of `rim`.
    [[nodiscard]] std::span<const Vec3> row(int layer) const
    {
        return {points.data() + static_cast<std::size_t>(layer) * rim.size(), rim.size()};
    }
};

} // namespace lacuna::sweep
