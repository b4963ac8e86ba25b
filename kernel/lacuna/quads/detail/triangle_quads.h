// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/quad_repair.h>
#include <lacuna/quads/region.h>

#include <vector>

namespace lacuna::quads {

/// Closed loops of point numbers.
using Loops = std::vector<std::vector<Index>>;

/// Ways from triangles to quads, the first that does usually the best.
enum class TriangleWay {
    halved, ///< triangles over the loops with every second node, each cut in three: quads that cannot fold; even smooth loops alone
    paired, ///< triangles over the loops, paired, what is left over paired by walking; may fold
    split, ///< triangles over the loops, paired as far as that gives convex quads, and cells split: always goes
};

/// Fill a region with quads made of triangles: what is left when no rows and cuts fit. Constrained Delaunay triangles by size,
/// whose quads are many and irregular: to be cleaned and smoothed.
/// @return no quads where the way is barred, or triangles are left.
PlanarQuads quads_of_triangles(const PlanarRegion& region, TriangleWay way);

/// Every loop with each second node only, starting so that what is dropped turns least.
Loops halve(const std::vector<Vec2>& points, const Loops& loops);

/// Is the loop with every second node still near enough to the loop: no corner dropped, nothing crossed?
bool can_halve(const std::vector<Vec2>& points, const Loops& loops, const Loops& half);

/// Numbers of loop nodes, loop after loop: the order of a mixed mesh's fixed points.
std::vector<Index> in_order(const Loops& loops);

/// Cut the cells of a mesh over `half` so that its boundary becomes that of `loops`.
MixedMesh refine(const MixedMesh& mesh, const std::vector<Vec2>& points, const Loops& loops,
                 const Loops& half);

/// The nodes in the region's own order; points in no loop are kept, unused. Added points are scaled, then moved by `origin`.
PlanarQuads deliver(const MixedMesh& mesh, const PlanarRegion& region, const Loops& loops, const Vec2& origin,
                    double scale);

} // namespace lacuna::quads
