// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/mesh/second_order.h>

namespace lacuna::io {

/// The nodes of a solid of a deck as `quality::measure_cells()` takes them: those of a hexahedron as they
/// are, those of others as of a hexahedron of 8 or 20 nodes with merged corners. Middle nodes of the faces of
/// pyramids and wedges are left out.
mesh::CellNodes solid_nodes(const DeckBlock& block, std::size_t element);

} // namespace lacuna::io
