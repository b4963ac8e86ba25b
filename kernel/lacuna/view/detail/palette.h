// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace lacuna::view {

using Colour = std::array<std::uint8_t, 3>; ///< red, green, blue, as screens have them

/// Poor to good: told apart by those who do not tell red from green, too (Brewer's RdYlBu).
std::span<const Colour> quality_ramp();
/// First to last, even in lightness (viridis).
std::span<const Colour> order_ramp();
/// Kinds of things, in order of use.
std::span<const Colour> kind_colours();

inline constexpr Colour kGiven{0x9f, 0xb3, 0xc8};  ///< what came with the input
inline constexpr Colour kVoid{0xf2, 0xa5, 0x4a};   ///< what closing made
inline constexpr Colour kInside{0xd9, 0xd4, 0xc5}; ///< sides of cells that a cut lays open
inline constexpr Colour kSource{0x4c, 0x9f, 0x70};
inline constexpr Colour kTarget{0xc8, 0x5a, 0x6e};
inline constexpr Colour kWall{0x6c, 0x8e, 0xc4};

/// A colour between the stops. @param at  0 the first, 1 the last; beyond them as these.
Colour on_ramp(std::span<const Colour> ramp, double at);

} // namespace lacuna::view
