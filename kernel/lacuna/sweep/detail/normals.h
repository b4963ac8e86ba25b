// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/shared/layers.h>

#include <span>

namespace lacuna::sweep {

/// Place the layers as the paper does where no affine map exists: each layer's inside is the one below
/// advanced along its local normals, by steps spread harmonically from the rim's own, and smoothed; its rim
/// is the columns'. The last layer is the target.
///
/// Kept for comparison: nothing leads the layers to the target, so that drift gathers in the last one, and
/// sharply bent or concave sections fold where `place_layers()` does not. O(layers · nodes), one layer after
/// the other.
/// @throw InvalidInput  columns that do not fit the source or the target.
LayerNodes place_along_normals(const mesh::QuadMesh& source, std::span<const Vec3> target,
                               const RimColumns& columns, const RunContext& context = {});

} // namespace lacuna::sweep
