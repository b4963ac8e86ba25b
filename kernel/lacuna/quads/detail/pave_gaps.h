// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/partial_mesh.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace lacuna::quads::paving {

/// Finds the distance from a node to the next side of a loop in a given direction. The sides are stored in a
/// grid of square cells.
class GapFinder {
public:
    GapFinder(const PartialMesh& partial, const std::vector<Cycle>& loops);

    /// Distance from `node` along a unit direction to the first side that does not end at `before`, `node` or
    /// `after` [length]. `reach` if there is no such side within this distance.
    [[nodiscard]] double ahead(Index before, Index node, Index after, const Vec2& direction,
                               double reach) const;

    /// Diagonal of the box around all sides. A longer reach finds nothing more [length].
    [[nodiscard]] double diagonal() const { return diagonal_; }

private:
    [[nodiscard]] std::int64_t key(std::int64_t x, std::int64_t y) const { return x * 0x9E3779B1LL + y; }

    const PartialMesh& partial_;
    double cell_ = 1, diagonal_ = 0;
    Vec2 low_ = Vec2::Zero();
    std::unordered_map<std::int64_t, std::vector<Segment>> sides_;
};

} // namespace lacuna::quads::paving
