// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/linking_surface.h>

#include <vector>

namespace lacuna::surface {

/// Walls longer than the straight way by a smaller share count as straight: less than a layer of ten; and
/// where the volume of a bulge counts, with the length of an arc whose sag is a seventieth of it.
inline constexpr double kHardlyLonger = 0.05, kAnyLonger = 5e-4;

/// Columns up a linking surface from source to target, each as steps + 1 points at even shares of the way:
/// its side lines, on the exact curves. Without them, ways up the walls by their harmonic map from eight
/// places of the source's rim; straight ones where the walls are hardly longer than those.
/// @throw Cancelled
/// @cost  near linear in the walls' facets where the map is needed.
std::vector<std::vector<Vec3>> wall_columns(const topology::OpenVolume& volume, const LinkingSurface& link,
                                            int steps, const RunContext& context = {},
                                            double hardly_longer = kHardlyLonger);

/// Whether the walls, by their length in the mean, bend on the way at all.
bool walls_bend(const topology::OpenVolume& volume, const LinkingSurface& link);

} // namespace lacuna::surface
