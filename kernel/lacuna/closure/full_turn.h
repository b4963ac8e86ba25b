// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Cut a ring, a volume of walls alone that runs round its whole turn, in two across.
///
/// The plane goes through the middle of the walls. Of those through one of their three main axes, by the
/// second moments of their area, in eight directions from a vertex on, it is the one that crosses the
/// walls along the shortest lines and leaves two pieces with both cuts as ends. Each piece is the other's
/// neighbour at both ends, so that `sweep::sweep_assembly()` makes one mesh of them that runs into itself.
/// Where walls are missing, straight void edges lead across each gap, and each piece closes its part.
/// @return  two pieces, whose `turn_from` and `turn_to` are their share of the turn by the length of the way
///          round, along the middles of the walls' sections.
/// @throw NotSweepable "closure.full_turn"  no such plane; says what came of the shortest.
///         InvalidInput "closure.full_turn_ends"  a source or a target; names it.
/// @note  O(facets · directions), and a cut for each plane tried.
std::vector<StepPiece> cut_full_turn(const topology::OpenVolume& volume, const RunContext& context = {});

} // namespace lacuna::closure
