// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace lacuna::io {

/// How a mesh is divided into parts, one for each process of a solver.
struct PartitionOptions {
    int parts = 0;  ///< >= 1; 0: the mesh is not divided
    int ghosts = 0; ///< number of rows of cells around each part that are marked as its ghosts, >= 0
};

/// Layers [first, last) of a swept mesh that form a part. Together with its ghosts, the part has the layers
/// [with_first, with_last).
struct LayerPart {
    int first = 0, last = 0;
    int with_first = 0, with_last = 0;
};
/// Consecutive ranges of layers, as even as possible.
/// @throw InvalidInput "io.too_many_parts"  a part would have no layer.
std::vector<LayerPart> layer_parts(int layers, const PartitionOptions& options);

} // namespace lacuna::io
