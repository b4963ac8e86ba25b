// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/linking_surface.h>
#include <lacuna/surface/walls.h>

#include <vector>

namespace lacuna::surface {

/// Columns up a linking surface from source to target, each as steps + 1 points at even shares of the way:
/// its side lines, on the exact curves. Without them, ways up the walls by their harmonic map from eight
/// places of the source's rim; straight ones where the walls are hardly longer than those.
/// @throw Cancelled
/// @cost  near linear in the walls' facets where the map is needed.
std::vector<std::vector<Vec3>> wall_columns(const topology::OpenVolume& volume, const LinkingSurface& link,
                                            int steps, const RunContext& context = {});

/// Rows of points from the source's rim to the target's, steps + 1 of them: on the rims, and between these on
/// the walls by their harmonic map.
/// @throw Cancelled
std::vector<std::vector<Vec3>> wall_rows(const topology::OpenVolume& volume, const LinkingSurface& link,
                                         const LinkingNodes& nodes, int steps, const RunContext& context);

/// How far the rim turns along each segment [radian], on the source's or on the target's side, where it turns
/// more; not between vertices of facets that it follows.
std::vector<double> turning_of_segments(const topology::Model& model, const LinkingSurface& link);

} // namespace lacuna::surface
