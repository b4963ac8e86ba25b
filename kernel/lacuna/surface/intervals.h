// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/boundary_layers.h>
#include <lacuna/surface/linking_surface.h>
#include <lacuna/surface/seeds.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// A number of sides of quads that a person asks for.
struct Interval {
    /// On what: an edge by its tag, the edge between two vertices by theirs, the rim of walls, the sweep.
    enum class Of { edge, vertices, wall, sweep };
    Of of = Of::sweep;
    int edge = 0;
    std::array<int, 2> vertices{};
    FaceNames walls; ///< the sides over all of them: as many columns of quads
    int count = 1;   ///< >= 1
    /// Last over first length, > 0 [-]: as the edge runs, from the first vertex to the second, from source to
    /// target; of walls 1.
    double bias = 1;
};

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
