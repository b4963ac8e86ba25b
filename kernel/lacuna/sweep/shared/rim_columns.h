// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::sweep {

/// The walls' node columns over the source rim.
struct RimColumns {
    int layers = 0;
    std::vector<Index> rim;   ///< source node of each column; every node of the source's boundary, once
    std::vector<Vec3> points; ///< (layers + 1) × rim.size(), layer-major; row 0 is the source rim itself

    /// Points of one layer's rim, in the order of `rim`.
    [[nodiscard]] std::span<const Vec3> row(int layer) const
    {
        return {points.data() + static_cast<std::size_t>(layer) * rim.size(), rim.size()};
    }
};

} // namespace lacuna::sweep
