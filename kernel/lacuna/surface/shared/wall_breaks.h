// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/size_field.h>

#include <map>
#include <vector>

namespace lacuna::surface {

/// Linking surfaces whose segments are divided where columns must follow edges of the walls.
struct WallBreaks {
    std::vector<LinkingSurface> links;
    int layers = 1;
};

/// Divide the segments at the ends of long edges. Long edge: an edge between walls that runs along the sweep;
/// a column of nodes must follow it. Both rims get a node at the ends of this column. If a segment ends
/// closer to such a position than a fraction of the size, no node is added, and the column bends to the end
/// of that segment.
/// @return  the linking surfaces, and the minimum number of layers for edges around the walls: one more than
///         the largest number of such edges that lie above each other.
/// @throw NotSweepable "surface.wall_edge"  an edge runs neither along the sweep nor around it; names it.
/// @note  Maps the walls onto a strip only if they have edges other than side lines and closed rings.
WallBreaks set_wall_breaks(const topology::OpenVolume& volume, const SizeField& size,
                           std::vector<LinkingSurface> links);

/// For each edge that runs around the walls of a linking surface: its mean height between the rims, from 0 at
/// the source to 1 at the target.
/// @note  The walls are mapped onto a strip only if some part between two side lines has several faces.
std::map<EdgeId, double> heights_around(const topology::OpenVolume& volume, const LinkingSurface& link,
                                        const RunContext& context = {});

} // namespace lacuna::surface
