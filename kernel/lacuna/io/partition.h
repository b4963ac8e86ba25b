// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/mesh/mesh_part.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::io {

/// How a mesh is written in parts, each of which a process of a solver takes.
struct PartitionOptions {
    int parts = 0;  ///< >= 1; 0: the mesh is one
    int ghosts = 0; ///< rows of others' cells round each part that are marked as its ghosts, >= 0
};

/// Layers [first, last) of a swept mesh that are a part, and with its ghosts [with_first, with_last).
struct LayerPart {
    int first = 0, last = 0;
    int with_first = 0, with_last = 0;
};
/// Ranges of layers that follow each other, as even as can be.
/// @throw InvalidInput "io.too_many_parts"  a part would have no layer.
std::vector<LayerPart> layer_parts(int layers, const PartitionOptions& options);

/// Which part the elements of a deck belong to, and of which others they are ghosts.
struct DeckPartition {
    int parts = 1;
    std::vector<std::vector<Index>> part; ///< of each element of each block, from 0
    /// Of each element of each block the parts that it is a ghost of, as a place in `lists`; 0: none.
    std::vector<std::vector<Index>> ghost_of;
    std::vector<std::vector<int>> lists{{}}; ///< parts, rising
};
/// Parts of several swept meshes that are one: volumes whole, as even in cells as can be, where there are as
/// many volumes as parts; else each volume is one or several parts by its layers. Quads belong to the part
/// of the cell behind them.
/// @param deck  `deck_of()` the meshes, without first numbers of one's own.
/// @throw InvalidInput "io.too_many_parts"  there are fewer layers than parts.
/// @note  O(nodes of all cells) for each row of ghosts.
DeckPartition partition_of(const Deck& deck, std::span<const mesh::MeshPart> meshes,
                           const PartitionOptions& options);

} // namespace lacuna::io
