// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Whether an end of a volume is at several heights: its faces form several connected parts, or the skin
/// turns towards the void by more than 45° at one of its rims.
bool has_steps(const topology::OpenVolume& volume, const RunContext& context = {});

/// A piece of a cut volume.
struct StepPiece {
    topology::OpenVolume volume;
    int level = 0; ///< 0: runs from end to end like the whole volume; otherwise the number of steps below it
    /// For a full turn: range of the piece, as shares of the turn in [0, 1].
    double turn_from = 0, turn_to = 1;
};

/// Cut a volume whose source, target or both are at several heights into pieces that can be swept.
///
/// Where the walls at a rim of an end lead away from the opposite end, void faces are extruded from the rim
/// along the sweep to the opposite end, whose faces are split there. The rims of the source come first, then
/// those of the target. If a rim ends at other walls, the planes of its flat walls cut the volume instead,
/// and the shorter pieces get the higher levels. If no face can be extruded, as where one rim lies above
/// another, the planes of all flat steps cut the volume into layers. A missing opposite end is first made by
/// filling the only open loop.
///
/// The pieces keep the given faces with their tags and share the void faces between them, so that
/// `sweep::sweep_assembly()` makes one mesh. They are open volumes; the caller classifies, closes and sweeps
/// each of them.
/// @return  pieces of level 0 first; the volume itself if its ends have no steps.
/// @throw NotSweepable "closure.steps"  a step whose rim does not lie below one face of the opposite end, or
///         that ends at other walls and is not flat; an end in several parts that no walls join; names the
///         faces. "closure.cut_apart"  the faces extruded from a rim do not separate the volume.
/// @note  O(facets log facets) per step. The direction is the mean normal of the stepped end.
std::vector<StepPiece> cut_steps(const topology::OpenVolume& volume, const RunContext& context = {});

} // namespace lacuna::closure
