// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/flat_ends.h>
#include <lacuna/surface/shared/imprint.h>

#include <span>
#include <unordered_set>
#include <vector>

/// Closed paths along the sides of quads. Internal to this folder.
namespace lacuna::surface {

/// The border of a block of `i` by `j` quads that fits a closed line best, with as many nodes as the line.
///
/// A closed line inside a mesh that must not change is represented by sides of the mesh: on the opposite end,
/// the nodes of the block's border move onto the line. This is the first step of grafting, S. R. Jankovich,
/// S. E. Benzley, J. F. Shepherd, S. A. Mitchell, "The graft tool: an all-hexahedral transition algorithm for
/// creating a multi-directional swept volume mesh" (1999). Departure: no layer of quads is inserted inside
/// the border, so the mesh stays as it is. All blocks with `i` + `j` equal to half the number of nodes are
/// compared by the sum of the squares of the distances between corresponding nodes. The mesh may have a hole
/// inside the block.
/// @param quads  of a mesh, consistently oriented.
/// @param place  positions of the nodes in the plane, in which the quads run counter-clockwise.
/// @param line   positions of the line's nodes, an even number, in either direction.
/// @param taken  nodes that must not lie on the path.
/// @return  a node of the mesh for each node of the line. Empty if no block with so many nodes lies inside
///          the mesh, away from its border, where the mesh is a grid.
/// @note  O(quads + n³) for n nodes of the line, and O(n²) for each block whose middle is near the line's.
std::vector<Index> path_around(const std::vector<Quad>& quads, std::span<const Vec2> place,
                               std::span<const Vec2> line, const std::unordered_set<Index>& taken = {});

/// A side of a path, and the part of the line that it represents.
struct PathSide {
    Index from = -1, to = -1; ///< points of the model
    EdgeImage image;
};

/// Sides of quads of the source that represent a closed line of the target. The nodes of the line are those
/// of its edges; an edge without given nodes gets sides as long as those of the quads.
/// @param place  positions of the model's points in the plane, as parts of the source.
/// @return  empty if no path fits.
std::vector<PathSide> path_along(const topology::Model& model, const EndsMap& map,
                                 const std::vector<Quad>& quads, std::span<const Vec2> place,
                                 std::span<const topology::EdgeUse> line,
                                 const std::unordered_set<Index>& taken);

} // namespace lacuna::surface
