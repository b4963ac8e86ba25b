// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/bytes.h>
#include <lacuna/core/shared/team.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/shared/layers.h>
#include <lacuna/sweep/shared/rim_columns.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::sweep {

/// The data that, besides the corners, determine the middle nodes of layers.
struct MiddlePlan {
    bool full = false;      ///< hex27; else hex20
    std::vector<Vec3> skin; ///< middle nodes of the skin, in an internal order
};

/// The data that determine all layers of a mesh. They need memory only for the source and for the rims of the
/// walls.
struct LayerPlan {
    mesh::QuadMesh source; ///< without labels of its quads
    std::vector<Vec3> target;
    RimColumns columns;
    PlacementOptions options;
    std::optional<MiddlePlan> middles{}; ///< middle nodes, if the mesh is of order 2
};

/// The cells of layers over a source, without nodes and patches.
mesh::HexMesh cells_over(const mesh::QuadMesh& source, int layers);

/// The numbering of a plan's middle nodes, without their positions. Empty if the plan is of order 1.
/// @param cells  provides the quads, the rim and the layers of the plan's mesh.
mesh::MiddleNodes middles_of(const LayerPlan& plan, const mesh::HexMesh& cells);

/// The layers of `place_layers()`, generated on demand, and its report.
struct PlacedLayers {
    std::shared_ptr<const LayerPlan> plan;
    mesh::LayeredNodes nodes; ///< owns the data it needs
    std::string report;
};

/// @throw  as `place_layers()`
PlacedLayers placed_layers(std::shared_ptr<const LayerPlan> plan, const RunContext& context = {});

/// Add middle nodes to placed layers.
PlacedLayers with_middles(PlacedLayers layers, MiddlePlan middles, const RunContext& context = {});

/// Serialise a complete plan into a message to other processes.
void put(Writer& writer, const LayerPlan& plan);
void put(Reader& reader, LayerPlan& plan);

/// Quality of the cells of placed layers, and, if the quality is sufficient, whether some node is misplaced.
struct LayersFound {
    quality::Quality quality;
    bool good_enough = false;
    std::optional<quality::Finding> misplaced;
};

/// Measure all cells of a plan and look for misplaced nodes. With a crew, all its processes share the work.
/// @param least  scaled Jacobian that is sufficient
/// @param crew   null: this process only
/// @throw Cancelled; TeamFailed
LayersFound find_in_layers(const PlacedLayers& layers, double least, const Crew* crew,
                           const RunContext& context);

/// Name of this task in `do_together()`.
inline constexpr std::string_view kLayersTask = "layers";
void help_find_in_layers(const std::string& bytes, const Team& team, const RunContext& context);

} // namespace lacuna::sweep
