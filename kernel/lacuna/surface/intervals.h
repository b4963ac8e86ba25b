// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/linking_surface.h>
#include <lacuna/surface/requests.h>
#include <lacuna/surface/seeds.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// What intervals ask of a volume.
struct IntervalDemands {
    std::vector<SidesAsked> sides; ///< on the source's edges
    struct Layers {
        int count = 1;
        double bias = 1; ///< last over first, from the source [-]
        std::string name;
        bool from_named_source = false; ///< `bias` counts from the source as the person named it
    };
    std::optional<Layers> layers;
};

/// Find the edges of a volume that intervals are for. What is asked of the target's rim is asked of what is
/// swept there, and what is asked of a line up the walls is asked of the layers.
/// @throw InvalidInput "surface.no_such_edge"  an edge or a vertex that the volume does not have, vertices
///        that no edge or several join, an edge that counts cannot be given for by itself.
/// @throw NotSweepable "surface.sides_asked"  two numbers of layers.
IntervalDemands find_intervals(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                               std::span<const Interval> intervals);

} // namespace lacuna::surface
