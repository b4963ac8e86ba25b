// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/sweep/columns.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// Moves points onto the target surface, each to the closest place near where it is.
using SurfaceProjector = std::function<void(std::span<Vec3>)>;

/// The source mesh on the target.
struct Carried {
    std::vector<Vec3> nodes; ///< target position of each source node [model length]
    double worst_source =
        1; ///< smallest scaled Jacobian of a quad of the source, seen along the surface's normal [-1, 1]
    double worst = 1;   ///< and of a quad on the target
    std::string report; ///< one line for a person
};

/// Carry the source mesh to the target: rim nodes to the last row of the columns, the rest by the affine fit
/// of the rims and the harmonic residual, then onto the surface, then smoothed there where that betters it.
///
/// @return  target position of each source node [model length].
/// @post  rim nodes are those of the columns, bit for bit.
/// @throw InvalidInput  columns that do not fit the source; names the node.
std::vector<Vec3> carry_to_target(const mesh::QuadMesh& source, const Columns& columns,
                                  const SurfaceProjector& project, const RunContext& context = {});

/// `carry_to_target()` with what was measured on the way. An empty projector leaves nodes where the fit puts them.
Carried carry(const mesh::QuadMesh& source, const Columns& columns, const SurfaceProjector& project,
              const RunContext& context = {});

} // namespace lacuna::sweep
