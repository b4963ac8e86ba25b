// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstdint>

namespace lacuna {

/// One number for the way from point `a` to point `b`, to key hash maps with.
constexpr std::uint64_t directed_key(Index a, Index b)
{
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32) | static_cast<std::uint32_t>(b);
}

/// One number for the edge between two points, the same both ways round.
constexpr std::uint64_t edge_key(Index a, Index b) { return a < b ? directed_key(a, b) : directed_key(b, a); }

} // namespace lacuna
