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

/// Numbers of sides for all edges of an assembly (interval assignment), and the nodes of shared edges.
///
/// Edges that need equal numbers of sides form one class: an edge that several members have; an edge of a
/// source's rim and its image on the target's rim; the side lines of a member; opposite edges of a four-sided
/// wall. A class gets the requested number of sides; without a request, the largest number that the size
/// requires for one of its edges. If an end with only shared edges has an odd number of sides, its longest
/// class gets one more side.
///
/// Nodes are evenly spaced, except on side lines, where they follow the layers, and where rows of boundary
/// layers end on an edge, which needs nodes at the rows' heights. Edges of faces shared with an unswept
/// volume are treated as shared edges. Side lines on such faces, and on walls that are a part of another
/// member's end, have a node at each vertex.
/// @param beside  the faces shared with volumes that are not swept: index of the member, and its face.
/// @throw NotSweepable "assembly.layers"  members whose side lines are in one class request different numbers
///         of layers; "assembly.layers_differ"  rows of two members end on one edge with different heights;
///         "assembly.layers_rows"  an edge has too few sides for the rows that end on it. The message names
///         the members and faces.
/// @throw InvalidInput "sweep.periodic_given"  the given nodes of an edge and of its image differ.
AssemblyPlan plan_assembly(std::span<const AssemblyMember> members, std::span<const SharedFace> shared,
                           std::span<const std::pair<std::size_t, FaceId>> beside = {},
                           std::span<const PeriodicFaces> periodic = {}, const RunContext& context = {});

} // namespace lacuna::sweep
