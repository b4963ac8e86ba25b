// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/detail/known_links.h>
#include <lacuna/sweep/sweep.h>
#include <lacuna/topology/open_volume.h>

#include <optional>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// Layers that are thinner in the bends of a sweep.
struct DrawnLayers {
    std::vector<double> heights; ///< increasing to 1, as `LayerSpec::heights`
    std::string report;          ///< one line for the user
};

/// Layers of a sealed volume with a given count, concentrated in the bends of its axis.
///
/// The axis is the mean of the walls' columns. Layers are thinner where the axis turns by more per uniform
/// layer. A layer is at most twice as high as its neighbour, and at most four times as high as the thinnest
/// layer. Increasing concentrations are tried; each replaces the previous choice if it reduces the volume
/// error by enough. The error is that of flat sections normal to the axis, joined by straight sides.
/// @return  empty if uniform layers are nearly as accurate, if `curvature` is 0, or if the layers are fixed
///     by heights, a bias, boundary layers of an end, walls that keep their nodes, or neighbours in an
///     assembly.
/// @throw Cancelled
/// @note  Cost: for walls with side lines, a walk along these; for others, a harmonic map of each.
std::optional<DrawnLayers> drawn_layers(const topology::OpenVolume& volume, const SweepOptions& options,
                                        KnownLinks& links, const RunContext& context = {});

} // namespace lacuna::sweep
