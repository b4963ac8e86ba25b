// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/sweep/detail/row_columns.h>

#include <string>
#include <vector>

namespace lacuna::sweep {

/// Nodes of boundary layers, and what was reached.
struct KeptThickness {
    /// Of each node of the mesh: it belongs to rows or layers of given thickness. Empty: none does.
    std::vector<char> held;
    std::vector<std::string> report; ///< a line a table
};

/// A row of a boundary layer may be off its thickness by this share, after all nodes were moved. What is left
/// comes of walls and ends that bend within a cell. A choice, not a measurement.
inline constexpr double kThicknessOff = 0.02;

/// Move nodes so that rows along walls, in every layer, and layers along ends have the thickness asked for,
/// square to the faces of the mesh at their foot.
///
/// The nodes of a row are found by walking over opposite sides of quads from the rim. Those on other walls
/// slide along the layer's rim, and the rest of the rim with them; those inside move within their layer. The
/// moves are spread over the layer harmonically, and nodes of the ends put back on their faces. Layers along
/// an end are moved along their columns. Rounds of both, until the thickness is met.
/// @param nodes  (layers + 1) × source nodes, layer-major; moved.
/// @throw NotSweepable "sweep.layers_thickness"  rows that cannot have their thickness; names the wall, what
///        was asked for, what was reached and where.
KeptThickness keep_thickness(const SweptParts& parts, const surface::LayerTables& tables,
                             std::vector<Vec3>& nodes, const RunContext& context);

} // namespace lacuna::sweep
