// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/shared/walls.h>

#include <vector>

namespace lacuna::surface {

/// Columns up a linking surface from source to target, each with steps + 1 points at even steps of its
/// length. If there are side lines, these are the columns, on the exact curves. Otherwise columns of the
/// walls' harmonic map start at eight points of the source's rim; straight lines are used if the walls are
/// hardly longer than those.
/// @throw Cancelled
/// @cost  near linear in the walls' facets where the map is needed.
std::vector<std::vector<Vec3>> wall_columns(const topology::OpenVolume& volume, const LinkingSurface& link,
                                            int steps, const RunContext& context = {});

/// Rows of points from the source's rim to the target's, steps + 1 of them: on the rims, and between these on
/// the walls by their harmonic map.
/// @throw Cancelled
std::vector<std::vector<Vec3>> wall_rows(const topology::OpenVolume& volume, const LinkingSurface& link,
                                         const LinkingNodes& nodes, int steps, const RunContext& context);

/// Turn of the rim along each segment [radian], on the source's or the target's side, whichever is larger.
/// The turn between facet vertices that the rim follows is not counted.
std::vector<double> turning_of_segments(const topology::Model& model, const LinkingSurface& link);

} // namespace lacuna::surface
