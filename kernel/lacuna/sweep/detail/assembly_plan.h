// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>
#include <lacuna/topology/shared/give_mesh.h>

#include <span>
#include <vector>

namespace lacuna::sweep {

/// What is decided over a whole assembly before anything is meshed.
struct AssemblyPlan {
    std::vector<std::vector<topology::EdgeNodes>> nodes; ///< of each member's edges that others have too
    std::vector<int> layers; ///< of each member that has others by its side; 0: its own matter
};

/// Numbers of sides for all edges of an assembly together (interval assignment), and the nodes of those that
/// several members have.
///
/// Edges that need the same number make one class: the same edge in two members; an edge of a source's rim
/// and the one of the target's it is swept to; the side lines of a member; opposite edges of a four-sided
/// wall. A class gets the number that was asked for, else the most that any of its edges wants by its size.
/// Where an end of which all edges are shared has an odd number of sides in all, its longest class gets one
/// more. Nodes stand evenly, those of side lines as the layers are spread, and where rows of boundary layers
/// end on an edge, at the rows' heights.
/// @throw NotSweepable "assembly.layers"  other numbers of layers asked for in members whose side lines are
///         of one class; "assembly.layers_differ"  rows of two members that are unlike and end on one edge;
///         "assembly.layers_rows"  more rows on an edge than it has sides. Names them.
AssemblyPlan plan_assembly(std::span<const AssemblyMember> members, std::span<const SharedFace> shared,
                           const RunContext& context = {});

} // namespace lacuna::sweep
