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
    std::vector<int> layers; ///< for each member with others beside it; 0: not constrained
    /// For each member, heights of its layers from the source: see `AssemblyLevels::heights()`.
    std::vector<std::vector<double>> heights;
};

/// Numbers of sides for all edges of an assembly (interval assignment), and the nodes of shared edges.
///
/// Edges that need equal numbers form one class: the same edge in two members; an edge of a source's rim and
/// its image on the target's; the side lines of a member; opposite edges of a four-sided wall. A class gets
/// the requested number, otherwise the largest number that one of its edges needs by the size. If an end with
/// only shared edges has an odd total of sides, its longest class gets one more. Nodes are evenly spaced;
/// those of side lines follow the layers, and where rows of boundary layers end on an edge, nodes lie at the
/// rows' heights. Edges of faces that a member shares with one that is not swept get their nodes as shared
/// edges do, and side lines on such faces have a node at each of their vertices.
/// @param beside  the faces that a member shares with a volume that is not swept: index of the member, and
///        the face in it.
/// @throw NotSweepable "assembly.layers"  different numbers of layers requested in members whose side lines
///        are in one class; "assembly.layers_differ"  different rows of two members that end on one edge;
///        "assembly.layers_rows"  more rows on an edge than it has sides. Names them.
/// @throw InvalidInput "sweep.periodic_given"  given nodes of an edge that differ from those of its image.
AssemblyPlan plan_assembly(std::span<const AssemblyMember> members, std::span<const SharedFace> shared,
                           std::span<const std::pair<std::size_t, FaceId>> beside = {},
                           std::span<const PeriodicFaces> periodic = {}, const RunContext& context = {});

} // namespace lacuna::sweep
