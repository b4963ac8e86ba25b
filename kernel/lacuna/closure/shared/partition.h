// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <functional>
#include <vector>

namespace lacuna::closure {

/// Whether the walls of a sealed volume can be meshed between its ends.
using CanSweep = std::function<bool(const topology::OpenVolume&)>;

/// Receives the pieces of a partition. @return  whether no other partition is needed.
using TakePieces = std::function<bool(std::vector<StepPiece>)>;

/// Find partitions of a sealed volume that no single sweep fills, into pieces that can be swept, best first.
/// A partition is made only if `take` needs another one.
///
/// Candidate cuts are those of `cut_planes()`:
/// - the plane of a flat face next to concave edges, only in the regions of the plane that adjoin these
///   edges;
/// - the plane in which the cylinder of a bore ends in a cone, a ball or another bent face;
/// - planes midway between features;
/// - planes through the axes of bores that cross each other or leave through a bent face.
///
/// The best cut of a piece leaves the least length still to cut (`length_to_cut()`) in pieces without ends,
/// which are then cut in turn. A piece has ends if `read_ends()` finds them, or if its closed skin has a
/// sweep direction, and `can_sweep` accepts them. Cutting stops where no cut reduces that length. A piece
/// without ends that has no length left to cut is divided: at its middle, across an edge between coplanar
/// faces, or at a centre, that is, by three planes at right angles through the centre of a sphere or the apex
/// of a cone. A cut is undone if none of the resulting pieces has ends or is divided.
///
/// If the best cuts leave a piece without ends, or if the pieces cannot be meshed together, there are other
/// partitions, in this order:
/// - the volume as one piece with ends along an axis, after the rounds at the rims of these ends were divided
///   (`split_round_rims()`);
/// - the volume cut in steps between all faces that face along an axis (`cut_steps()`);
/// - divided at its middle (`midpoint_blocks()`);
/// - divided at a centre, if no cut was made and no length is left to cut;
/// - the pieces of the best cuts, if some have no ends. Those that still have a length to cut are divided at
///   their middles where that is possible. If no cut helps, this is the volume itself, with ends other
///   than its roles give, if there are any;
/// - the pieces of up to five other cuts of the volume, each cut on in the same way.
/// @param least  the least distance between a cut and an edge beside it, unless the volume itself is that
///               thin there [model length].
/// @param take   called with pieces and their ends; those without ends cannot be swept. If no cut helps, the
///               volume itself is the only piece.
/// @note  Cutting stops after 200 trial cuts in all, or at 64 pieces. O(facets log facets) for each cut.
void partitions(const topology::OpenVolume& volume, const CanSweep& can_sweep, double least,
                const TakePieces& take, const RunContext& context = {});

/// Whether a piece has a source and a target.
bool has_ends(const topology::OpenVolume& piece);

} // namespace lacuna::closure
