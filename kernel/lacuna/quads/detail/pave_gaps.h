// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/pave_draft.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace lacuna::quads::paving {

/// The sides of loops in square cells, to ask how far one can go from a node.
class Gaps {
public:
    Gaps(const Draft& draft, const std::vector<Cycle>& loops);

    /// Length of the segment from a node along a unit direction until it meets a side that does not end in
    /// one of the three nodes; `reach` where it meets none.
    [[nodiscard]] double ahead(Index before, Index node, Index after, const Vec2& direction,
                               double reach) const;

    /// Across all sides: no reach need be longer.
    [[nodiscard]] double diagonal() const { return diagonal_; }

private:
    [[nodiscard]] std::int64_t key(std::int64_t x, std::int64_t y) const { return x * 0x9E3779B1LL + y; }

    const Draft& draft_;
    double cell_ = 1, diagonal_ = 0;
    Vec2 low_ = Vec2::Zero();
    std::unordered_map<std::int64_t, std::vector<Segment>> sides_;
};

} // namespace lacuna::quads::paving
