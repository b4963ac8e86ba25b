// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <string>
#include <vector>

namespace lacuna::closure {

/// Read anew which faces of closed pieces of a cut are their ends, where one of them cannot be swept between
/// those it has.
///
/// A plane that crosses an end aslant leaves pieces whose cut lies beside what is left of that end. An end is
/// one or more faces that hang together and whose normals differ by less than 110°; two are ends of a piece
/// where each wall runs from one to the other between two neighbours. Of these the pair is taken whose ends
/// are the flattest, the most square to their walls and the most alike; ends that were named count for more,
/// and a cut that is a wall of both pieces beside it has the same sides at the ends of both where it can.
/// @return  how many pieces have other ends than before. Those without such ends, or with faces missing, are
///          left as they are.
/// @throw Cancelled
/// @note  O(ends² · faces) a piece, of at most 600 ends; pieces of more than 40 faces are left as they are.
std::size_t read_ends(std::vector<StepPiece>& pieces, const RunContext& context = {});

/// Whether a closed volume has two ends between which each wall runs, as `read_ends()` wants them; false of
/// more than 40 faces.
bool walls_run_between_ends(const topology::OpenVolume& volume);

/// @param what  the volume, for the message: "volume_2".
/// @throw NotSweepable "closure.no_ends"  a closed volume that lacks a source or a target; names its faces.
void check_ends(const topology::OpenVolume& volume, const std::string& what);

} // namespace lacuna::closure
