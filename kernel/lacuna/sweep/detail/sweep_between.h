// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/sweep/detail/both_ways.h>
#include <lacuna/sweep/detail/mean_outline.h>
#include <lacuna/sweep/detail/size_words.h>
#include <lacuna/sweep/sweep.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::sweep {

/// What the mesh's shape is to be: in an assembly, without the nodes and meshes of neighbours.
const topology::OpenVolume& shape_of(const topology::OpenVolume& volume, const SweepOptions& options);

/// Seeds, quads, walls, target, layers and proof between the rims of linking surfaces that say what goes with
/// what.
/// @param asked  heights of the layers from 0 to 1, from the source on; empty: nobody asked.
/// @throw  as `sweep()`; what a proof finds is no error here, but in the result.
ProvedSweep sweep_between(const topology::OpenVolume& volume,
                          std::vector<surface::LinkingSurface> given_links, const std::vector<double>& asked,
                          const SourceSize& sizes, const SweepOptions& options, Outline outline,
                          const RunContext& context);

} // namespace lacuna::sweep
