// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

#include <array>
#include <cstdint>

/// What reader and writer of universal files share. Internal to this folder.
namespace lacuna::io {

inline constexpr int kUnvNode = 7, kUnvElement = 8; ///< what an entity of a group is; others do not count

/// A solid by its descriptor, with where its nodes stand in the order of DeckShape: layers go round corners
/// and middles in turn, with the middles of upright sides between them.
struct UnvSolid {
    std::int64_t descriptor;
    DeckShape shape;
    std::array<std::uint8_t, 20> place;
};
inline constexpr UnvSolid kUnvSolids[] = {
    {111, DeckShape::tet4, {0, 1, 2, 3}},
    {112, DeckShape::wedge6, {0, 1, 2, 3, 4, 5}},
    {113, DeckShape::wedge15, {0, 6, 1, 7, 2, 8, 12, 13, 14, 3, 9, 4, 10, 5, 11}},
    {115, DeckShape::hex8, {0, 1, 2, 3, 4, 5, 6, 7}},
    {116, DeckShape::hex20, {0, 8, 1, 9, 2, 10, 3, 11, 16, 17, 18, 19, 4, 12, 5, 13, 6, 14, 7, 15}},
    {118, DeckShape::tet10, {0, 4, 1, 5, 2, 6, 7, 8, 9, 3}},
};

/// Elements whose second record is a beam's orientation.
inline bool unv_has_orientation(std::int64_t descriptor, int dataset)
{
    return dataset != 71 && (descriptor == 11 || (descriptor >= 21 && descriptor <= 24));
}

/// Nodes of a face follow each other along the rim: corners have the middles between them.
inline std::size_t unv_face_place(std::size_t corners, std::size_t order, std::size_t k)
{
    return k % order == 0 ? k / order : corners + k / order * (order - 1) + k % order - 1;
}

} // namespace lacuna::io
