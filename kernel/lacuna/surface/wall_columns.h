// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/linking_surface.h>

#include <vector>

namespace lacuna::surface {

/// Walls longer than the straight line by a smaller share count as straight: this is less than one of ten
/// layers. Where the volume of a bulge matters, the bound is the length of an arc whose sag is a seventieth
/// of it.
inline constexpr double kHardlyLonger = 0.05, kAnyLonger = 5e-4;

/// Columns up a linking surface from source to target, each with steps + 1 points at even steps of its
/// length: its side lines, on the exact curves. Without side lines, columns of the walls' harmonic map from
/// eight points of the source's rim, or straight lines if the walls are hardly longer than those.
/// @throw Cancelled
/// @cost  near linear in the walls' facets where the map is needed.
std::vector<std::vector<Vec3>> wall_columns(const topology::OpenVolume& volume, const LinkingSurface& link,
                                            int steps, const RunContext& context = {},
                                            double hardly_longer = kHardlyLonger);

/// Whether the walls bend at all, by their mean length.
bool walls_bend(const topology::OpenVolume& volume, const LinkingSurface& link);

} // namespace lacuna::surface
