// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/second_order_options.h>
#include <lacuna/sweep/shared/layer_plan.h>
#include <lacuna/topology/open_volume.h>

#include <optional>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// The result of adding middle nodes to a mesh.
struct Elevated {
    quality::Quality quality; ///< quality of the cells of order 2
    std::string report;       ///< a line
    /// The layers, if their nodes are generated on demand; empty: the mesh holds all nodes.
    std::optional<PlacedLayers> layers;
};

/// Add middle nodes to a proved mesh of order 1, which makes it one of order 2.
///
/// On the skin, given middle nodes are kept bit for bit. Others lie on the geometry of their side: between
/// two faces on the exact curve, otherwise on the face's exact surface, inside its trimming; on facets if
/// both ends lie on facets, and at the straight midpoint between nodes of a kept mesh. Sides without such
/// geometry, as on most void walls, are blended between rows that have one.
///
/// Inside, a level's sides bend like the skin: across the quads, from side to opposite side, every side
/// belongs to one chord, and its bend is interpolated between the chord's ends on the rim, in a frame that
/// rotates with the sides; on a grid this is the transfinite map. The remaining bend of the two ends is
/// blended from layer to layer. Sides up the layers follow their column of nodes by cubics, and the remaining
/// bend of the walls is spread harmonically. Midpoints of faces and cells are transfinite.
///
/// If a cell is not valid by its Bézier bounds (`quality::judge()`), its inner middle nodes are moved.
/// @param faces   of each patch of the mesh.
/// @param layers  generator of the nodes that the mesh does not hold: middle nodes are then generated on
///                demand too, if all cells are valid without moves; null: the mesh holds its nodes.
/// @param crew    processes that share the proof of such layers; null: this process only.
/// @throw NotSweepable "sweep.second_order"  a cell is not valid for any position of its inner nodes: names
///        the face whose middle node causes it, and a sufficient size. InvalidInput "sweep.too_many": more
///        nodes than numbers. Cancelled.
/// @note  Deterministic for any number of threads. O(cells), plus the harmonic spread, which is needed only
///        if columns of walls bend unlike any cubic.
Elevated elevate(const topology::OpenVolume& volume, mesh::HexMesh& mesh, const std::vector<FaceId>& faces,
                 const SecondOrderOptions& options = {}, const RunContext& context = {},
                 const PlacedLayers* layers = nullptr, const Crew* crew = nullptr);

} // namespace lacuna::sweep
