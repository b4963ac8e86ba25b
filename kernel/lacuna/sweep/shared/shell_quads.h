// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/second_order.h>
#include <lacuna/sweep/sweep.h>
#include <lacuna/topology/model.h>

#include <string>
#include <vector>

namespace lacuna::sweep {

/// Quads on the faces of a model, without layers.
struct ShellQuads {
    std::vector<Vec3> nodes;            ///< corners, then middle nodes on exact edges and faces
    std::vector<mesh::CellNodes> quads; ///< of 4, 8 or 9 nodes, or kept triangles; normals as the faces'
    std::vector<FaceId> face;           ///< face of each quad
    double min_scaled_jacobian = 1, mean_scaled_jacobian = 1; ///< over the corners; the mean over the quads
    double area = 0;
    std::vector<std::string> report;
};

/// Mesh all faces of a model as the faces of a source.
/// @throw  as `fill::quads()`
ShellQuads shell_quads(const topology::Model& model, const SweepOptions& options,
                       const RunContext& context = {});

} // namespace lacuna::sweep
