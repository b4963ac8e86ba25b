// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/sweep/layers.h>
#include <lacuna/sweep/rim_columns.h>

#include <string>
#include <vector>

namespace lacuna::sweep {

/// The layers of `place_layers()` to be made when they are asked for, and its report.
struct PlacedLayers {
    mesh::LayeredNodes nodes; ///< keeps what it needs
    Placement placement = Placement::affine;
    std::string report;
};

/// @throw  as `place_layers()`
PlacedLayers placed_layers(mesh::QuadMesh source, std::vector<Vec3> target, RimColumns columns,
                           const PlacementOptions& options);

} // namespace lacuna::sweep
