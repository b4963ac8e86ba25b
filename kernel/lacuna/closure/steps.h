// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Whether an end of a volume lies at several heights: its faces are parts that do not hang together, or the
/// skin turns towards the void by more than 45° at a rim of it.
bool has_steps(const topology::OpenVolume& volume, const RunContext& context = {});

/// A piece of a volume that was cut.
struct StepPiece {
    topology::OpenVolume volume;
    int level = 0; ///< 0: it goes from end to end as the whole does; else above so many steps
    /// Of a full turn: where the piece is, as shares of the turn in [0, 1]; else all of it.
    double turn_from = 0, turn_to = 1;
};

/// Cut a volume whose source, target or both lie at several heights into pieces that can be swept.
///
/// Where the walls at a rim of an end go away from the opposite end, void faces hang from it, straight
/// along the sweep, to that end, whose faces are split there; first from the source, then from the target.
/// Rims that end at other walls are cut by the planes of the flat walls at them; pieces shorter than others
/// have higher levels. Where nothing can
/// hang, as from rims that lie above each other, the planes of all flat steps cut the volume in layers. A
/// missing opposite end is made of the one loop that is open. The pieces keep the given faces with their
/// tags; the void faces between two of them are both's, so that `sweep::sweep_assembly()` makes one mesh of
/// them. Pieces are open volumes like others, to be classified, closed and swept by themselves.
/// @return  those of level 0 first; the volume itself where its ends have no steps.
/// @throw NotSweepable "closure.steps"  a step whose rim does not lie below one face of the opposite end, or
///         that ends at other walls and is not flat; an end in several places that no walls join; names the
///         faces.
/// @note  O(facets log facets) a step. The direction is that of the stepped end's mean normal.
std::vector<StepPiece> cut_steps(const topology::OpenVolume& volume, const RunContext& context = {});

} // namespace lacuna::closure
