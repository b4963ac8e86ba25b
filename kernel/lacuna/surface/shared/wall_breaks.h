// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/size_field.h>

#include <map>
#include <vector>

namespace lacuna::surface {

/// Linking surfaces broken at the long edges of their walls.
struct WallBreaks {
    std::vector<LinkingSurface> links;
    int layers = 1;
};

/// Split the segments so that both rims have a node at the ends of every column that the walls' long edges
/// require. If an existing break is closer than a fraction of the size, the column bends to it.
/// @return  the links, and the minimum number of layers for edges around the walls: one more than the largest
///     number of such edges above each other.
/// @throw NotSweepable "surface.wall_edge"  names an edge that is neither long nor cross.
/// @note  Maps the walls onto a strip only if they have edges besides side lines and whole rings.
WallBreaks set_wall_breaks(const topology::OpenVolume& volume, const SizeField& size,
                           std::vector<LinkingSurface> links);

/// Mean height of each edge around the walls of a linking surface, between the rims: from 0 at the source to
/// 1 at the target.
/// @note  Maps the walls onto a strip only if they have more faces than side lines separate.
std::map<EdgeId, double> heights_around(const topology::OpenVolume& volume, const LinkingSurface& link,
                                        const RunContext& context = {});

} // namespace lacuna::surface
