// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Whether an end of a volume lies at several heights: its faces are parts that hang together by walls alone.
bool has_steps(const topology::OpenVolume& volume);

/// A piece of a volume with steps.
struct StepPiece {
    topology::OpenVolume volume;
    int level = 0; ///< 0: it goes from end to end as the whole does; else above so many steps
};

/// Cut a volume whose source or target lies at several heights into pieces that can be swept, one for each
/// part of that end.
///
/// Where walls join two parts of the end, void faces hang from their upper rim, straight along the sweep, to
/// the opposite end, and its faces are split there. The pieces keep the given faces with their tags; the void
/// faces between two of them are both's, so that `sweep::sweep_assembly()` makes one mesh of them. Pieces are
/// open volumes like others, to be classified, closed and swept by themselves.
/// @return  those of level 0 first; the volume itself where its ends have no steps.
/// @throw NotSweepable "closure.steps"  steps at both ends; a step whose walls reach the opposite end, or
///         whose rim is not closed or does not lie below one face of the opposite end; no opposite end; names
///         the faces.
/// @note  O(facets log facets). The direction is that of the stepped end's mean normal.
std::vector<StepPiece> cut_steps(const topology::OpenVolume& volume, const RunContext& context = {});

} // namespace lacuna::closure
