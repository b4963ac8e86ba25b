// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/detail/known_links.h>
#include <lacuna/sweep/sweep.h>
#include <lacuna/topology/open_volume.h>

#include <optional>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// Layers that stand nearer to each other where the way bends.
struct DrawnLayers {
    std::vector<double> heights; ///< rising to 1, as `LayerSpec::heights`
    std::string report;          ///< one line for a person
};

/// Counted layers of a sealed volume, drawn to the bends of its way.
///
/// The way is the middle of the walls' columns. A layer is the lower the more the way turns within about one
/// even layer; no layer is more than twice its neighbour, nor four times the lowest. Of a few such plans from
/// mild to strong, one is taken where it saves enough volume: the way's, with flat sections that stand
/// across it and straight sides between them.
/// @return  nothing where even layers lose little more; where anything but a count says where layers lie
///          (heights, a bias, boundary layers of an end, walls that keep their nodes, neighbours in an
///          assembly); and where `curvature` is 0.
/// @throw Cancelled
/// @cost  walls with side lines: a walk along these; others: a harmonic map of them.
std::optional<DrawnLayers> drawn_layers(const topology::OpenVolume& volume, const SweepOptions& options,
                                        KnownLinks& links, const RunContext& context = {});

} // namespace lacuna::sweep
