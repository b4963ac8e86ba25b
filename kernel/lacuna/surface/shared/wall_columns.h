// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/shared/walls.h>

#include <vector>

namespace lacuna::surface {

/// Columns along a linking surface from source to target, each with steps + 1 points at even steps of its
/// length. If there are side lines, these are the columns, on the exact curves. Otherwise there are eight
/// columns, which start at points of the source's rim. They follow the walls' harmonic map or, if the walls
/// are hardly longer than straight lines between the rims, such straight lines.
/// @throw Cancelled
/// @note  If the map is needed, the cost is nearly linear in the walls' facets.
std::vector<std::vector<Vec3>> wall_columns(const topology::OpenVolume& volume, const LinkingSurface& link,
                                            int steps, const RunContext& context = {});

/// steps + 1 rows of points from the source's rim to the target's. The first and the last row lie on the
/// rims. The other rows lie on the walls and follow the walls' harmonic map.
/// @throw Cancelled
std::vector<std::vector<Vec3>> wall_rows(const topology::OpenVolume& volume, const LinkingSurface& link,
                                         const LinkingNodes& nodes, int steps, const RunContext& context);

/// For each segment, the turn of the rim along it [radian]: on the source's or the target's rim, whichever is
/// larger. Where the rim follows vertices of facets, the turn between two such vertices is not counted.
std::vector<double> turning_of_segments(const topology::Model& model, const LinkingSurface& link);

} // namespace lacuna::surface
