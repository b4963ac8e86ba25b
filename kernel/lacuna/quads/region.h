// SPDX-License-Identifier: MIT
#pragma once

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
