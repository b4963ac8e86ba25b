// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Cut a full-turn ring, a volume that consists of walls only, across in two places.
///
/// The plane contains the centroid of the walls and one of their three principal axes (second moments of
/// area). Eight directions about that axis are tried, the first through a vertex. The chosen plane crosses
/// the walls along the shortest lines and leaves two pieces with both cuts as ends. The pieces share both
/// cuts, so `sweep::sweep_assembly()` makes one mesh that closes on itself. Where walls are missing, straight
/// void edges cross each gap, and each piece closes its part.
/// @return  two pieces, whose `turn_from` and `turn_to` are their share of the turn, by arc length along the
///         centroids of the sections.
/// @throw NotSweepable "closure.full_turn"  no such plane; reports the result of the shortest cut.
///         InvalidInput "closure.full_turn_ends"  a face is not a wall; names it.
/// @note  O(facets · directions), and a cut for each plane tried.
std::vector<StepPiece> cut_full_turn(const topology::OpenVolume& volume, const RunContext& context = {});

} // namespace lacuna::closure
