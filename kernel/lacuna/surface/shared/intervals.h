// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/requests.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/shared/seeds.h>

#include <optional>
#include <span>
#include <vector>

namespace lacuna::surface {

/// The numbers of sides and layers that intervals request.
struct IntervalDemands {
    std::vector<SidesAsked> sides; ///< on the source's edges
    struct Layers {
        int count = 1;
        double bias = 1;                ///< last over first, from the source [-]
        Argument name;                  ///< origin, for messages
        bool from_named_source = false; ///< whether `bias` counts from the end that the user named source,
                                        ///< not from the end where the sweep starts
    };
    std::optional<Layers> layers;
};

/// Find the edges of a volume to which intervals apply. Intervals on the target's rim apply to the part of
/// the source's rim that is swept there, and intervals on a side line apply to the layers.
/// @throw InvalidInput "surface.no_such_edge"  an edge or a vertex that the volume does not have, vertices
///        joined by no edge or by several, an edge whose count cannot be set on its own.
/// @throw NotSweepable "surface.sides_asked"  two numbers of layers.
IntervalDemands find_intervals(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                               std::span<const Interval> intervals);

} // namespace lacuna::surface
