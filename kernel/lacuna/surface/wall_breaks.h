// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/linking_surface.h>
#include <lacuna/surface/size_field.h>

#include <vector>

namespace lacuna::surface {

/// Give the rims a node under and over every column that long edges of the walls ask for, by dividing the
/// segments there. A break nearer than a part of the size is taken as it is: the column bends.
/// @return  layers that edges round the walls take at least: one more than lie over each other.
/// @throw NotSweepable "surface.wall_edge"  names an edge that is neither long nor cross.
/// @note  Maps the walls onto a strip only where their edges are more than side lines and whole rings.
int set_wall_breaks(const topology::OpenVolume& volume, const SizeField& size,
                    std::vector<LinkingSurface>& links);

} // namespace lacuna::surface
