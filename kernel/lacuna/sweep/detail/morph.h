// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/sweep/shared/rim_columns.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// Moves points onto the target surface, each to the closest position near it.
using SurfaceProjector = std::function<void(std::span<Vec3>)>;

/// The source mesh on the target.
struct Morphed {
    std::vector<Vec3> nodes; ///< target position of each source node [model length]
    /// Minimum scaled Jacobian of the source's quads, measured along the surface normal [-1, 1].
    double worst_source = 1;
    double worst = 1;   ///< the same for the quads on the target
    std::string report; ///< one line of text
};

/// Morph the source mesh onto the target. Rim nodes go to the last row of the columns. The other nodes follow
/// the affine fit of the rims, plus the rims' residual spread harmonically. They are then projected onto the
/// surface, and smoothed on it if this improves the worst quad.
///
/// @param project  empty: nodes are not projected.
/// @param rows     `SourceMesh::rows` of a tube: the residual varies linearly along its grid lines. On the
///         target, these then lead from rim node to rim node, too.
/// @post  rim nodes are those of the columns, bit for bit.
/// @throw InvalidInput  columns that do not fit the source; names the node.
Morphed morph(const mesh::QuadMesh& source, const RimColumns& columns, const SurfaceProjector& project,
              const RunContext& context = {}, std::span<const std::vector<Index>> rows = {});

} // namespace lacuna::sweep
