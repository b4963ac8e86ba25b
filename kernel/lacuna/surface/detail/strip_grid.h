// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/given_wall.h>
#include <lacuna/surface/detail/wall_net.h>

#include <map>
#include <span>
#include <vector>

/// The grid of a linking surface's walls, in the strip of its map (`LinkingMap`). Internal to this folder.
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
    /// A node whose position is fixed on an edge.
    struct Pinned {
        EdgeId edge;
        double share; ///< fraction of the edge's length
        Vec2 place;   ///< position in the strip
    };
    std::vector<Vec2> place;               ///< position of each node, at layer · nodes + node
    std::map<std::size_t, Pinned> on_edge; ///< for each node on an edge: the edge and the position on it
    std::vector<std::size_t> stops;        ///< for each stop of the net, its node
};

/// Place the nodes of the grid in the strip. At first, columns are lines of constant s, and layers follow the
/// rings that meet no other edge of the net (`WallNet::Level::plain`). Then nodes are moved onto the net's
/// stops and edges, and the displacement of all other nodes is a harmonic field over the grid.
/// @param map  map of the linking surface; null if the side lines alone determine the positions.
/// @throw NotSweepable "surface.too_few_layers", "surface.wall_edge", "surface.wall_rows"  as `mesh_walls()`.
StripGrid lay_strip(const StripTask& task, const LinkingMap* map, const WallNet& net,
                    const RunContext& context);

} // namespace lacuna::surface
