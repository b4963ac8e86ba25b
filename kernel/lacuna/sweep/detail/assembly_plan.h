// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/detail/periodic.h>
#include <lacuna/topology/shared/give_mesh.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace lacuna::sweep {

/// Decisions over a whole assembly before meshing.
struct AssemblyPlan {
    std::vector<std::vector<topology::EdgeNodes>> nodes; ///< for each member's shared edges
    std::vector<int> layers; ///< for each member that shares faces; 0: not constrained
    /// For each member, heights of its layers from the source: see `AssemblyLevels::heights()`.
    std::vector<std::vector<double>> heights;
};

/// Numbers of sides for all edges of an assembly (`EdgeCounts`), and the nodes of shared edges.
///
/// Nodes are evenly spaced, with three exceptions:
/// - Beside narrow places of a source, nodes follow the size there, also on all edges that need the same
///   number of sides (a class of `EdgeCounts`).
/// - On side lines, nodes follow the layers.
/// - Where rows of boundary layers end on an edge, the edge has nodes at the heights of the rows.
///
/// Edges of faces shared with an unswept volume are treated as shared edges. Side lines on such faces, and on
/// walls that are a part of another member's end, have a node at each vertex.
/// @param shared  the faces that two members share.
/// @param beside  the faces shared with volumes that are not swept: index of the member, and its face.
/// @param periodic  the faces whose meshes are images of each other.
/// @throw NotSweepable "assembly.layers"  different numbers of layers are requested for members whose side
///         lines must have equal numbers of sides; "assembly.layers_differ"  rows of two members end on one
///         edge with different heights; "assembly.layers_rows"  an edge has too few sides for the rows that
///         end on it. The message names the members and faces.
/// @throw InvalidInput "sweep.periodic_given"  the given nodes of an edge and of its image differ.
AssemblyPlan plan_assembly(std::span<const AssemblyMember> members, std::span<const SharedFace> shared,
                           std::span<const std::pair<std::size_t, FaceId>> beside = {},
                           std::span<const PeriodicFaces> periodic = {}, const RunContext& context = {});

} // namespace lacuna::sweep
