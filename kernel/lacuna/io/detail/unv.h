// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

#include <cstdint>
#include <span>

/// Common parts of reader and writer of universal files. Internal to this folder.
namespace lacuna::io {

inline constexpr int kUnvNode = 7, kUnvElement = 8; ///< types of group entities; others are ignored

/// Positions of a shape's nodes in the order of DeckShape; empty: the same positions. In each layer, corners
/// and middles alternate around the cell; middles of upright sides lie between the layers.
inline std::span<const std::uint8_t> unv_places(DeckShape shape)
{
    static constexpr std::uint8_t kTri6[] = {0, 3, 1, 4, 2, 5}, kQuad8[] = {0, 4, 1, 5, 2, 6, 3, 7},
                                  kTet10[] = {0, 4, 1, 5, 2, 6, 7, 8, 9, 3},
                                  kWedge15[] = {0, 6, 1, 7, 2, 8, 12, 13, 14, 3, 9, 4, 10, 5, 11},
                                  kHex20[] = {0,  8,  1, 9,  2, 10, 3, 11, 16, 17,
                                              18, 19, 4, 12, 5, 13, 6, 14, 7,  15};
    switch (shape) {
    case DeckShape::tri6:
        return kTri6;
    case DeckShape::quad8:
        return kQuad8;
    case DeckShape::tet10:
        return kTet10;
    case DeckShape::wedge15:
        return kWedge15;
    case DeckShape::hex20:
        return kHex20;
    default:
        return {};
    }
}

/// Elements whose second record is the orientation of a beam.
inline bool unv_has_orientation(std::int64_t descriptor, int dataset)
{
    return dataset != 71 && (descriptor == 11 || (descriptor >= 21 && descriptor <= 24));
}

} // namespace lacuna::io
