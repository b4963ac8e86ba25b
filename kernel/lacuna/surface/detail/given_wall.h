// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/walls.h>

#include <vector>

/// The part of a wall's grid that has a given mesh. Internal to this folder.
namespace lacuna::surface {

/// The given nodes and quads of the grid on a linking surface.
struct GivenWall {
    /// `kBetweenGiven`: a node between two given columns, which splits the given quads there.
    static constexpr Index kNotGiven = -1, kBetweenGiven = -2;

    std::size_t count = 0; ///< number of nodes in a row
    /// For node i of a layer, at layer · count + i: its point of the model, or one of the constants above.
    std::vector<Index> node;
    std::vector<char> side; ///< for the quad from this node to the next one of the layer: whether it is given

    [[nodiscard]] bool has_node(std::size_t layer, std::size_t at) const
    {
        return node[layer * count + at % count] != kNotGiven;
    }
    [[nodiscard]] bool has_sides() const;
    /// Whether all quads between the columns of two nodes of the rim are given, in all rows.
    [[nodiscard]] bool has_all(std::size_t first, std::size_t last) const;
};

/// A wall's grid with its given nodes and quads; the other nodes are not placed yet.
struct BegunWall {
    WallMesh mesh;
    GivenWall given;
};

/// @throw NotSweepable "surface.wall_rows"  a given quad has no node on the opposite rim; names the wall.
BegunWall begin_wall(const topology::Model& model, const LinkingSurface& link, const LinkingNodes& nodes,
                     const GivenColumns& columns, std::size_t layers);

} // namespace lacuna::surface
