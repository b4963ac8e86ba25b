// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/second_order_options.h>
#include <lacuna/sweep/shared/layer_plan.h>
#include <lacuna/topology/open_volume.h>

#include <array>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// What became of a mesh that got middle nodes.
struct Elevated {
    quality::Quality quality; ///< of the cells of order 2
    std::string report;       ///< a line
    /// Where its nodes were left to be made and still are; nothing: the mesh holds them all.
    std::optional<PlacedLayers> layers;
};

/// Give a proved mesh of order 1 its middle nodes: it becomes one of order 2.
///
/// On the skin, given middle nodes stay bit for bit. Others lie on what their side lies on: between two faces
/// on the exact curve there, else on the face's exact surface, inside its trimming; on facets where both ends
/// lie on them, and straight between the nodes of a mesh that was given and stays. What has no such geometry,
/// as most void walls, is blended between the rows that have.
///
/// Inside, a level's sides are bent as the skin is: across the quads, from side to opposite side, every side
/// belongs to one chord, and its bend is interpolated between the chord's ends on the rim, in a frame that
/// turns with the sides; over a grid this is the transfinite map. What the two ends bend beyond that is
/// blended from layer to layer. Upright sides follow their column of nodes by cubics, and the walls' by a
/// harmonic spread of what is left. Middles of faces and cells are transfinite.
///
/// Where a cell is not valid by its Bézier bounds (`quality::judge()`), its middle nodes inside are moved.
/// @param faces   of each patch of the mesh.
/// @param layers  what makes the nodes that the mesh does not hold: those in the middle are then left to be
///                made too, if all cells are valid as they come; null: it holds them.
/// @param crew    who share the proof of such layers; null: this process alone.
/// @throw NotSweepable "sweep.second_order"  a cell is not valid however its inner nodes lie: names the face
///                     whose place of a middle node makes it so, and the size that would do.
///                     InvalidInput "sweep.too_many": more nodes than can be numbered. Cancelled.
/// @note  The same for any number of threads. O(cells), but for the harmonic spread, which is made where
///        columns of walls bend as no cubic does.
Elevated elevate(const topology::OpenVolume& volume, mesh::HexMesh& mesh, const std::vector<FaceId>& faces,
                 const SecondOrderOptions& options = {}, const RunContext& context = {},
                 const PlacedLayers* layers = nullptr, const Crew* crew = nullptr);

/// The skin of a mesh of order 2 as one of order 1 with four quads for each.
struct FinerSkin {
    mesh::HexMesh mesh;       ///< of its nodes those of the source
    mesh::LayeredNodes nodes; ///< of the skin alone; refers to what it was made from
};
/// For comparisons. @pre  order 2
FinerSkin finer_skin(const mesh::SkinNodes& skin);

} // namespace lacuna::sweep
