// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/boundary_layers.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/sweep/detail/size_words.h>
#include <lacuna/sweep/sweep.h>

#include <vector>

namespace lacuna::sweep {

/// Reverse heights, so that they count from the other end. They run from 0 to 1, or cover a part of this
/// range.
void reverse_heights(std::vector<double>& heights);

/// Heights of layers, and whether their number is determined by bends of the columns alone.
struct PlannedHeights {
    std::vector<double> heights;
    bool by_bends = false;
};

/// Heights of the layers between source and target, as fractions of the columns' length.
///
/// If the number of layers is given, heights are distributed as in `LayerSpec`. Otherwise layers are about as
/// high as the quads are wide, measured along the walls (`surface::wall_columns()`), and there are at least
/// as many as the columns' bends require at `curvature` per full turn. If the size varies along the sweep,
/// the layers divide the cumulative number of sides evenly, averaged over the columns. Boundary layers of the
/// ends come first and last; the other layers share the remaining length.
/// @param asked  requested heights, or those of a requested number of layers, counted from the source; empty:
///         neither is requested.
/// @param sizes  sizes of the source's quads, and the number of layers that bends of the walls require.
/// @param least  minimum number of layers for the walls.
/// @throw InvalidInput  there are too many layers to number, or boundary layers of ends are combined with
///         heights, or with fewer layers than they have.
/// @throw NotSweepable "sweep.layers_room"  the ends are too close to each other for their boundary layers.
PlannedHeights plan_heights(const topology::OpenVolume& volume,
                            const std::vector<surface::LinkingSurface>& links,
                            const surface::LayerTables& tables, const std::vector<double>& asked,
                            const SourceSize& sizes, const SweepOptions& options, int least,
                            const RunContext& context);

} // namespace lacuna::sweep
