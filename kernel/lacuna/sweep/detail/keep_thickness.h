// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/sweep/detail/row_columns.h>

#include <string>
#include <vector>

namespace lacuna::sweep {

/// The nodes of boundary layers, and the accuracy reached.
struct KeptThickness {
    /// For each node of the mesh, whether it belongs to a row or layer of given thickness. Empty: no node
    /// does.
    std::vector<char> held;
    std::vector<std::string> report; ///< a line for each table
};

/// Move nodes so that boundary layers have the requested thickness, measured normal to the faces of the mesh
/// at their base: rows along walls in every layer, and layers along ends.
///
/// Two steps alternate until the thickness is reached:
/// 1. Rows along walls. The nodes of a row are found by walking from the rim over opposite sides of quads.
///    Row nodes on other walls slide along the layer's rim, together with the rest of the rim. Inner row
///    nodes move within their layer. These moves are spread harmonically over the layer, and nodes of the
///    ends are projected back onto their faces.
/// 2. Layers along ends. Their nodes move along the columns.
///
/// @param nodes  (layers + 1) × source nodes, layer-major; moved.
/// @throw NotSweepable "sweep.layers_thickness"  rows cannot have their thickness; names the wall, the
///         requested and the actual thickness, and the place.
KeptThickness keep_thickness(const SweptParts& parts, const surface::LayerTables& tables,
                             std::vector<Vec3>& nodes, const RunContext& context);

} // namespace lacuna::sweep
