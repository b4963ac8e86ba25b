// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/mesh/tet_mesh.h>

namespace lacuna::test {

/// An n × n × 2 box: below wedges at one side and hexahedra, above a fan of pyramids and tetrahedra around
/// the centre of each cube, with pyramids on the hexahedra and tetrahedra on the wedges. Inner nodes are
/// moved.
mesh::TetMesh mixed_cells(int n, unsigned seed = 1);

/// The same as a deck of one region, with tags that leave gaps.
/// @param order   1 or 2
/// @param bend    how far middle nodes are moved from the middles of their edges.
io::Deck mixed_deck(int n, int order, double bend = 0);

} // namespace lacuna::test
