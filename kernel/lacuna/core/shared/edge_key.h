// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstdint>

namespace lacuna {

/// Hash key of the directed edge from point `a` to point `b`.
constexpr std::uint64_t directed_key(Index a, Index b)
{
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32) | static_cast<std::uint32_t>(b);
}

/// Hash key of the undirected edge between two points: the same for (a, b) and (b, a).
constexpr std::uint64_t edge_key(Index a, Index b) { return a < b ? directed_key(a, b) : directed_key(b, a); }

} // namespace lacuna
