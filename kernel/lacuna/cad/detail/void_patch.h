// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/detail/spline_patch.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::cad {

/// Spline surfaces over a void face with four logical sides: a Coons patch between its sides as exactly as
/// they are known, bent to where the facets are wherever those are further off than their chords make them.
/// One surface between each pair of vertices across, so that every surface is smooth.
///
/// Straight sides give the ruled surface between source and target: a missing half of a cylinder comes back
/// as that half.
/// @param sides      of the face's loop, in walking order: source, side, target, side.
/// @param precision  to which sides are met [model length].
std::vector<SplineSurface> void_patches(const topology::Model& model, const topology::Face& face,
                                        const std::vector<std::vector<topology::EdgeUse>>& sides,
                                        double precision);

} // namespace lacuna::cad
