// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/boundary_layers.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/sweep/detail/size_words.h>
#include <lacuna/sweep/sweep.h>

#include <vector>

namespace lacuna::sweep {

/// Reverse the heights, which run from 0 to 1 or cover a part of this range, so that they count from the
/// other end.
void reverse_heights(std::vector<double>& heights);

/// Heights of layers, and whether only bends of the columns determined their number.
struct PlannedHeights {
    std::vector<double> heights;
    bool by_bends = false;
};

/// Heights of the layers between source and target, as fractions of the columns' length.
///
/// Layers with a count are spread as in `LayerSpec`. Otherwise they are about as high as the quads are wide,
/// measured along the walls (`surface::wall_columns()`), and no fewer than the columns' bends require at
/// `curvature` per full turn. If the size varies along the sweep, their number and heights divide the
/// cumulative number of sides evenly, averaged over the columns. Boundary layers of the ends come first and
/// last, and the others share the remaining length.
/// @param asked  result of `LayerSpec` for a count or heights, from the source; empty: not requested.
/// @param sizes  of the source's quads, and layers for the walls' bends.
/// @param least  minimum number of layers for the walls.
/// @throw InvalidInput  too many layers to number; boundary layers of ends together with heights, or
///                      with fewer layers than they have.
/// @throw NotSweepable "sweep.layers_room"  ends closer to each other than their boundary layers are high.
PlannedHeights plan_heights(const topology::OpenVolume& volume,
                            const std::vector<surface::LinkingSurface>& links,
                            const surface::LayerTables& tables, const std::vector<double>& asked,
                            const SourceSize& sizes, const SweepOptions& options, int least,
                            const RunContext& context);

} // namespace lacuna::sweep
