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
    std::vector<Vec3> nodes; ///< corners, then middle nodes on exact edges and faces
    /// Quads of 4, 8 or 9 nodes, or kept triangles, oriented like the faces.
    std::vector<mesh::CellNodes> quads;
    std::vector<FaceId> face; ///< face of each quad
    /// Over the corners of all quads; the mean is over the quads.
    double min_scaled_jacobian = 1, mean_scaled_jacobian = 1;
    double area = 0;
    std::vector<std::string> report;
};

/// Mesh all faces of a model in the way the source faces of a sweep are meshed.
/// @throw  as `fill::quads()`
ShellQuads shell_quads(const topology::Model& model, const SweepOptions& options,
                       const RunContext& context = {});

} // namespace lacuna::sweep
