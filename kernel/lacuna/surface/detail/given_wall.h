// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/walls.h>

#include <vector>

/// What of a wall's grid came with a mesh. Internal to this folder.
namespace lacuna::surface {

struct GivenWall {
    static constexpr Index kNotGiven = -1, kBetweenGiven = -2;

    std::size_t count = 0;   ///< nodes of a row
    std::vector<Index> node; ///< model point that a node is, by layer · count + node, or one of the two
    std::vector<char> side;  ///< given quads, by layer · count + node

    [[nodiscard]] bool has_node(std::size_t layer, std::size_t at) const
    {
        return node[layer * count + at % count] != kNotGiven;
    }
    [[nodiscard]] bool has_sides() const;
    /// Whether all quads between two nodes of the rim are given.
    [[nodiscard]] bool has_all(std::size_t first, std::size_t last) const;
};

/// A wall's grid with the nodes and quads that were given, the others still to be placed.
struct BegunWall {
    WallMesh mesh;
    GivenWall given;
};

/// @throw NotSweepable "surface.wall_rows"  given quads have no node on the rim opposite; names the wall.
BegunWall begin_wall(const topology::Model& model, const LinkingSurface& link, const LinkingNodes& nodes,
                     const GivenColumns& columns, std::size_t layers);

} // namespace lacuna::surface
