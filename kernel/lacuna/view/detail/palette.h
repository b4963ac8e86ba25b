// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace lacuna::view {

using Colour = std::array<std::uint8_t, 3>; ///< sRGB red, green, blue

/// Colours from poor to good; distinguishable with red-green colour blindness (Brewer's RdYlBu).
std::span<const Colour> quality_ramp();
/// Colours from first to last, of evenly increasing lightness (viridis).
std::span<const Colour> order_ramp();
/// Colours of categories, in order of use.
std::span<const Colour> kind_colours();

inline constexpr Colour kGiven{0x9f, 0xb3, 0xc8};  ///< given faces
inline constexpr Colour kVoid{0xf2, 0xa5, 0x4a};   ///< void faces, made by closing
inline constexpr Colour kInside{0xd9, 0xd4, 0xc5}; ///< cell sides exposed by a cut
inline constexpr Colour kSource{0x4c, 0x9f, 0x70};
inline constexpr Colour kTarget{0xc8, 0x5a, 0x6e};
inline constexpr Colour kWall{0x6c, 0x8e, 0xc4};

/// Interpolated colour. @param at  0: the first, 1: the last; clamped.
Colour on_ramp(std::span<const Colour> ramp, double at);

/// Interpolated colour. @param share  0: `a`, 1: `b`
Colour mixed(const Colour& a, const Colour& b, double share);

} // namespace lacuna::view
