// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <compare>
#include <cstddef>
#include <functional>

namespace lacuna {

/// A typed index. Ids of different kinds cannot be assigned to each other, and do not convert to `int`.
template <class Kind>
class Id {
public:
    constexpr Id() = default;
    constexpr explicit Id(Index value) : value_(value) {}
    constexpr explicit Id(std::size_t value) : value_(static_cast<Index>(value)) {}

    [[nodiscard]] constexpr bool valid() const { return value_ >= 0; }
    /// Position in the array that this id indexes. @pre valid()
    [[nodiscard]] constexpr std::size_t index() const { return static_cast<std::size_t>(value_); }

    friend constexpr auto operator<=>(const Id&, const Id&) = default;

private:
    Index value_ = -1;
};

using VertexId = Id<struct VertexKind>;
using EdgeId = Id<struct EdgeKind>;
using FaceId = Id<struct FaceKind>;

} // namespace lacuna

template <class Kind>
struct std::hash<lacuna::Id<Kind>> {
    std::size_t operator()(const lacuna::Id<Kind>& id) const noexcept
    {
        return id.valid() ? id.index() + 1 : 0;
    }
};
