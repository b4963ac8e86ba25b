// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/detail/known_links.h>
#include <lacuna/sweep/sweep.h>
#include <lacuna/topology/open_volume.h>

#include <optional>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// Layers that are closer together in the bends of a sweep.
struct DrawnLayers {
    std::vector<double> heights; ///< increasing to 1, as `LayerSpec::heights`
    std::string report;          ///< one line for a person
};

/// Layers of a sealed volume with a given count, concentrated in the bends of its axis.
///
/// The axis is the mean of the walls' columns. A layer is the lower the more the axis turns within about one
/// even layer; no layer is more than twice as high as its neighbour, or four times as high as the lowest. Of
/// several such distributions, from weak to strong, one is used if it reduces the volume error enough. The
/// error is computed for the axis, with flat sections normal to it and straight sides between them.
/// @return  nothing if even layers lose little more; if heights, a bias, boundary layers of an end, walls
///          that keep their nodes, or neighbours in an assembly determine the layers; and if `curvature` is
///          0.
/// @throw Cancelled
/// @cost  walls with side lines: a walk along these; others: a harmonic map of them.
std::optional<DrawnLayers> drawn_layers(const topology::OpenVolume& volume, const SweepOptions& options,
                                        KnownLinks& links, const RunContext& context = {});

} // namespace lacuna::sweep
