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

/// Receives the pieces of a partition; returns whether the partition is accepted, so that no other one is
/// needed.
using TakePieces = std::function<bool(std::vector<StepPiece>)>;

/// Divide a sealed volume that no single sweep fills into pieces that can be swept. Several partitions are
/// made, the best first, until `take` accepts one.
///
/// Candidate cuts are those of `cut_planes()`:
/// - the plane of a flat face next to concave edges; only regions of the plane that adjoin these edges are
///   cut;
/// - the plane in which the cylinder of a bore ends in a cone, a ball or another bent face;
/// - planes midway between features;
/// - planes through the axes of bores that cross each other or leave through a bent face.
///
/// Cutting is recursive: pieces without ends are cut in turn. A piece has ends if `read_ends()` or a sweep
/// direction of its closed skin gives ends that `can_sweep` accepts. The best cut of a piece leaves the least
/// length to cut (`length_to_cut()`) in pieces without ends. Cutting stops where no cut reduces this length.
/// A piece without ends that has no length to cut is divided in the first of these ways that succeeds:
/// - at its middle (`midpoint_blocks()`);
/// - across an edge between coplanar faces;
/// - across an axis where smooth parts of the skin turn over, such as a ring in a cup;
/// - at a centre: by three perpendicular planes through the centre of a sphere or the apex of a cone, or
///   through the mean of the vertices;
/// - at vertices: by planes through edges of vertices with four to six edges.
///
/// A cut is undone if none of the resulting pieces has ends or is divided.
///
/// If the best cuts leave a piece without ends, or if the pieces cannot be meshed together, there are other
/// partitions, in this order:
/// - the volume as one piece with the faces that face along an axis as ends, after the rounds at the rims of
///   these ends were divided (`split_round_rims()`);
/// - the volume with the faces that face along an axis as ends, cut at its branches and at the steps of its
///   ends (`cut_into_pieces()`);
/// - a body of revolution with a bore around its axis, cut into two halves that are swept around the axis;
/// - the volume divided at its middle (`midpoint_blocks()`);
/// - divided across an axis where smooth parts of the skin turn over;
/// - divided at a centre or at vertices, or at its middle into up to twice as many blocks as there may be
///   pieces otherwise, if no cut was made and no length is left to cut;
/// - the pieces of the best cuts, if some have no ends. Pieces that still have a length to cut are divided at
///   their middles where that is possible. If no cut helps, the only piece is the volume itself, with other
///   ends if there are any;
/// - the pieces of up to five other cuts of the volume; these pieces are cut further in the same way;
/// - the cuts at branches and steps whose pieces could not be swept, also above a round bottom, with other
///   ends, or with the rounds at the rims of their ends divided.
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
