// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Cut a ring (a full turn, walls only) across in two places.
///
/// The plane contains the centroid of the walls and one of their three principal axes (second moments of
/// area). Eight directions about each axis are tried, the first through a vertex. Of the planes that leave
/// two pieces whose ends are the two cuts, the one with the shortest section is chosen. Both pieces share
/// both cuts, so `sweep::sweep_assembly()` makes one mesh that closes on itself. If the plane crosses a gap
/// between walls, a straight void edge bridges the gap there, and each piece closes its part of the gap.
/// @return  two pieces. Their `turn_from` and `turn_to` are measured by arc length along the centroids of the
///         sections.
/// @throw NotSweepable "closure.full_turn"  there is no such plane; reports into how many pieces the plane
///         with the shortest section cuts the ring. InvalidInput "closure.full_turn_ends" a face is not a
///         wall; names it.
/// @note  O(facets · directions), and a cut for each plane tried.
std::vector<StepPiece> cut_full_turn(const topology::OpenVolume& volume, const RunContext& context = {});

} // namespace lacuna::closure
