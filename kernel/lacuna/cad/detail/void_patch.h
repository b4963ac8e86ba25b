// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/detail/spline_patch.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::cad {

/// Spline surfaces for a void face with four logical sides: a Coons patch between its sides, which use exact
/// curves where edges have them. If the facets are farther from the patch than their chord error explains,
/// the patch is fitted to them. The patch is split at the vertices and kinks of its sides, so every surface
/// is smooth.
///
/// Straight sides between source and target give a ruled surface. For the missing half of a cylinder this is
/// exactly that half.
/// @param sides      the four sides of the face's loop, in order; the first lies on the source and the third
///                   on the target.
/// @param precision  allowed deviation along the sides [model length].
std::vector<SplineSurfaceData> void_patches(const topology::Model& model, const topology::Face& face,
                                            const std::vector<std::vector<topology::EdgeUse>>& sides,
                                            double precision);

} // namespace lacuna::cad
