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
    std::string report;       ///< a line of the report
    /// The layers, if their nodes are generated on demand; empty: the mesh holds all nodes.
    std::optional<PlacedLayers> layers;
};

/// Add middle nodes to a proved mesh of order 1, which becomes a mesh of order 2.
///
/// On the skin, given middle nodes are kept bit for bit. Sides between two faces get nodes on the exact curve
/// of the edge. Other sides get nodes on the exact surface of their face, inside its trimming, or on its
/// facets if both ends lie on facets. Sides between nodes of a kept mesh stay straight. Sides without such
/// geometry, as on most void walls, are blended between rows that have it.
///
/// Inside, the sides of a level bend like the skin. Every side belongs to one chord, which runs across the
/// quads from side to opposite side. The bend of a side is interpolated between the bends at both ends of its
/// chord, which lie on the rim. This is done in a frame that rotates with the sides; on a grid, the result is
/// the transfinite map. The remaining bend of the two ends is blended from layer to layer. Sides between
/// layers follow their column of nodes by cubics, and the remaining bend of the walls is spread harmonically.
/// Midpoints of faces and cells are transfinite.
///
/// @param faces   face of each patch of the mesh.
/// @param layers  generator of the nodes that the mesh does not hold; null: the mesh holds its nodes. Middle
///         nodes are then generated on demand too.
/// @param crew    processes that share the proof of layers generated on demand; null: this process only.
/// @throw NotSweepable "sweep.second_order"  a cell is not valid by its Bézier bounds (`quality::judge()`);
///         names the face whose middle node causes it, and a sufficient size.
/// @throw InvalidInput "sweep.too_many"  there are more nodes than node numbers.
/// @throw Cancelled
/// @note  Deterministic for any number of threads. O(cells), plus the harmonic spread, which is needed only
///         if columns of walls bend in a way that cubics do not represent.
Elevated elevate(const topology::OpenVolume& volume, mesh::HexMesh& mesh, const std::vector<FaceId>& faces,
                 const SecondOrderOptions& options = {}, const RunContext& context = {},
                 const PlacedLayers* layers = nullptr, const Crew* crew = nullptr);

} // namespace lacuna::sweep
