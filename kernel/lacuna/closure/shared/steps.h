// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Whether an end of a volume is at several heights: its faces form several connected parts, or the skin
/// turns towards the void by more than 45° at one of its rims; also `has_round_steps()`.
bool has_steps(const topology::OpenVolume& volume, const RunContext& context = {});

/// Whether a face of an end is an end with walls (`is_end_with_walls()`), and the end has steps once the
/// rounds of this face are divided. A face whose whole rim meets walls at corners is an end alone.
bool has_round_steps(const topology::OpenVolume& volume, const RunContext& context = {});

/// A piece of a cut volume.
struct StepPiece {
    topology::OpenVolume volume;
    int level = 0; ///< 0: the piece runs from end to end like the whole volume; otherwise the number of steps
                   ///< below the piece
    /// For a piece of a full turn: start and end of the piece, as shares of the turn in [0, 1].
    double turn_from = 0, turn_to = 1;
};

/// Cut a volume whose source, target or both are at several heights into pieces that can be swept.
///
/// A step is a rim of an end at which the walls lead away from the opposite end. From such a rim, void faces
/// are extruded along the sweep up to the opposite end, whose faces are split there; first from the rims of
/// the source, then from those of the target. Special cases:
/// - a rim ends at other walls: the planes of its flat walls cut the volume, and the shorter pieces get the
///   higher levels;
/// - no face can be extruded, for example because one rim lies above another: the planes of all flat steps
///   cut the volume into layers;
/// - the opposite end is missing: it is first made by filling the only open loop.
///
/// The pieces keep the given faces with their tags and share the void faces between them, so that
/// `sweep::sweep_assembly()` makes one mesh. They are open volumes; the caller classifies, closes and sweeps
/// each of them.
/// @return  pieces of level 0 first; the volume itself if its ends have no steps.
/// @throw NotSweepable "closure.steps"  the rim of a step is not projected into one face of the opposite end,
///         or it ends at other walls and is not flat; or an end has several parts that no walls join; names
///         the faces. "closure.cut_apart"  the faces extruded from a rim do not separate the volume.
/// @note  O(facets log facets) per step. The sweep direction is the mean normal of the stepped end.
std::vector<StepPiece> cut_steps(const topology::OpenVolume& volume, const RunContext& context = {});

} // namespace lacuna::closure
