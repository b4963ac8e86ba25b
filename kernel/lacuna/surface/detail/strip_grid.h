// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/given_wall.h>
#include <lacuna/surface/detail/wall_net.h>

#include <map>
#include <span>
#include <vector>

/// A wall's grid in the strip onto which its linking surface is mapped. Internal to this folder.
namespace lacuna::surface {

/// Inputs of the grid.
struct StripTask {
    const topology::Model& model;
    const LinkingSurface& link;
    const LinkingNodes& nodes;
    std::span<const double> heights; ///< layers + 1, from 0 to 1
    std::span<const int> line_of;    ///< for each node of the rim, its side line; -1: none
    const BegunWall& begun;
};

struct StripGrid {
    struct Pinned {
        EdgeId edge;
        double share; ///< fraction of the edge's length
        Vec2 place;   ///< position in the strip
    };
    std::vector<Vec2> place;               ///< position of each node, at layer · nodes + node
    std::map<std::size_t, Pinned> on_edge; ///< for each node on an edge: the edge and the position on it
    std::vector<std::size_t> stops;        ///< for each stop of the net, its node
};

/// Lay the grid into the strip. At first, columns are vertical and layers follow the plain rings. Then nodes
/// are moved onto the net's stops, and the displacement of the other nodes is harmonic over the grid.
/// @param map  map of the linking surface; null if the side lines alone determine the positions.
/// @throw NotSweepable "surface.too_few_layers", "surface.wall_edge", "surface.wall_rows"  as `mesh_walls()`.
StripGrid lay_strip(const StripTask& task, const LinkingMap* map, const WallNet& net,
                    const RunContext& context);

} // namespace lacuna::surface
