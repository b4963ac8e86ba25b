// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/partition.h>
#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <vector>

namespace lacuna::closure {

/// Find ends between which a piece can be swept, and set its roles. @return whether there are such ends.
bool find_ends(StepPiece& piece, const CanSweep& can_sweep, const RunContext& context);

/// Divide a volume at its middle; empty if that is not possible, or makes more than `most` pieces.
std::vector<StepPiece> divided_at_middle(const topology::OpenVolume& volume, std::size_t most,
                                         const CanSweep& can_sweep, const RunContext& context);

/// Cut a volume along an edge between coplanar faces, perpendicular to these faces; an earlier cut ended at
/// such an edge. A part without ends is divided at its middle. Empty if no cut gives parts that can be swept
/// or divided in this way.
std::vector<StepPiece> divided_at_flat_edge(const topology::OpenVolume& volume, std::size_t most,
                                            const CanSweep& can_sweep, const RunContext& context);

/// Cut a volume by a plane through two edges at a vertex with four to six edges, such as the apex of a
/// pyramid. Parts without ends are cut again, or divided at their middles. Empty if no plane cuts the volume,
/// or the first that does leaves a part that cannot be divided.
std::vector<StepPiece> divided_at_vertices(const topology::OpenVolume& volume, std::size_t most,
                                           const CanSweep& can_sweep, const RunContext& context);

/// Normals of the flat faces of a volume, those with the largest area first. Parallel normals are listed
/// once.
/// @param both  whether flat faces must face in both directions along a normal.
std::vector<Vec3> axes_of(const topology::OpenVolume& volume, bool both);

/// Cut a volume across an axis where smooth parts of its skin turn over, so that each such part becomes an
/// end above the cut and one below. Examples: the room around a ring that lies in a cup, or around an egg in
/// its box. Empty if no axis gives parts that can be swept or divided at their middles.
std::vector<StepPiece> divided_where_turning(const topology::OpenVolume& volume, std::size_t most,
                                             const CanSweep& can_sweep, const RunContext& context);

/// Cut a volume by three planes at right angles through the centre of a sphere or the apex of a cone, or, if
/// there are none, through the mean of its vertices. Example: a ball is cut into octants. A part without ends
/// is divided at its middle. Empty if no centre gives parts that can be swept or divided in this way.
std::vector<StepPiece> divided_at_centre(const topology::OpenVolume& volume, std::size_t most,
                                         const CanSweep& can_sweep, const RunContext& context);

/// Cut a body of revolution with a bore around its axis into two halves, which are swept around the axis.
/// Example: a ring with a hollow in the shape of a torus. Empty for other volumes, or if the halves cannot be
/// swept.
std::vector<StepPiece> divided_through_axis(const topology::OpenVolume& volume, const CanSweep& can_sweep,
                                            const RunContext& context);

} // namespace lacuna::closure
