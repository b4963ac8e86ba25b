// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/mesh/mesh_part.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::io {

/// How a mesh is divided into parts, one for each process of a solver.
struct PartitionOptions {
    int parts = 0;  ///< >= 1; 0: the mesh is not divided
    int ghosts = 0; ///< rows of other parts' cells around each part that are marked as its ghosts, >= 0
};

/// Layers [first, last) of a swept mesh that form a part; with its ghosts [with_first, with_last).
struct LayerPart {
    int first = 0, last = 0;
    int with_first = 0, with_last = 0;
};
/// Consecutive ranges of layers, as even as possible.
/// @throw InvalidInput "io.too_many_parts"  a part would have no layer.
std::vector<LayerPart> layer_parts(int layers, const PartitionOptions& options);

/// The part of each element of a deck, and the parts of which it is a ghost.
struct DeckPartition {
    int parts = 1;
    std::vector<std::vector<Index>> part; ///< part from 0, for each element of each block
    /// For each element of each block, the parts of which it is a ghost, as an index in `lists`; 0: none.
    std::vector<std::vector<Index>> ghost_of;
    std::vector<std::vector<int>> lists{{}}; ///< parts, increasing
};
/// Divide several connected swept meshes into parts: whole volumes, with numbers of cells as even as
/// possible, if there are at least as many volumes as parts; otherwise each volume is one or several parts by
/// its layers. Quads belong to the part of their cell.
/// @param deck  `deck_of()` the meshes, without requested first numbers.
/// @throw InvalidInput "io.too_many_parts"  there are fewer layers than parts.
/// @note  O(nodes of all cells) for each row of ghosts.
DeckPartition partition_of(const Deck& deck, std::span<const mesh::MeshPart> meshes,
                           const PartitionOptions& options);

} // namespace lacuna::io
