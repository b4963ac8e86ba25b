// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

#include <span>
#include <string>

/// Gmsh's node orders. Internal to this folder.
namespace lacuna::io {

/// The name given to a physical group without one.
std::string unnamed_group(int tag);
/// Positions of a shape's nodes in Gmsh, in the order of DeckShape; empty: the same positions.
std::span<const std::uint8_t> gmsh_places(DeckShape shape);

} // namespace lacuna::io
