// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/shared/layers.h>

#include <span>

namespace lacuna::sweep {

/// Place the layers by the method of Roca and Sarrate (2010), without affine maps. The inside of each layer
/// is the inside of the layer below, advanced along local normals and then smoothed. The lengths of these
/// steps are spread harmonically from the rim. The rim of each layer is that of the columns, and the last
/// layer is the target.
///
/// Kept for comparison. The layers are not guided to the target, so the whole drift appears in the last
/// layer. Sharply bent or concave sections fold where `place_layers()` does not. O(layers · nodes),
/// sequential in the layers.
/// @throw InvalidInput  the columns do not fit the source or the target.
LayerNodes place_along_normals(const mesh::QuadMesh& source, std::span<const Vec3> target,
                               const RimColumns& columns, const RunContext& context = {});

} // namespace lacuna::sweep
