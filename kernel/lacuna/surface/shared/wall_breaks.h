// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/size_field.h>

#include <map>
#include <vector>

namespace lacuna::surface {

/// Linking surfaces with segments divided for the long edges of their walls.
struct WallBreaks {
    std::vector<LinkingSurface> links;
    int layers = 1;
};

/// Divide the segments so that both rims have a node at the ends of every column that the walls' long edges
/// require. If an existing segment ends closer than a fraction of the size, there is no new node, and the
/// column bends to the end of that segment.
/// @return  the linking surfaces, and the minimum number of layers for edges around the walls: one more than
///         the largest number of such edges that lie above each other.
/// @throw NotSweepable "surface.wall_edge"  an edge is neither long nor cross; names it.
/// @note  Maps the walls onto a strip only if they have edges other than side lines and closed rings.
WallBreaks set_wall_breaks(const topology::OpenVolume& volume, const SizeField& size,
                           std::vector<LinkingSurface> links);

/// Mean height between the rims of each edge that runs around the walls of a linking surface, from 0 at the
/// source to 1 at the target.
/// @note  Maps the walls onto a strip only if they have more faces than there are parts between side lines.
std::map<EdgeId, double> heights_around(const topology::OpenVolume& volume, const LinkingSurface& link,
                                        const RunContext& context = {});

} // namespace lacuna::surface
