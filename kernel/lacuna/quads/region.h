// SPDX-License-Identifier: MIT
#pragma once

// In: a region of the plane with its boundary nodes and a size; out: quads that keep these nodes.
//
// Where to change things:
//   checks of a region, steps of pave()     pave.cpp
//   which fillings are tried, their score   pave_choice.cpp; one of them: pave_attempt.cpp
//   grid in an outline of right angles      submap.cpp, submap_grid.cpp
//   bent grids; around a hole               face_pattern.cpp, pattern_ring.cpp
//   numbers of sides for one grid           pattern_counts.cpp, straight_counts.cpp, ring_counts.cpp,
//                                           star_counts.cpp, mirror_counts.cpp
//   rows along the boundary, their heights  pave_rows.cpp, row_heights.cpp; on some sides: boundary_rows.cpp
//   cuts; joining holes to the outline      pave_core.cpp, pave_cut.cpp, pave_bridge.cpp
//   parts filled by one patch               pave_fit.cpp, patch_template.cpp, template_cuts.cpp
//   size inside the region                  pave_size.cpp
//   large regions: coarse, then divided     pave_coarse.cpp, coarse_region.cpp, split_cells.cpp
//   last resort: triangles                  triangle_quads.cpp
//   fewer irregular nodes                   clean_quads.cpp, clean_patch.cpp, clean_trial.cpp
//   smoothing, untangling                   smooth_plane.cpp, untangle_plane.cpp, raise_flat_quads.cpp
//   symmetric regions                       outline_symmetry.cpp, symmetry.cpp
//   odd number of sides                     odd_region.cpp
//   how good plane quads are                measure_plane.cpp

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <functional>
#include <string>
#include <vector>

namespace lacuna::quads {

/// A region of the plane to be filled with quads.
struct PlanarRegion {
    std::vector<Vec2> points; ///< boundary nodes; kept, in this order, as the first nodes of the mesh
    /// Node cycles with the region on their left, the outer one first. Their total number of nodes is even.
    std::vector<std::vector<Index>> loops;
    std::function<double(const Vec2&)> size;         ///< target edge length in the plane; may be empty
    std::function<double(const Vec2&)> row_height{}; ///< height of the rows along the loops; empty: no rows
};

/// Check whether a region can be filled at all, before any work is done.
/// @throw InvalidInput  "surface.pave_loops": there is no loop, a loop has fewer than three nodes, or loops
///         cross, touch or have the wrong direction; "surface.pave_parity": the number of boundary sides is
///         odd.
void check(const PlanarRegion& region);

/// Quads over a planar region.
struct PlanarQuads {
    std::vector<Vec2> points; ///< the region's points first, then points added inside
    std::vector<Quad> quads;  ///< counter-clockwise
    std::string how{}; ///< method that made the mesh, such as "mapped" or "paved", for a note; may be empty
};

/// A mesher that fills a planar region with quads alone and keeps its boundary nodes.
/// @throw NotSweepable  if it cannot fill the region.
using PlanarQuadMesher = std::function<PlanarQuads(const PlanarRegion&, const RunContext&)>;

} // namespace lacuna::quads
