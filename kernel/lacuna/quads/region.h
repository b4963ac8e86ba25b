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
    std::vector<std::vector<Index>>
        loops; ///< node cycles, region on the left; the outer one first; each of even length in sum
    std::function<double(const Vec2&)> size;         ///< target edge length in the plane
    std::function<double(const Vec2&)> row_height{}; ///< of rows along the loops, where they are asked for
};

/// Quads over a planar region.
struct PlanarQuads {
    std::vector<Vec2> points; ///< the region's own first, then those added inside
    std::vector<Quad> quads;  ///< counter-clockwise
    std::string how{};        ///< by what they were made, for a note: "mapped", "paved"; may be empty
};

/// Something that fills a planar region with quads and nothing else, its boundary nodes kept.
/// @throw NotSweepable where it cannot.
using PlanarQuadMesher = std::function<PlanarQuads(const PlanarRegion&, const RunContext&)>;

} // namespace lacuna::quads
