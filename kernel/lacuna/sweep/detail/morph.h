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

/// Moves points onto the target surface, each to the closest place near where it is.
using SurfaceProjector = std::function<void(std::span<Vec3>)>;

/// The source mesh on the target.
struct Morphed {
    std::vector<Vec3> nodes; ///< target position of each source node [model length]
    /// Smallest scaled Jacobian of a quad of the source, seen along the surface's normal [-1, 1]
    double worst_source = 1;
    double worst = 1;   ///< and of a quad on the target
    std::string report; ///< one line for a person
};

/// Morph the source mesh onto the target: rim nodes go to the last row of the columns; the rest follow the
/// affine fit of the rims and the residual, spread harmonically, then go onto the surface, then are smoothed
/// there where that makes the worst quad better.
///
/// @param project  empty: nodes stay where the fit puts them.
/// @post  rim nodes are those of the columns, bit for bit.
/// @throw InvalidInput  columns that do not fit the source; names the node.
Morphed morph(const mesh::QuadMesh& source, const RimColumns& columns, const SurfaceProjector& project,
              const RunContext& context = {});

} // namespace lacuna::sweep
