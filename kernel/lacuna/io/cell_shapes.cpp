// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/cell_shapes.h>

#include <algorithm>

namespace lacuna::io {
namespace {

using enum DeckShape;
/// A node order that differs from that of DeckShape. It is given for the shape with the most middle nodes;
/// shapes with fewer middle nodes use its first entries.
struct OwnOrder {
    NodeOrder order;
    DeckShape shape;
    std::array<std::uint8_t, 27> places;
};
constexpr OwnOrder kOwnOrders[] = {
    {NodeOrder::exodus, wedge15, {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11}},
    {NodeOrder::exodus, hex27, {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 16, 17,
                                18, 19, 12, 13, 14, 15, 23, 24, 25, 26, 21, 22, 20}},
    {NodeOrder::gmsh, tet10, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
    {NodeOrder::gmsh, pyramid14, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12, 13}},
    {NodeOrder::gmsh, wedge18, {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11, 15, 17, 16}},
    {NodeOrder::gmsh, hex27, {0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 13, 9,  16, 18,
                              19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26}},
    {NodeOrder::unv, tri6, {0, 3, 1, 4, 2, 5}},
    {NodeOrder::unv, quad8, {0, 4, 1, 5, 2, 6, 3, 7}},
    {NodeOrder::unv, tet10, {0, 4, 1, 5, 2, 6, 7, 8, 9, 3}},
    {NodeOrder::unv, wedge15, {0, 6, 1, 7, 2, 8, 12, 13, 14, 3, 9, 4, 10, 5, 11}},
    {NodeOrder::unv, hex20, {0, 8, 1, 9, 2, 10, 3, 11, 16, 17, 18, 19, 4, 12, 5, 13, 6, 14, 7, 15}},
    {NodeOrder::med, tet10, {0, 2, 1, 3, 6, 5, 4, 7, 9, 8}},
    {NodeOrder::med, pyramid13, {0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10}},
    {NodeOrder::med, wedge15, {0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13}},
    {NodeOrder::med, hex27, {0,  3,  2,  1,  4,  7,  6,  5,  11, 10, 9,  8,  15, 14,
                             13, 12, 16, 19, 18, 17, 21, 23, 24, 22, 20, 25, 26}},
};
constexpr std::array<std::uint8_t, 27> kSame{0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13,
                                             14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};

} // namespace

std::span<const std::uint8_t> node_places(NodeOrder order, DeckShape shape)
{
    const auto [dimension, corners, nodes] = shape_info(shape);
    if (nodes == corners && order != NodeOrder::med)
        return std::span(kSame).first(static_cast<std::size_t>(nodes));
    const auto own = std::ranges::find_if(kOwnOrders, [&](const OwnOrder& of) {
        const auto [own_dimension, own_corners, most] = shape_info(of.shape);
        return of.order == order && own_dimension == dimension && own_corners == corners && nodes <= most;
    });
    const bool differs = own != std::end(kOwnOrders);
    return std::span(differs ? own->places : kSame).first(static_cast<std::size_t>(nodes));
}

} // namespace lacuna::io
