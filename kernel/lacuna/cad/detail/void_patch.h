// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/detail/spline_patch.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::cad {

/// Spline surfaces for a void face with four logical sides: a Coons patch between its sides, each taken from
/// the exact curve if there is one. Where facets are farther from the patch than their chord error explains,
/// the patch is fitted to them. It is split at the vertices and kinks of its sides, so every surface is
/// smooth.
///
/// Straight sides give the ruled surface between source and target: the missing half of a cylinder becomes
/// exactly that half.
/// @param sides      of the loop of the face, in order: source, side, target, side.
/// @param precision  how closely the sides are met [model length].
std::vector<SplineSurfaceData> void_patches(const topology::Model& model, const topology::Face& face,
                                            const std::vector<std::vector<topology::EdgeUse>>& sides,
                                            double precision);

} // namespace lacuna::cad
