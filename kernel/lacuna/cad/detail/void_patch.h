// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/detail/spline_patch.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::cad {

/// Spline surfaces for a void face with four logical sides: a Coons patch between the most exact shapes known
/// of its sides, moved to the facets where these are farther from the patch than their chord error explains.
/// One surface between each pair of opposite vertices, so that every surface is smooth.
///
/// Straight sides give the ruled surface between source and target: the missing half of a cylinder becomes
/// exactly that half.
/// @param sides      of the loop of the face, in order: source, side, target, side.
/// @param precision  how closely the sides are met [model length].
std::vector<SplineSurfaceData> void_patches(const topology::Model& model, const topology::Face& face,
                                            const std::vector<std::vector<topology::EdgeUse>>& sides,
                                            double precision);

} // namespace lacuna::cad
