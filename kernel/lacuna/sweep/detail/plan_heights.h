// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/boundary_layers.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/sweep/detail/size_words.h>
#include <lacuna/sweep/sweep.h>

#include <vector>

namespace lacuna::sweep {

/// Heights of layers, and whether bends of the columns alone made them so many.
struct PlannedHeights {
    std::vector<double> heights;
    bool by_bends = false;
};

/// Heights of the layers between source and target, as shares of the columns' length.
///
/// Layers that are counted are spread as `LayerSpec` says. Others are about as high as the quads are wide,
/// measured along the walls (`surface::wall_columns()`), and no fewer than the columns' bends ask for at
/// `curvature` a full turn; where the size asked for changes along the sweep they follow it: their number and
/// heights divide the sides it asks for evenly, in the mean over the columns. Boundary layers of the ends
/// come first and last, and the rest shares what they leave.
/// @param asked  what `LayerSpec` makes of a count or of heights, from the source; empty: none are asked for.
/// @param sizes  of the source's quads, and layers for the walls' bends.
/// @param least  layers that the walls need.
/// @throw InvalidInput  more layers than can be numbered; boundary layers of ends together with heights, or
///                      with fewer layers than they have.
/// @throw NotSweepable "sweep.layers_room"  ends closer to each other than their boundary layers are high.
PlannedHeights plan_heights(const topology::OpenVolume& volume,
                            const std::vector<surface::LinkingSurface>& links,
                            const surface::LayerTables& tables, const std::vector<double>& asked,
                            const SourceSize& sizes, const SweepOptions& options, int least,
                            const RunContext& context);

} // namespace lacuna::sweep
