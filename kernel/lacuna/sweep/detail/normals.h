// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/shared/layers.h>

#include <span>

namespace lacuna::sweep {

/// Place the layers as in the paper where no affine map exists. The inside of each layer is the layer below,
/// advanced along local normals by steps that are spread harmonically from the rim's steps, and smoothed. The
/// rim of each layer is that of the columns. The last layer is the target.
///
/// Kept for comparison: the layers are not guided to the target, so the drift accumulates in the last one,
/// and sharply bent or concave sections fold where `place_layers()` does not. O(layers · nodes), sequential
/// in the layers.
/// @throw InvalidInput  columns that do not fit the source or the target.
LayerNodes place_along_normals(const mesh::QuadMesh& source, std::span<const Vec3> target,
                               const RimColumns& columns, const RunContext& context = {});

} // namespace lacuna::sweep
