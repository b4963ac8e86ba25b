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
    std::vector<SidesAsked> sides; ///< requested numbers of sides on the source's edges
    struct Layers {
        int count = 1;
        double bias = 1; ///< ratio of last to first height, from the source [-]
        Argument name;   ///< the request from which it results, for messages
        /// Whether the first height of `bias` is at the end that the user named source; false: at the end
        /// where the sweep starts.
        bool from_named_source = false;
    };
    std::optional<Layers> layers;
};

/// Find the edges of a volume to which intervals apply. An interval on the target's rim applies to the part
/// of the source's rim that is swept there. An interval on a side line applies to the layers.
/// @throw InvalidInput "surface.no_such_edge"  the volume does not have an edge or vertex; two vertices are
///         joined by no edge or by several; or the number of sides of an edge cannot be set separately.
/// @throw NotSweepable "surface.sides_asked"  two different numbers of layers are requested.
IntervalDemands find_intervals(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                               std::span<const Interval> intervals);

} // namespace lacuna::surface
