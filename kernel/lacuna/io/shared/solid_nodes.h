// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/mesh/second_order.h>

namespace lacuna::io {

/// The nodes of a solid of a deck, in the form of `mesh::merged_nodes()`.
mesh::CellNodes solid_nodes(const DeckBlock& block, std::size_t element);

} // namespace lacuna::io
