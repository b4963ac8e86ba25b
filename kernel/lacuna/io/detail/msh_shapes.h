// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

#include <span>
#include <string>

/// Shapes as Gmsh has them. Internal to this folder.
namespace lacuna::io {

/// What a physical group without a name is called.
std::string unnamed_group(int tag);
/// Where Gmsh has the nodes of a shape, in the order of DeckShape; empty: in the same places.
std::span<const std::uint8_t> gmsh_places(DeckShape shape);

} // namespace lacuna::io
