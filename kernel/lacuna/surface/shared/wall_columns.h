// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/shared/walls.h>

#include <vector>

namespace lacuna::surface {

/// Largest number of sides of a full turn that a default size requests, and number of columns of a model of a
/// wall. A polygon of 128 sides lacks 0.04 % of the circle's area, a sphere 0.1 % of its volume.
inline constexpr int kMostPerTurn = 128;

/// Columns along a linking surface from source to target, each with steps + 1 points at even steps of its
/// length:
/// - If there are side lines, these are the columns, on the exact curves.
/// - Else, if the walls are hardly longer than straight lines between the rims: one straight line for each
///   segment of the rims.
/// - Else eight columns of the walls' harmonic map (`LinkingMap`).
/// @throw Cancelled
/// @note  If the map is needed, the cost is nearly linear in the walls' facets.
std::vector<std::vector<Vec3>> wall_columns(const topology::OpenVolume& volume, const LinkingSurface& link,
                                            int steps, const RunContext& context = {});

/// The shares of the length of a side line at heights of layers. They differ from the heights where the walls
/// bend, so that layers run straight across the bends (`LinkingMap`).
/// @param line  index in `link.lines`
/// @param heights  in [0, 1], 0 at the source
std::vector<double> shares_on_line(const topology::OpenVolume& volume, const LinkingSurface& link,
                                   std::size_t line, std::vector<double> heights, const RunContext& context);

/// steps + 1 rows of points from the source's rim to the target's rim. The first and the last row lie on the
/// rims. The other rows are the images of even heights in the walls' harmonic map (`LinkingMap`).
/// @throw Cancelled
std::vector<std::vector<Vec3>> wall_rows(const topology::OpenVolume& volume, const LinkingSurface& link,
                                         const LinkingNodes& nodes, int steps, const RunContext& context);

/// For each segment, the turn of the rim along the segment [radian]: that of the source's or of the target's
/// rim, whichever is larger. The turn of a rim with `RimSegment::follows` or `target_follows` is not counted.
std::vector<double> turning_of_segments(const topology::Model& model, const LinkingSurface& link);

} // namespace lacuna::surface
