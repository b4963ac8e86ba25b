// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/shared/given_nodes.h>
#include <lacuna/surface/shared/linking_surface.h>

#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// Nodes around a linking surface, in walking order from its start. The first node is not repeated.
struct LinkingNodes {
    std::vector<double> source_at; ///< running length on the source chain
    std::vector<double> target_at; ///< running length on the target chain
    std::vector<std::size_t> line; ///< for each side line, the index of the node at its source end
};

/// Place nodes at given shares of each segment.
/// @param source, target  for each segment, the shares on this rim: increasing, in [0, 1); equally many on
///         both rims.
LinkingNodes linking_nodes(const LinkingSurface& link, std::span<const std::vector<double>> source,
                           std::span<const std::vector<double>> target);

/// A structured quad mesh on the walls of a linking surface.
struct WallMesh {
    std::vector<Vec3> points; ///< (layers + 1) × nodes, layer-major from the source
    /// For each quad, its wall; quad layer · nodes + i lies between nodes i and i + 1.
    std::vector<FaceId> face;
    std::vector<std::string> notes;
};

/// Mesh the walls of all linking surfaces, with one row of quads per layer.
///
/// If the part between two side lines is a single face, it gets a grid by transfinite interpolation in arc
/// length, projected onto the face (section 7 of Roca and Sarrate 2010; for void faces, Algorithms 5 and 6 of
/// @cite mukherjee_2014_open).
///
/// All other parts are meshed by the harmonic map of the linking surface (`LinkingMap`). Layers follow the
/// edges that run around the walls, and columns follow the edges that run along the sweep. A node lies where
/// such edges meet, turn or end. The displacements of these nodes are spread over the grid by a harmonic
/// field, so that all layers and columns bend towards the edges.
///
/// Columns of given nodes and the quads between them are used unchanged.
/// @param nodes    nodes around each linking surface.
/// @param columns  given columns of each linking surface; empty: none.
/// @param heights  layers + 1 numbers from 0 to 1.
/// @param exact    false: nodes lie on the facets of given walls instead of the exact faces, and only close
///         to void walls. This is faster, and accurate enough to find the directions of columns.
/// @throw NotSweepable "surface.too_few_layers"  there are more edges around the walls than layers can
///         follow; names one of them, and a sufficient number of layers; "surface.wall_edge"  neither a layer
///         nor a column can follow an edge between two walls.
/// @post  nodes on given faces and edges lie on the exact geometry; the first and last rows are points of the
///        rims.
std::vector<WallMesh> mesh_walls(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                                 std::span<const LinkingNodes> nodes, std::span<const double> heights,
                                 std::span<const GivenColumns> columns = {}, const RunContext& context = {},
                                 bool exact = true);

/// Check that layers and columns can follow all edges between the walls of a sealed volume.
/// @return the number of vertices between both ends at which a row and a column of nodes have to meet.
///         Example: the corners of a box that stands on a wall.
/// @throw NotSweepable "surface.wall_edge"; or as `linking_surfaces()`. Cancelled
std::size_t check_wall_edges(const topology::OpenVolume& volume, const RunContext& context = {});

/// Positions of the nodes on the target's rim.
std::vector<Vec3> target_points(const LinkingSurface& link, const LinkingNodes& nodes);

} // namespace lacuna::surface
