// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/given_nodes.h>
#include <lacuna/surface/linking_surface.h>

#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// Nodes round a linking surface, in walking order from its start; the first is not repeated.
struct LinkingNodes {
    std::vector<double> source_at; ///< running length on the source chain
    std::vector<double> target_at; ///< running length on the target chain
    std::vector<std::size_t> line; ///< node at the foot of each side line
};

/// Nodes at given shares of each segment, rising from 0 and below 1: as many on the target as on the source.
LinkingNodes linking_nodes(const LinkingSurface& link, std::span<const std::vector<double>> source,
                           std::span<const std::vector<double>> target);

/// A structured quad mesh on the walls of a linking surface.
struct WallMesh {
    std::vector<Vec3> points; ///< (layers + 1) × nodes, layer-major from the source
    std::vector<FaceId> face; ///< wall of each quad: layer · nodes + i, the quad from node i to node i + 1
    std::vector<std::string> notes;
};

/// Mesh the walls of all linking surfaces: one row of quads a layer.
///
/// A part between two side lines that is one face is meshed transfinitely in arc length and projected onto
/// the face (paper sect. 7; for void faces Algorithms 5 and 6). Other parts (several faces stacked or in a
/// row, or no side line at all) are meshed by the harmonic map of the linking surface. There edges between
/// faces are followed: those that run round lie on a layer, those that run up on a column, and where they
/// meet, turn or end a node stands; the other nodes are moved as a harmonic field over the grid says, so
/// that layers and columns bend towards them. Void faces that follow the given walls come last: two affine
/// fits a row say where the rows of the other walls lead their nodes, so that rows stay level round the
/// volume.
///
/// Columns of given nodes are taken as they are, and the quads between them with them.
/// @param nodes    of each linking surface.
/// @param columns  of each linking surface; empty: none.
/// @param heights  layers + 1 numbers from 0 to 1.
/// @throw NotSweepable "surface.too_few_layers"  more such edges than layers; names one, and the layers that
///         would do. "surface.wall_edge": an edge between two walls that no layer and no column
///         can follow.
/// @post  nodes on given faces and edges lie on the exact geometry; rows 0 and last are points of the rims.
std::vector<WallMesh> mesh_walls(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                                 std::span<const LinkingNodes> nodes, std::span<const double> heights,
                                 std::span<const GivenColumns> columns = {}, const RunContext& context = {});

/// The same with nodes on the facets of given walls and near void ones: close enough to see where columns
/// lead, and sooner.
std::vector<WallMesh> mesh_walls_on_facets(const topology::OpenVolume& volume,
                                           std::span<const LinkingSurface> links,
                                           std::span<const LinkingNodes> nodes,
                                           std::span<const double> heights, const RunContext& context = {});

} // namespace lacuna::surface
