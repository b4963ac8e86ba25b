// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace lacuna::view {

using Colour = std::array<std::uint8_t, 3>; ///< sRGB red, green, blue

/// Colours from poor to good; distinguishable with red-green colour blindness (Brewer's RdYlBu).
inline constexpr Colour kQualityRamp[] = {{0xd7, 0x30, 0x27}, {0xfc, 0x8d, 0x59}, {0xfe, 0xe0, 0x90},
                                          {0xe0, 0xf3, 0xf8}, {0x91, 0xbf, 0xdb}, {0x45, 0x75, 0xb4}};
/// Colours from first to last, of evenly increasing lightness (viridis).
inline constexpr Colour kOrderRamp[] = {{0x44, 0x01, 0x54}, {0x41, 0x44, 0x87}, {0x2a, 0x78, 0x8e},
                                        {0x22, 0xa8, 0x84}, {0x7a, 0xd1, 0x51}, {0xfd, 0xe7, 0x25}};
/// Colours of categories, in order of use: ten, then the same lighter, then darker.
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
